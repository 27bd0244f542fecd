// SPDX-License-Identifier: MIT
// How small a fault is still caught: a search over its size, from the listed one towards the honest value.
#pragma once

#include <functional>
#include <optional>

#include "verifier/claims/fault.h"

namespace threefold {

struct SmallestFault {
    double caught = 0;            ///< the size nearest to honest that was caught
    std::optional<double> missed; ///< and the next one tried, which was not; empty: the search ended before
    int evaluations = 0;          ///< of `is_caught`
};

/// The listed size is known to be caught, and a larger fault is assumed to be caught where a smaller one is. Steps of a
/// factor of ten (for whole numbers, of two), then bisection: real sizes until their departures from the honest value
/// are within `resolution`, a factor; whole numbers to the last. Gives up at a millionth of the listed departure.
/// Empty for a fault that is there or not.
std::optional<SmallestFault> smallest_fault(const FaultEntry &entry, const std::function<bool(double size)> &is_caught,
                                            double resolution);

} // namespace threefold
