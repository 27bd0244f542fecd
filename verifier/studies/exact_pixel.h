// SPDX-License-Identifier: MIT
// Where the ray of a pixel lands on the coordinate card, in quad precision from the scene's own numbers, and how much
// that place depends on each of them. For scenes of one coated orb about which a pinhole or orthographic camera looks
// at one card behind it. Lengths in mm.
// The place comes from the closed forms (Bouguer's invariant); the dependence from Snell's law in vectors at each
// surface, a second way that must agree with the first.
#pragma once

#include "scenes/scene.h"

namespace threefold {

struct ExactPixel {
    bool lands = false;   ///< on the card's plane, ahead of the ray
    Vec2 uv{0};           ///< there, in card coordinates; outside [0, 1] beside the card
    double impact_mm = 0; ///< distance of the pixel's ray from the orb's centre
    double to_edge_mm =
        0; ///< to the nearest impact at which light takes another way: the outer radius, inner, index * inner

    /// What relative changes of all given numbers do, summed over them: nobody can know the landing better than one
    /// rounding of the given numbers times this. Places count from the orb's centre.
    double condition_mm = 0, impact_condition_mm = 0; ///< of the landing, and of the impact

    // By how much the landing moves, mm a mm or a pixel.
    double per_shift = 0;                ///< of the orb
    double per_outer = 0, per_inner = 0; ///< of one radius alone
    double per_pixel_mm = 0;             ///< of the sample position, in mm a pixel
    double impact_per_pixel_mm = 0;

    double disagreement_mm = 0; ///< of the two ways
};

/// The pixel's sample as the camera places it. Throws Error(internal) for another kind of scene.
ExactPixel exact_pixel(const Scene &scene, int column, int row);

} // namespace threefold
