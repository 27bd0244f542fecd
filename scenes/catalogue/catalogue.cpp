// SPDX-License-Identifier: MIT
#include "scenes/catalogue/catalogue.h"

namespace threefold {

std::vector<SceneRecipe> built_in_scenes() {
    return {
        calibration_scene(),
        solid_scene(),
        hollow_scene(),
        furnace_scene(), salvator_scene(), setup_scene(),
    };
}

} // namespace threefold
