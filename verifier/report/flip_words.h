// SPDX-License-Identifier: MIT
// Where a conclusion flips, in words and digits.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verifier/agreement/result.h"

namespace threefold::report {

/// One of the renders on both sides of a flip point.
struct BracketRender {
    std::string experiment;
    std::optional<double> at;       ///< the parameter's value there, where the record tells
    std::optional<Verdict> verdict; ///< of its rows; empty: nothing was measured
};

/// In the order of `flip.bracket`.
std::vector<BracketRender> bracket_renders(const ClaimResult &claim, const FlipPoint &flip);
/// Of both sides together; empty: there are none.
std::optional<Verdict> bracket_verdict(const ClaimResult &claim, const FlipPoint &flip);

/// Five significant digits, zeros kept, with the unit: "1.2103", "250.37 mm".
std::string flip_value(const FlipPoint &flip);
/// "1.51714, 25 % above it".
std::string here_text(const FlipPoint &flip);
/// "glass.index = 1.2103 (here 1.51714, 25 % above it)".
std::string flip_line(const FlipPoint &flip);
/// "at 1.2006 and 1.2200"; empty where nothing was rendered beside it.
std::string bracket_text(const ClaimResult &claim, const FlipPoint &flip);

} // namespace threefold::report
