// SPDX-License-Identifier: MIT
// What the pictures of the whole figure share: relief, hand, orb, ground and light, and where they stand.
// The eye is on +z and looks along -z, beside and above the orb at the origin (the study's frame: its x, y, z are our
// z, y, -x). Whatever the distances, the picture has the same composition.
#pragma once

#include "scenes/catalogue/common.h"
#include "scenes/figure/relief.h"

namespace threefold {

/// Everything but the image's size.
Specs composition_parameters();
Specs picture_size_parameters(int width_px, int height_px);

figure::Standpoint standpoint(const Parameters &p);
Camera eye_camera(const Parameters &p);

/// Orb, hand, relief and ground, the lights, the environment: all but the camera. Objects are named "orb", "hand",
/// "robe" and "ground".
Scene composition(const Parameters &p);

/// With figure.surface=identity: what each object emits. All else is black.
Rgb identity_colour(std::string_view object);

} // namespace threefold
