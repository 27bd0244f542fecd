// SPDX-License-Identifier: MIT
// How near a mesh comes to a point or a sphere: exact, over whole triangles. Millimetres.
#pragma once

#include "scenes/scene.h"

namespace threefold::figure {

/// The point of the triangle that is nearest to `p`.
Vec3 nearest_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c);

/// Smallest distance from `p` to any triangle; infinite for a mesh without triangles.
double distance_to(const Mesh &mesh, Vec3 p);

} // namespace threefold::figure
