// SPDX-License-Identifier: MIT
// Rays that graze an orb, which a sphere of triangles cannot answer for.
#pragma once

#include "scenes/scene.h"

namespace threefold {

/// So near the edge of an orb of this radius, or of a hollow, inside or out, light may go astray when its mesh strays
/// by `surface_mm`. A ray of impact R - x meets the surface at the angle sqrt(2 x / R) only. A mesh that strays by d
/// has triangles that lean by up to 2 sqrt(d / R) against the surface: under x = 2 d such a ray runs along them or
/// meets them from behind. And single precision takes its share whatever the mesh. Measured at eight to twelve places
/// of the rim, the share of rays through coated glass that are lost, x and d in radii:
///   d = 1.4e-4: 30 % at x = 2.1e-4, none to speak of at 4.3e-4
///   d = 3.6e-5: 61 % at 7e-5, 21 % at 1.2e-4, 0.4 % at 2.1e-4
///   d = 8.9e-6: all at 1e-5, 6 % at 1e-4, 3e-4 at 1.5e-4
///   d = 2.2e-6: 33 % at 4.5e-5, 9 % at 6.7e-5, 6e-4 at 1e-4
/// Into a hollow of radius r light leaves the glass as grazing as it came past r: at x = 1e-4 it landed up to 0.03 R
/// off, 2.6 times what the mesh's distance explains.
double grazing_mm(double radius_mm, double surface_mm);

/// The share of the picture's rays that pass the edge of an orb or of its hollow nearer than that.
double grazing_share(const Scene &scene, double surface_mm);

/// The adapter refuses a picture with more of them: one that looks at little else. A whole orb has a few thousandths
/// with the usual mesh and some hundredths with a coarse one.
inline constexpr double most_grazing = 0.1;

} // namespace threefold
