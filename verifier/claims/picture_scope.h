// SPDX-License-Identifier: MIT
// What the claims about whole pictures leave out: how far it could move the mean of a tile. The number is the greatest
// change among the tiles that must hold (99 %), its margin the tolerance on a tile.
#pragma once

#include <vector>

#include "verifier/claims/claim.h"

namespace threefold {

/// `e` is the picture's experiment, with the scene, tile and share that check compares. Four bounds are closed forms
/// over what the pixels see; the others are pictures to be asked for, of the same view in half its pixels.
std::vector<ScopeNumber> picture_scope(const Experiment &e, const ScopeSettings &settings);

} // namespace threefold
