// SPDX-License-Identifier: MIT
#include "verifier/measure/edges.h"

namespace threefold {

Borders plateau_borders(const Image &image, int row, int split_px, const Plateaus &plateaus) {
    Borders borders{static_cast<double>(split_px), static_cast<double>(split_px)};
    for (int column = 0; column < image.width; ++column) {
        const Rgb &p = image.at(column, row);
        const double radiance = (p.r + p.g + p.b) / 3;
        if (column < split_px)
            borders.left_px -= (radiance - plateaus.left) / (plateaus.middle - plateaus.left);
        else
            borders.right_px += (plateaus.right - radiance) / (plateaus.right - plateaus.middle);
    }
    return borders;
}

} // namespace threefold
