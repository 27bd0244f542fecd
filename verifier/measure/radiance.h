// SPDX-License-Identifier: MIT
// Means of a picture over regions: rings about a centre, rectangles, tiles.
#pragma once

#include <functional>
#include <vector>

#include "exporter/image/image.h"
#include "scenes/camera.h"

namespace threefold {

/// Mean over the three channels and over every pixel for which `ring(column, row)` gives that ring's number; a ring
/// that no pixel falls into is NaN. Negative numbers are left out.
std::vector<double> ring_means(const Image &image, int rings, const std::function<int(int column, int row)> &ring);

/// Mean over the pixels [left, right) x [top, bottom).
Rgb rectangle_mean(const Image &image, int left, int top, int right, int bottom);

/// Over all pixels and channels.
double mean_radiance(const Image &image);

/// A pixel for each tile of the picture's TileGrid: its mean.
Image tile_means(const Image &image, int tile_px);

} // namespace threefold
