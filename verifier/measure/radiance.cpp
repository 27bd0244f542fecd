// SPDX-License-Identifier: MIT
#include "verifier/measure/radiance.h"

#include <algorithm>
#include <limits>

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
    const int columns = std::max(1, image.width / tile_px), rows = std::max(1, image.height / tile_px);
    Image tiles(columns, rows);
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            tiles.at(column, row) = rectangle_mean(image, column * tile_px, row * tile_px,
                                                   column + 1 == columns ? image.width : (column + 1) * tile_px,
                                                   row + 1 == rows ? image.height : (row + 1) * tile_px);
    return tiles;
}

} // namespace threefold
