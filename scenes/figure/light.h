// SPDX-License-Identifier: MIT
// The study's light, as its scene files have it: a cluster of directions that stands for a soft main light from above,
// and two more. Frame of the vocabulary: the eye on +z looks towards -z, image right is +x.
#pragma once

#include <vector>

#include "scenes/scene.h"

namespace threefold {

inline constexpr int key_light_directions = 100;
inline constexpr double key_light_irradiance = 0.0416; ///< of each direction
inline constexpr double side_light_irradiance = 0.3, front_light_irradiance = 0.6;
inline constexpr double study_environment_radiance = 0.02;

/// The cluster: polar angles from straight down 32.5, 35.5, ... 44.5 degrees, times 20 azimuths evenly from 55 to 85.
std::vector<Directional> key_lights();
/// The cluster, then the light from above (polar angle 40, azimuth 90 degrees), then the frontal one.
std::vector<Directional> study_lights();

} // namespace threefold
