// SPDX-License-Identifier: MIT
// A generated hand that holds an orb from below: palm under and behind it, four fingers in front, the thumb at the
// picture's right. It touches the orb and is nowhere inside it. Frame: that of scenes/scene.h.
#pragma once

#include <memory>

#include "scenes/scene.h"

namespace threefold::figure {

/// As large as the orb wants it. Its smallest distance from the orb, over whole triangles, is at least half of
/// contact_gap_mm(radius) and at most four times that. With texture coordinates; grey.
Mesh holding_hand(Vec3 orb_centre_mm, double orb_radius_mm);

/// What is left between skin and glass: 0.1 mm, less for small orbs. Under it a renderer's sphere of facets would
/// cut the skin.
double contact_gap_mm(double orb_radius_mm);

std::shared_ptr<const Texture> hand_texture();

} // namespace threefold::figure
