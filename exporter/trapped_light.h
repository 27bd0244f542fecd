// SPDX-License-Identifier: MIT
// Light that goes round inside glass for longer than a renderer follows it. At the rim of an orb hardly any light
// leaves at each reflection; a limit on a path's length then takes what is left, without a word.
#pragma once

#include "scenes/scene.h"

namespace threefold {

/// The share of the picture's rays' light that is lost where a path ends with the `most_interfaces`-th surface of glass
/// that it meets, the way out at that one included: mean over rays through a grid of the picture's pixels, 0 to 1. By
/// unpolarised Fresnel shares, each the same at every meeting with a sphere. Of each ray the first orb counts.
double trapped_light(const Scene &scene, int most_interfaces);

/// An adapter refuses a picture that would lack more than this.
inline constexpr double most_trapped_light = 1e-3;

} // namespace threefold
