// SPDX-License-Identifier: MIT
// What lights diffuse surfaces: one definition for every renderer.
#pragma once

#include <vector>

#include "scenes/scene.h"

namespace threefold {

/// The environment as `dome_directions` parallel lights over the whole sphere, each for the same solid angle: the
/// points of a Fibonacci lattice (Swinbank and Purser, 2006), irradiance radiance * 4 pi / N. Empty without a dome.
std::vector<Directional> dome(const Environment &environment);

/// The scene's own lights, then its environment's dome.
std::vector<Directional> lights_on_diffuse(const Scene &scene);

} // namespace threefold
