// SPDX-License-Identifier: MIT
// What the claim three-lines leaves out.
#pragma once

#include <vector>

#include "verifier/claims/claim.h"

namespace threefold {

std::vector<ScopeNumber> scope_three_lines(const ClaimContext &context, const ScopeSettings &settings);

} // namespace threefold
