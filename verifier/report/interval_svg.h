// SPDX-License-Identifier: MIT
// The picture of an equivalence test: does the interval lie inside the tolerance band?
#pragma once

#include <span>
#include <string>

#include "verifier/agreement/result.h"

namespace threefold::report {

/// Half the width of a drawing, so that the rows of one quantity share one scale.
struct Scale {
    double tolerances = 2; ///< of rows with a tolerance; what lies beyond is cut off and marked
    double reach = 1;      ///< of rows without one, in the unit of the quantity
};
Scale common_scale(std::span<const Row *const> rows);

/// An inline <svg>: the band of the tolerance (one-sided for `below` and `above`), the closed form as a line, the
/// interval as a bar, the mean as a tick; an arrow where an interval goes on outside the drawing.
std::string interval_svg(const Row &row, const Scale &scale);

} // namespace threefold::report
