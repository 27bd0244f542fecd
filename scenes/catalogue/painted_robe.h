// SPDX-License-Identifier: MIT
// The robe's texture, texel by texel: done when Threefold is built (scenes/figure/stored_figure.h).
#pragma once

#include <cstdint>
#include <vector>

namespace threefold {

inline constexpr int robe_texture_side = 512;
/// Samples of a square, as Texture has them.
std::vector<std::uint16_t> paint_robe_texture();

} // namespace threefold
