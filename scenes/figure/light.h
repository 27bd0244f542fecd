// SPDX-License-Identifier: MIT
// The study's light: a soft main light from above, one more from above, one from the eye's side.
// Frame: that of scenes/scene.h; the study's (x, y, z) is our (-z, y, x).
#pragma once

#include <vector>

#include "scenes/scene.h"

namespace threefold::figure {

/// 100 directions of irradiance 0.0416 around the main one, one of 0.3 from above, one of 0.6 along the view.
std::vector<Directional> study_lights();

} // namespace threefold::figure
