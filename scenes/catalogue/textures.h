// SPDX-License-Identifier: MIT
// Generated images of the catalogue's scenes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>

#include "scenes/scene.h"

namespace threefold {

/// 0 up to `from`, 1 beyond `to`, smooth between.
inline double smooth_step(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// Of a reflectance or radiance, cut at 0 and 1.
inline std::uint16_t texture_sample(double value) {
    return static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, 1.0) * 65535));
}

/// A blue cloth with two crossed golden bands, a fine grid and a large letter F: it shows at a glance what is upright,
/// inverted, mirrored or magnified. 512 texels square.
std::shared_ptr<const Texture> robe_texture();

/// Constant patches, 4 x 4, all of different radiance; row 0 is the top row of the image.
inline constexpr int patch_rows = 4, patch_columns = 4;
Rgb patch_radiance(int column, int row);
std::shared_ptr<const Texture> patches_texture(int texels_per_patch);

} // namespace threefold
