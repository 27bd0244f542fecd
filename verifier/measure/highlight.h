// SPDX-License-Identifier: MIT
// A small bright spot on a dark ground: where it is and how much light it has.
#pragma once

#include "exporter/image/image.h"
#include "scenes/scene.h"

namespace threefold {

struct Highlight {
    Vec2 centre_px; ///< centroid of its light; NaN without any
    double light;   ///< sum of the radiance (mean of the channels) over its pixels
};

/// Of the pixels that are nearer to `about_px` than to `other_px`.
Highlight highlight(const Image &image, Vec2 about_px, Vec2 other_px);

} // namespace threefold
