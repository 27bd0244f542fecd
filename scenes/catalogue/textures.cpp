// SPDX-License-Identifier: MIT
#include "scenes/catalogue/textures.h"

#include "scenes/catalogue/painted_robe.h"
#include "scenes/figure/stored_figure.h"

namespace threefold {

namespace {

template <class Colour>
std::shared_ptr<const Texture> paint(int width, int height, Colour colour) {
    auto texture = std::make_shared<Texture>(Texture{width, height, {}});
    texture->rgb.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const Rgb c = colour(column, row);
            for (int k = 0; k < 3; ++k) texture->rgb.push_back(texture_sample(c[k]));
        }
    return texture;
}

} // namespace

std::shared_ptr<const Texture> robe_texture() {
    return std::make_shared<Texture>(Texture{robe_texture_side, robe_texture_side, figure::stored_robe_texture()});
}

Rgb patch_radiance(int column, int row) {
    const int k = row * patch_columns + column;
    return {0.05 + 0.9 * k / 15.0, 0.05 + 0.9 * ((k * 7) % 16) / 15.0, 0.05 + 0.9 * ((k * 11 + 5) % 16) / 15.0};
}

std::shared_ptr<const Texture> patches_texture(int texels_per_patch) {
    return paint(patch_columns * texels_per_patch, patch_rows * texels_per_patch, [=](int column, int row) {
        return patch_radiance(column / texels_per_patch, row / texels_per_patch);
    });
}

} // namespace threefold
