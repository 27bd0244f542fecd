// SPDX-License-Identifier: MIT
#include "verifier/measure/highlight.h"

#include <glm/geometric.hpp>

namespace threefold {

Highlight highlight(const Image &image, Vec2 about_px, Vec2 other_px) {
    Vec2 moment(0);
    double light = 0;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const Vec2 at(column + 0.5, row + 0.5);
            if (glm::length(at - about_px) >= glm::length(at - other_px)) continue;
            const Rgb &p = image.at(column, row);
            const double radiance = (p.r + p.g + p.b) / 3;
            moment += radiance * at;
            light += radiance;
        }
    return {moment / light, light};
}

} // namespace threefold
