// SPDX-License-Identifier: MIT
// What little double refraction there is in glass: strain left from cooling, told as a path difference per length.
#pragma once

#include <cmath>
#include <numbers>

namespace threefold::optics {

/// Difference of the two indices, from nanometres of path difference per centimetre of glass.
inline double strain_index_difference(double nm_per_cm) { return nm_per_cm * 1e-7; }

/// Share of the light that a retarder at 45 degrees turns from one linear polarisation into the other: sin^2 of half
/// the phase difference (Born & Wolf 15.4.2). At any other angle it is less.
inline double exchanged_share(double path_difference_nm, double wavelength_nm) {
    const double quarter_turns = std::fmin(path_difference_nm / wavelength_nm, 0.5); // from half a wave on: all of it
    return std::pow(std::sin(std::numbers::pi * quarter_turns), 2);
}

} // namespace threefold::optics
