// SPDX-License-Identifier: MIT
#include "verifier/measure/tile_grid.h"

#include <algorithm>

namespace threefold {

TileGrid::TileGrid(int width_px, int height_px, int tile_px)
    : columns(std::max(1, width_px / tile_px)), rows(std::max(1, height_px / tile_px)), width_px_(width_px),
      height_px_(height_px), tile_px_(tile_px) {}

PixelRectangle TileGrid::tile(int column, int row) const {
    return {column * tile_px_, row * tile_px_, column + 1 == columns ? width_px_ : (column + 1) * tile_px_,
            row + 1 == rows ? height_px_ : (row + 1) * tile_px_};
}

std::vector<PixelRectangle> TileGrid::tiles() const {
    std::vector<PixelRectangle> all;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) all.push_back(tile(column, row));
    return all;
}

} // namespace threefold
