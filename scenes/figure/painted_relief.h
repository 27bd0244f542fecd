// SPDX-License-Identifier: MIT
// The painting taken at many places: the relief's heights and its texture. Most of a second's work for the usual sizes,
// done when Threefold is built (stored_figure.h).
#pragma once

#include "scenes/figure/painting.h"

namespace threefold::figure {

/// Texture coordinates are those of the whole picture.
inline constexpr Vec2 picture_high{1, picture_height};
inline Vec2 place_at(Vec2 uv) { return (2.0 * uv - 1.0) * picture_high; }
inline Vec2 uv_at(Vec2 place) { return 0.5 * (place / picture_high + 1.0); }

/// Where the relief's vertices are seen: rows as make its cells square, from below.
class ReliefGrid {
public:
    explicit ReliefGrid(int columns);

    int columns, rows;
    Vec2 place(int column, int row) const;
};

/// Of the vertices, row by row.
std::vector<double> paint_heights(const ReliefGrid &grid);

inline constexpr int relief_texture_width = 704, relief_texture_height = 1036;
/// Samples of the whole picture, as Texture has them.
std::vector<std::uint16_t> paint_relief_texture();

} // namespace threefold::figure
