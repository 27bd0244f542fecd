// SPDX-License-Identifier: MIT
#include "scenes/texture.h"

#include <algorithm>

namespace threefold {

Rgb sample(const Texture &texture, Vec2 uv) {
    const double x = std::clamp(uv.x * texture.width - 0.5, 0.0, texture.width - 1.0);
    const double y = std::clamp((1 - uv.y) * texture.height - 0.5, 0.0, texture.height - 1.0);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, texture.width - 1), y1 = std::min(y0 + 1, texture.height - 1);
    const auto texel = [&](int column, int row) {
        const std::size_t i = (static_cast<std::size_t>(row) * static_cast<std::size_t>(texture.width) +
                               static_cast<std::size_t>(column)) *
                              3;
        return Rgb(texture.rgb[i], texture.rgb[i + 1], texture.rgb[i + 2]);
    };
    const double fx = x - x0, fy = y - y0;
    const Rgb top = texel(x0, y0) * (1 - fx) + texel(x1, y0) * fx;
    const Rgb bottom = texel(x0, y1) * (1 - fx) + texel(x1, y1) * fx;
    return (top * (1 - fy) + bottom * fy) / 65535.0;
}

Rgb sample(const Paint &paint, Vec2 uv) {
    return std::visit(overloaded{
                          [](const Rgb &colour) { return colour; },
                          [uv](const std::shared_ptr<const Texture> &texture) { return sample(*texture, uv); },
                      },
                      paint);
}

Rgb greatest_value(const Paint &paint) {
    return std::visit(overloaded{
                          [](const Rgb &colour) { return colour; },
                          [](const std::shared_ptr<const Texture> &texture) {
                              // Many texels side by side: pictures are asked for this before each is traced.
                              constexpr std::size_t side_by_side = 24;
                              std::uint16_t most[side_by_side]{};
                              const std::uint16_t *rgb = texture->rgb.data();
                              const std::size_t n = texture->rgb.size(), whole = n / side_by_side * side_by_side;
                              for (std::size_t i = 0; i < whole; i += side_by_side)
                                  for (std::size_t k = 0; k < side_by_side; ++k)
                                      most[k] = rgb[i + k] > most[k] ? rgb[i + k] : most[k];
                              for (std::size_t i = whole; i < n; ++i) most[i % 3] = std::max(most[i % 3], rgb[i]);
                              for (std::size_t k = 3; k < side_by_side; ++k)
                                  most[k % 3] = std::max(most[k % 3], most[k]);
                              return Rgb(most[0], most[1], most[2]) / 65535.0;
                          },
                      },
                      paint);
}

} // namespace threefold
