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

/// The same light in `shares` parts, for a mean over as many samples each of which asks for one part: of the weak
/// lights a part holds every so manieth, so many times as strong, so that a cluster's directions stay spread evenly.
/// Lights that alone are a good part of all are in every part: left out of some, they would leave much noise. The mean
/// over the parts is the whole.
std::vector<std::vector<Directional>> shared_lights(const std::vector<Directional> &lights, std::size_t shares);

} // namespace threefold
