// SPDX-License-Identifier: MIT
// How a picture is cut into square tiles, wherever pictures are compared tile by tile.
#pragma once

#include <vector>

namespace threefold {

/// Pixels [left, right) x [top, bottom).
struct PixelRectangle {
    int left, top, right, bottom;
    double pixels() const { return static_cast<double>(right - left) * (bottom - top); }
};

/// Whole `tile_px` x `tile_px` tiles; what is left over at the right and below joins the last tile, so that no tile has
/// fewer pixels, and so more noise, than the others. A picture smaller than a tile is one tile.
struct TileGrid {
    int columns, rows;

    TileGrid(int width_px, int height_px, int tile_px);
    PixelRectangle tile(int column, int row) const;
    /// Row by row.
    std::vector<PixelRectangle> tiles() const;

private:
    int width_px_, height_px_, tile_px_;
};

} // namespace threefold
