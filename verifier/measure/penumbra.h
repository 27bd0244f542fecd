// SPDX-License-Identifier: MIT
// The soft edge of a shadow that runs across a picture, dark above and light below.
#pragma once

#include <span>
#include <vector>

#include "exporter/image/image.h"

namespace threefold {

/// Mean over each row, and over the three channels.
std::vector<double> row_means(const Image &image);

struct Penumbra {
    double dark = 0, light = 0; ///< means of the first and of the last sixteenth of the rows: clear of the edge
    double middle_row = 0;      ///< mean of where light sets in, in rows from the top edge
    double width_rows = 0;      ///< sqrt(12) standard deviations of that: the width, if the edge is an even ramp
};

/// The profile, scaled to rise from 0 to 1, is taken for the distribution of where light sets in; its moments are
/// integrals over all rows, so that noise averages out. NaN without contrast or with fewer than 32 rows.
Penumbra measure_penumbra(std::span<const double> rows);

} // namespace threefold
