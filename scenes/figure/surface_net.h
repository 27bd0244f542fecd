// SPDX-License-Identifier: MIT
// The surface where a distance-like function vanishes, as a mesh: naive surface nets (Gibson 1998). Any unit of length.
#pragma once

#include <functional>

#include "scenes/scene.h"

namespace threefold::figure {

using Field = std::function<double(Vec3)>;

/// `field` is negative inside and changes by no more than the distance between two points; inside the box
/// [low, high], in cells of the given side. Faces look outwards. Vertices are moved onto the surface along the field's
/// gradient.
Mesh surface_net(const Field &field, Vec3 low, Vec3 high, double cell);

} // namespace threefold::figure
