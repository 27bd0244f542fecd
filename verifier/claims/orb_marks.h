// SPDX-License-Identifier: MIT
// Where an orb is seen in a picture: circles of equal impact parameter, as marks of the report and as columns.
#pragma once

#include <string>

#include "scenes/camera.h"
#include "verifier/agreement/result.h"
#include "verifier/claims/prediction.h"

namespace threefold {

/// Image position (in the crop, when there is one) of a point in front of a perspective camera.
Vec2 image_of(const Camera &camera, Vec3 point_mm);

/// Image x on a row, right of the orb's centre, where the ray has this impact parameter.
double column_of(const Camera &camera, const OrbInScene &orb, double impact_mm, double row);

/// The circle in which rays of this impact parameter are seen; for an eye that looks at the orb's centre.
Mark impact_circle(const Camera &camera, const OrbInScene &orb, double impact_mm, Mark::Meaning meaning,
                   std::string label);

} // namespace threefold
