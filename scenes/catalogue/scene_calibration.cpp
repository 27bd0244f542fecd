// SPDX-License-Identifier: MIT
// No glass at all: where the camera looks, which way up an image lies, and whether radiance comes out as it went in.
#include "scenes/camera.h"
#include "scenes/catalogue/catalogue.h"
#include "scenes/catalogue/common.h"
#include "scenes/catalogue/textures.h"

namespace threefold {

SceneRecipe calibration_scene() {
    return {"calibration", "no glass: a coordinate card beside sixteen patches of known radiance",
            join({orb_parameters(), view_parameters(), environment_parameters(0.25)}), [](const Parameters &p) {
                Scene scene;
                scene.camera = make_camera(p);
                scene.environment = make_environment(p);
                // Both cards stand where the orb's centre would be, each nearly half of the film's width.
                const double half_width = film_half_width(scene.camera) * p.number("eye.distance_mm");
                const double half = 0.44 * half_width;
                const Vec3 centre(0.47 * half_width, 0, 0), u(half, 0, 0), v(0, half, 0);
                scene.objects = {{"coordinate card", Quad{-centre, u, v, CoordinateCard{}}},
                                 {"patches", Quad{centre, u, v, Emissive{patches_texture(16)}}}};
                return scene;
            }};
}

} // namespace threefold
