// SPDX-License-Identifier: MIT
#include "scenes/catalogue/catalogue.h"

namespace threefold {

std::vector<SceneRecipe> built_in_scenes() {
    return {
        calibration_scene(),
        solid_scene(),
        hollow_scene(),
        furnace_scene(),
        soft_light_scene(),
        three_lines_hollow_scene(),
        three_lines_solid_scene(),
        three_lines_bent_scene(),
        three_lines_setup_scene(),
        folds_scene(),
        salvator_scene(),
        setup_scene(),
        tint_scene(),
        calcite_scene(),
        rim_scene(),
        white_spots_scene(),
        dark_layer_scene(),
    };
}

} // namespace threefold
