// SPDX-License-Identifier: MIT
#include "scenes/catalogue/catalogue.h"

namespace threefold {

std::vector<SceneRecipe> built_in_scenes() {
    return {
        calibration_scene(),
        solid_scene(),
        hollow_scene(),
        furnace_scene(),
        tint_scene(),
        calcite_scene(),
        rim_scene(),
        white_spots_scene(),
        dark_layer_scene(),
    };
}

} // namespace threefold
