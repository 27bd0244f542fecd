// SPDX-License-Identifier: MIT
// A picture in memory: linear Rec. 709 radiance in double precision, row 0 on top.
#pragma once

#include <cstddef>
#include <vector>

#include "scenes/scene.h"

namespace threefold {

struct Image {
    int width = 0, height = 0;
    std::vector<Rgb> pixels; ///< width * height, row-major

    Image() = default;
    Image(int width_px, int height_px, Rgb fill = Rgb(0))
        : width(width_px), height(height_px),
          pixels(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), fill) {}

    Rgb &at(int column, int row) { return pixels[index(column, row)]; }
    const Rgb &at(int column, int row) const { return pixels[index(column, row)]; }

private:
    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
    }
};

/// Of pictures of one size; at least one.
inline Image mean(const std::vector<Image> &images) {
    Image sum(images.front().width, images.front().height);
    for (const Image &image : images)
        for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += image.pixels[i];
    for (Rgb &pixel : sum.pixels) pixel /= static_cast<double>(images.size());
    return sum;
}

} // namespace threefold
