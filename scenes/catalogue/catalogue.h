// SPDX-License-Identifier: MIT
// The scenes that come with Threefold. A scene is added by a file beside this one and a line in catalogue.cpp.
#pragma once

#include "scenes/parameters.h"

namespace threefold {

std::vector<SceneRecipe> built_in_scenes();

SceneRecipe calibration_scene();
SceneRecipe solid_scene();
SceneRecipe hollow_scene();
SceneRecipe furnace_scene();
SceneRecipe salvator_scene();
SceneRecipe setup_scene();
SceneRecipe soft_light_scene();
SceneRecipe three_lines_hollow_scene();
SceneRecipe three_lines_solid_scene();
SceneRecipe three_lines_bent_scene();
SceneRecipe three_lines_setup_scene();
SceneRecipe folds_scene();
SceneRecipe tint_scene();
SceneRecipe calcite_scene();
SceneRecipe rim_scene();
SceneRecipe white_spots_scene();
SceneRecipe dark_layer_scene();

} // namespace threefold
