// SPDX-License-Identifier: MIT
// A scene of the catalogue with some of its parameters set.
#pragma once

#include <string_view>
#include <vector>

#include "scenes/catalogue/catalogue.h"

namespace threefold {

inline Scene catalogue_scene(std::string_view name, const std::vector<Assignment> &assignments = {},
                             Preset preset = Preset::text) {
    const std::vector<SceneRecipe> scenes = built_in_scenes();
    const SceneRecipe &recipe = find_scene(scenes, name);
    Parameters values(recipe.parameters, preset);
    for (const Assignment &a : assignments) values.set(a.name, a.value);
    return recipe.make(values);
}

} // namespace threefold
