// SPDX-License-Identifier: MIT
// Where a scene stands in other programs' coordinates: they add fixed distances (epsilons) and round relative to the
// origin, so an adapter moves the orb there and picks a unit from the extent and the smallest gap. Millimetres.
#pragma once

#include <vector>

#include "scenes/access.h"
#include "scenes/scene.h"

namespace threefold {

struct Frame {
    Vec3 origin_mm{0};          ///< the centre of the first glass object, else the camera's target
    double extent_mm = 0;       ///< the farthest of eye, vertices and spheres from the origin
    double smallest_gap_mm = 0; ///< the least wall, ball radius, hollow or clearance of glass; infinite without glass
    double smallest_sphere_mm = 0; ///< the least radius of a glass surface; infinite without glass
};

Frame render_frame(const Scene &scene);

/// Every surface of glass: the balls, and of shells the outer and, where there is a hollow, the inner one.
std::vector<Sphere> glass_spheres(const Scene &scene);

} // namespace threefold
