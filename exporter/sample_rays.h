// SPDX-License-Identifier: MIT
// A few rays that stand for all of a picture, to foresee how much of it a renderer would get wrong.
#pragma once

#include <vector>

#include "scenes/camera.h"

namespace threefold {

/// Through the middles of a grid over the whole picture, one a pixel up to 48 a side; row by row.
std::vector<Ray> sample_rays(const Camera &camera);

/// How a ray passes a point: the distance along it to the nearest place (negative: behind), and from there to the
/// point.
struct Passing {
    double along_mm, impact_mm;
};
Passing pass(const Ray &ray, Vec3 point_mm);

} // namespace threefold
