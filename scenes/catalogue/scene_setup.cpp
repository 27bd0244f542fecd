// SPDX-License-Identifier: MIT
// The set-up seen from aside (figure 2 of the study): relief, hand and orb, and a camera where the eye is.
#include "scenes/catalogue/catalogue.h"
#include "scenes/catalogue/composition.h"
#include "scenes/figure/film_camera.h"

namespace threefold {

namespace {

/// From the left and from behind the eye, so that relief and camera stand at the two ends of the picture.
Camera side_camera(const Parameters &p) {
    const figure::Standpoint view = standpoint(p);
    const double length = view.eye_mm.z - view.plane_z_mm;
    Camera camera;
    // A wider picture (a nearer eye) is seen from further off.
    camera.eye_mm = view.eye_mm + length * Vec3(-0.51 - 1.8 * view.half_angle_tangent, 0.10, 0.05);
    camera.target_mm = view.eye_mm + length * Vec3(0.0, -0.01, -0.35);
    camera.horizontal_fov_deg = 76;
    camera.width_px = static_cast<int>(p.number("image.width_px"));
    camera.height_px = static_cast<int>(p.number("image.height_px"));
    return camera;
}

} // namespace

SceneRecipe setup_scene() {
    return {"setup", "the set-up seen from aside: relief, hand, orb, and a film camera at the eye",
            join({composition_parameters(), picture_size_parameters(512, 256)}), [](const Parameters &p) {
                Scene scene = composition(p);
                const Vec3 eye = standpoint(p).eye_mm;
                Mesh camera = figure::film_camera(eye, 0.22 * eye.z);
                camera.surface = Diffuse{Rgb(0.8)};
                if (p.word("figure.surface") == "identity") camera.surface = Emissive{Rgb(0)};
                scene.objects.push_back({"camera", std::move(camera)});
                scene.camera = side_camera(p);
                return scene;
            }};
}

} // namespace threefold
