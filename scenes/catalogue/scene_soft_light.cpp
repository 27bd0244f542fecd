// SPDX-License-Identifier: MIT
// The study's light on a white wall, under a board with a straight lower edge: the edge's shadow shows how soft the
// light is. The wall stands where the robe would, the board a little before it; the picture is the wall just under the
// board, seen straight on.
#include "scenes/catalogue/catalogue.h"
#include "scenes/catalogue/common.h"
#include "scenes/figure/light.h"

namespace threefold {

SceneRecipe soft_light_scene() {
    const Specs stage{number_parameter("board.distance_mm", "board to wall", 30, 1e-6, 1e6),
                      number_parameter("eye.distance_mm", "eye to the place of the orb's centre", 900, 1200, 1, 1e6),
                      number_parameter("card.distance_mm", "place of the orb's centre to the wall", 250, 297.5, 1, 1e6),
                      number_parameter("criterion.acuity_arcmin",
                                       "least angle that the eye resolves, in minutes of arc", 1, 1e-3, 1e3)};
    ParameterSpec width{"image.width_px", "width of the picture"}, height{"image.height_px", "height of the picture"};
    width.text = width.published = 24;
    height.text = height.published = 192;
    for (ParameterSpec *p : {&width, &height}) {
        p->least = 1;
        p->greatest = 1e5;
        p->whole = true;
    }
    ParameterSpec directions{"environment.dome_directions", "parallel lights that stand for the environment's light"};
    directions.text = directions.published = 48;
    directions.greatest = 10'000;
    directions.least = 1;
    directions.whole = true;
    return {
        "soft-light", "a white wall in the study's light, and the soft shadow of a board's edge on it",
        join({stage, {width, height, directions}, environment_parameters(study_environment_radiance)}),
        [](const Parameters &p) {
            const double distance = p.number("board.distance_mm"), wall_z = -p.number("card.distance_mm");
            // The window reaches from 0.8 to 2.2 of the board's distance under its edge: the cluster's shadows end
            // between 1.02 and 1.92 of it.
            const double window = 1.4 * distance, middle = -1.5 * distance;
            constexpr double large = 40; // of the board's distance: only lights that graze the wall pass beside it
            Scene scene;
            scene.objects = {
                {"wall",
                 Quad{{0, 0, wall_z}, {2 * large * distance, 0, 0}, {0, 2 * large * distance, 0}, Diffuse{Rgb(0.8)}}},
                {"board", Quad{{0, large * distance, wall_z + distance},
                               {large * distance, 0, 0},
                               {0, large * distance, 0},
                               Diffuse{Rgb(0.2)}}}};
            scene.lights = study_lights();
            scene.environment = Environment{Rgb(p.number("environment.radiance")),
                                            static_cast<int>(p.number("environment.dome_directions"))};
            Camera &camera = scene.camera;
            camera.projection = Projection::orthographic;
            camera.width_px = static_cast<int>(p.number("image.width_px"));
            camera.height_px = static_cast<int>(p.number("image.height_px"));
            camera.orthographic_width_mm = window * camera.width_px / camera.height_px;
            camera.eye_mm = {0, middle, p.number("eye.distance_mm")};
            camera.target_mm = {0, middle, wall_z};
            return scene;
        }};
}

} // namespace threefold
