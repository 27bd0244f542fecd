// SPDX-License-Identifier: MIT
// What each pixel of a picture shows first, glass left out, and in what light without shadows. World frame,
// millimetres.
#pragma once

#include <vector>

#include "scenes/scene.h"

namespace threefold {

struct SeenPoint {
    double depth_mm;        ///< along the view; infinite where nothing is seen
    Vec3 point_mm, normal;  ///< the normal is of unit length and points to the eye
    double reflectance = 0; ///< mean of the channels; 0 for what emits
    double radiance = 0;    ///< mean of the channels, in full light; the environment's where nothing is seen

    bool is_surface() const { return depth_mm < 1e300; }
};

/// Row by row, in the pixels' centres.
std::vector<SeenPoint> first_seen(const Scene &scene);

} // namespace threefold
