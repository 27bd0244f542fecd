// SPDX-License-Identifier: MIT
#include "scenes/figure/painted_relief.h"

namespace threefold::figure {

ReliefGrid::ReliefGrid(int columns_of_it) : columns(columns_of_it) {
    const Vec2 size = relief_high - relief_low;
    rows = std::max(2, static_cast<int>(std::lround((columns - 1) * size.y / size.x)) + 1);
}

Vec2 ReliefGrid::place(int column, int row) const {
    const Vec2 share(static_cast<double>(column) / (columns - 1), static_cast<double>(row) / (rows - 1));
    return relief_low + share * (relief_high - relief_low);
}

std::vector<double> paint_heights(const ReliefGrid &grid) {
    const Painting painting;
    std::vector<double> heights;
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column)
            heights.push_back(painting.at(grid.place(column, row)).height);
    return heights;
}

std::vector<std::uint16_t> paint_relief_texture() {
    constexpr int width = relief_texture_width, height = relief_texture_height;
    const Painting painting;
    std::vector<std::uint16_t> samples;
    samples.reserve(std::size_t{3} * width * height);
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const Rgb colour = painting.at(place_at({(column + 0.5) / width, 1 - (row + 0.5) / height})).colour;
            for (int k = 0; k < 3; ++k) samples.push_back(static_cast<std::uint16_t>(std::lround(colour[k] * 65535)));
        }
    return samples;
}

} // namespace threefold::figure
