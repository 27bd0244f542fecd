// SPDX-License-Identifier: MIT
// A scene of one's own with all of Threefold's commands: flask list, flask render flask --set water.index=1.34, ...
#include "tools/run.h"

using namespace threefold;

/// A ball of water where the catalogue has glass.
SceneRecipe flask() {
    SceneRecipe recipe = find_scene(built_in_scenes(), "solid");
    recipe.name = "flask";
    recipe.summary = "a ball of water before a card";
    for (ParameterSpec &p : recipe.parameters)
        if (p.name == "glass.index") p.text = p.published = 1.333;
    return recipe;
}

int main(int argc, char **argv) {
    auto scenes = built_in_scenes();
    scenes.push_back(flask());
    return run(argc, argv, scenes, built_in_claims());
}
