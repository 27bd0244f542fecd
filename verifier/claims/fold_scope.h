// SPDX-License-Identifier: MIT
// What the claims about folds leave out: how far it could move a fold's break.
#pragma once

#include <string>
#include <vector>

#include "verifier/claims/fold_numbers.h"

namespace threefold {

/// Of the greatest break among these folds (mm on the robe), against what the eye resolves.
ScopeNumber break_scope(const ClaimContext &context, const ScopeSettings &settings, const std::string &quantity,
                        const std::vector<Assignment> &fixed, const std::vector<std::size_t> &folds);

} // namespace threefold
