// SPDX-License-Identifier: MIT
// How far two images of one thing lie from it, and from each other: root mean squares over pixels, millimetres, each
// without its largest `left_out_share`, so that a ray which a renderer lost among thousands does not outweigh the rest.
#pragma once

#include <vector>

#include "scenes/scene.h"

namespace threefold {

/// Of one pixel: where its ray lands by each image, and where it would land without the ball.
struct DoubleLanding {
    Vec3 ordinary_mm, extraordinary_mm, straight_mm;
};

struct DoubleImage {
    double ordinary_mm, extraordinary_mm; ///< each image's displacement
    double distortion_mm;                 ///< of the middle between both
    double separation_mm;                 ///< between both
};

constexpr double left_out_share = 0.005;

/// NaN without pixels. The share left out is a quantile, of an exact prediction as of a picture: it is part of what is
/// measured, not a judgement of single pixels.
DoubleImage double_image(const std::vector<DoubleLanding> &landings);

} // namespace threefold
