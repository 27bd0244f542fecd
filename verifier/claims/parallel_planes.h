// SPDX-License-Identifier: MIT
// Light that two parallel diffuse planes throw on each other, where nothing changes along one direction: a wall at
// distance `gap_mm` behind a board that reaches from height 0 to `board_mm`. Lengths in millimetres.
//
// Between long parallel strips a share of gap^2 / (2 (gap^2 + dy^2)^(3/2)) dy of what an element receives comes from
// the strip at dy (form factor of an element to an infinitely long strip; Howell, A Catalog of Radiation Heat Transfer
// Configuration Factors, B-5). The two integral equations are solved by iteration on grids; each step adds one more
// reflection, at most the product of both reflectances of the step before.
#pragma once

#include <functional>

namespace threefold {

struct TwoPlanes {
    double gap_mm, board_mm;
    double wall_reflectance, board_reflectance;
    double wall_from_mm, wall_to_mm; ///< the part of the wall that counts
};

/// What the wall receives at a height from the board, over what falls on it directly (`direct`, by height). The board's
/// side to the wall gets no direct light.
std::function<double(double height_mm)> thrown_back(const TwoPlanes &planes,
                                                    const std::function<double(double height_mm)> &direct);

} // namespace threefold
