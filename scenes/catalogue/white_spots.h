// SPDX-License-Identifier: MIT
// The three points of the study on the front of the orb, and the sources that are mirrored there. World frame, mm.
#pragma once

#include "scenes/parameters.h"

namespace threefold {

inline constexpr int spot_count = 3;

/// On the orb's front, for an orb at the origin.
Vec3 white_spot(const Parameters &p, int spot);
/// Where the source stands whose mirror image an eye at eye.distance_mm sees there.
Vec3 white_spot_source(const Parameters &p, int spot);

} // namespace threefold
