// SPDX-License-Identifier: MIT
// The hand around an orb of radius 1 at the origin, from its anatomy: half a second's work, done when Threefold is
// built (stored_figure.h).
#pragma once

#include "scenes/scene.h"

namespace threefold::figure {

/// The box in which it is.
inline constexpr Vec3 hand_low{-1.45, -2.2, -2.8}, hand_high{1.45, -0.1, 1.25};

/// No vertex inside the orb, some on it; without texture coordinates.
Mesh make_hand_shape();

} // namespace threefold::figure
