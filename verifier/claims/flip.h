// SPDX-License-Identifier: MIT
// Where a conclusion flips: a root of a closed form over one parameter, and the two values beside it that are rendered.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string_view>

namespace threefold {

/// The zero of a continuous function between two values at which its signs differ, to 1e-12 of its size (TOMS 748,
/// Alefeld, Potra and Shi, 1995). Nothing where the signs do not differ or the function is not finite there.
std::optional<double> root_between(const std::function<double(double)> &f, double low, double high);

/// A flip point is bracketed by renders this share of its value below and above it: within 1 %, and far enough that the
/// conclusion's number differs from its threshold by more than any renderer errs.
inline constexpr double bracket_share = 0.008;

struct BracketSide {
    std::string_view label; ///< "below" or "above"
    double value;
};

inline std::array<BracketSide, 2> bracket_of(double flip) {
    return {BracketSide{"below", flip * (1 - bracket_share)}, BracketSide{"above", flip * (1 + bracket_share)}};
}

/// The same where the parameter cannot be less than that: the lower side then lies half way to it.
inline std::array<BracketSide, 2> bracket_of(double flip, double least) {
    auto sides = bracket_of(flip);
    sides[0].value = std::max(sides[0].value, (least + flip) / 2);
    return sides;
}

} // namespace threefold
