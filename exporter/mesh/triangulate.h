// SPDX-License-Identifier: MIT
// A polygon as triangles, concave or with corners on a line among them: by ears, in the plane that suits it best.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "scenes/scene.h"

namespace threefold {

/// Corners of each triangle by their numbers in the polygon, turning as the polygon does. Triangles of no area are left
/// out. A polygon that crosses itself has no inside to be covered: what comes then covers something of it.
std::vector<std::array<std::size_t, 3>> triangulate(std::span<const Vec3> polygon);

} // namespace threefold
