// SPDX-License-Identifier: MIT
// A hollow orb in surroundings that are the same everywhere: glass that neither takes nor gives light must vanish.
#include "scenes/catalogue/catalogue.h"
#include "scenes/catalogue/common.h"

namespace threefold {

SceneRecipe furnace_scene() {
    Specs orb_kind{{"orb.kind", "hollow or solid"}};
    orb_kind[0].choices = {"hollow", "solid"};
    return {"furnace", "a glass orb in uniform surroundings: it must vanish",
            join({orb_kind, orb_parameters(), wall_parameters(), glass_parameters(), view_parameters(),
                  environment_parameters(1)}),
            [](const Parameters &p) {
                Scene scene;
                scene.objects = {{"orb", p.word("orb.kind") == "solid" ? Shape(make_ball(p)) : Shape(make_shell(p))}};
                scene.environment = make_environment(p);
                scene.camera = make_camera(p);
                return scene;
            }};
}

} // namespace threefold
