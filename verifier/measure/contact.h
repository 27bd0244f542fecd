// SPDX-License-Identifier: MIT
// How near a mesh comes to a sphere. Exact up to rounding: over whole triangles, not over vertices. Millimetres.
#pragma once

#include "scenes/access.h"

namespace threefold {

/// Smallest distance between the mesh and the sphere's surface, the sphere being a body: negative where they overlap,
/// by the depth of the mesh's deepest point in it (or of the sphere in a mesh that swallows it whole).
double clearance_mm(const Mesh &mesh, const Sphere &sphere);

} // namespace threefold
