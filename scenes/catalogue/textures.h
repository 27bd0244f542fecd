// SPDX-License-Identifier: MIT
// Generated images of the catalogue's scenes.
#pragma once

#include <array>
#include <memory>

#include "scenes/scene.h"

namespace threefold {

/// 0 up to `from`, 1 beyond `to`, smooth between.
double smooth_step(double from, double to, double x);

/// A blue cloth with two crossed golden bands, a fine grid and a large letter F: it shows at a glance what is upright,
/// inverted, mirrored or magnified. `side` texels square.
std::shared_ptr<const Texture> robe_texture(int side);

/// Constant patches, 4 x 4, all of different radiance; row 0 is the top row of the image.
inline constexpr int patch_rows = 4, patch_columns = 4;
Rgb patch_radiance(int column, int row);
std::shared_ptr<const Texture> patches_texture(int texels_per_patch);

} // namespace threefold
