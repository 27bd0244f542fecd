// SPDX-License-Identifier: MIT
// What an image means between its samples.
#pragma once

#include "scenes/scene.h"

namespace threefold {

/// Bilinear between texel centres, clamped at the edges; uv (0, 0) is the lower left corner of the image.
Rgb sample(const Texture &texture, Vec2 uv);
Rgb sample(const Paint &paint, Vec2 uv);
/// The mean of the three channels.
inline double grey(Rgb c) { return (c.r + c.g + c.b) / 3; }
/// The greatest value of each channel.
Rgb greatest_value(const Paint &paint);

} // namespace threefold
