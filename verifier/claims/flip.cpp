// SPDX-License-Identifier: MIT
#include "verifier/claims/flip.h"

#include <cmath>
#include <cstdint>

#include <boost/math/tools/roots.hpp>

namespace threefold {

std::optional<double> root_between(const std::function<double(double)> &f, double low, double high) {
    const double at_low = f(low), at_high = f(high);
    if (!std::isfinite(at_low) || !std::isfinite(at_high)) return std::nullopt;
    if (at_low == 0) return low;
    if (at_high == 0) return high;
    if ((at_low < 0) == (at_high < 0)) return std::nullopt;
    std::uintmax_t most_steps = 200;
    const auto [a, b] = boost::math::tools::toms748_solve(
        f, low, high, at_low, at_high,
        [](double x, double y) { return std::abs(y - x) <= 1e-12 * std::max(std::abs(x), std::abs(y)); }, most_steps);
    return (a + b) / 2;
}

} // namespace threefold
