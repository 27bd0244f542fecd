// SPDX-License-Identifier: MIT
// Where three plateaus of brightness border on each other, to a fraction of a pixel.
#pragma once

#include <optional>

#include "exporter/image/image.h"

namespace threefold {

/// Along a row, from left to right: `left`, then `middle`, then `right` (known radiances, all different).
struct Plateaus {
    double left, middle, right;
};

/// Image x of the two borders on one row, found by the share of each plateau on either side of `split_px`, a column
/// border that lies in the middle plateau: exact for any border that a one-pixel box filter has blurred.
struct Borders {
    double left_px, right_px;
};

Borders plateau_borders(const Image &image, int row, int split_px, const Plateaus &plateaus);

} // namespace threefold
