// SPDX-License-Identifier: MIT
// The same card seen through a solid orb and through a hollow one (figure 3 of the study).
#include "scenes/catalogue/catalogue.h"
#include "scenes/catalogue/common.h"

namespace threefold {

namespace {

Scene before_card(const Parameters &p, const Shape &orb) {
    Scene scene;
    scene.objects = {{"orb", orb}, {"card", make_card(p)}};
    scene.environment = make_environment(p);
    scene.camera = make_camera(p);
    return scene;
}

} // namespace

SceneRecipe solid_scene() {
    return {
        "solid", "a solid glass orb before a card",
        join({orb_parameters(), glass_parameters(), view_parameters(), card_parameters(), environment_parameters(0.2)}),
        [](const Parameters &p) { return before_card(p, make_ball(p)); }};
}

SceneRecipe hollow_scene() {
    return {"hollow", "a hollow glass orb before the same card",
            join({orb_parameters(), wall_parameters(), glass_parameters(), view_parameters(), card_parameters(),
                  environment_parameters(0.2)}),
            [](const Parameters &p) { return before_card(p, make_shell(p)); }};
}

} // namespace threefold
