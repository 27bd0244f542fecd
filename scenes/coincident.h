// SPDX-License-Identifier: MIT
// Surfaces in one place: which of them is seen, rounding decides, another at each pixel and in each renderer.
#pragma once

#include "scenes/scene.h"

namespace threefold {

/// The rectangles lie in one plane, to what single precision tells apart, and share more than an edge.
bool coincide(const Quad &a, const Quad &b);

} // namespace threefold
