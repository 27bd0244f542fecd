// SPDX-License-Identifier: MIT
#include "verifier/measure/radiance.h"

#include <algorithm>
#include <limits>

#include "verifier/measure/tile_grid.h"

namespace threefold {

std::vector<double> ring_means(const Image &image, int rings, const std::function<int(int, int)> &ring) {
    std::vector<double> sums(static_cast<std::size_t>(rings), 0.0), counts(sums.size(), 0.0);
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const int k = ring(column, row);
            if (k < 0 || k >= rings) continue;
            const Rgb &p = image.at(column, row);
            sums[static_cast<std::size_t>(k)] += (p.r + p.g + p.b) / 3;
            counts[static_cast<std::size_t>(k)] += 1;
        }
    for (std::size_t k = 0; k < sums.size(); ++k)
        sums[k] = counts[k] > 0 ? sums[k] / counts[k] : std::numeric_limits<double>::quiet_NaN();
    return sums;
}

Rgb rectangle_mean(const Image &image, int left, int top, int right, int bottom) {
    Rgb sum(0);
    for (int row = top; row < bottom; ++row)
        for (int column = left; column < right; ++column) sum += image.at(column, row);
    return sum / (static_cast<double>(right - left) * (bottom - top));
}

double mean_radiance(const Image &image) {
    const Rgb m = rectangle_mean(image, 0, 0, image.width, image.height);
    return (m.r + m.g + m.b) / 3;
}

Image tile_means(const Image &image, int tile_px) {
    const TileGrid grid(image.width, image.height, tile_px);
    Image means(grid.columns, grid.rows);
    std::ranges::transform(grid.tiles(), means.pixels.begin(), [&](const PixelRectangle &t) {
        return rectangle_mean(image, t.left, t.top, t.right, t.bottom);
    });
    return means;
}

} // namespace threefold
