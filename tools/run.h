// SPDX-License-Identifier: MIT
// The command line as a function, so that a program of ten lines can have all its commands for scenes and claims of its
// own:
//
//     #include "tools/run.h"
//     int main(int argc, char **argv) {
//         auto scenes = threefold::built_in_scenes();
//         scenes.push_back(my_flask());
//         return threefold::run(argc, argv, scenes, threefold::built_in_claims());
//     }
#pragma once

#include <vector>

#include "scenes/catalogue/catalogue.h"
#include "verifier/claims/claim.h"

namespace threefold {

/// Parses, runs one command, prints errors as one line on stderr, and returns the exit code (scenes/error.h).
int run(int argc, char **argv, const std::vector<SceneRecipe> &scenes, const std::vector<Claim> &claims);

} // namespace threefold
