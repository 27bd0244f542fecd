// SPDX-License-Identifier: MIT
// The sphere as formats for display get it, with smooth normals: a tenth of a thousandth of the radius is below what a
// screen shows. Renderers that are judged choose their own.
#pragma once

#include "exporter/blender/icosphere.h"

namespace threefold {

inline constexpr double display_tolerance = 1e-4; ///< of the radius

inline IcosphereFit display_sphere() { return *coarsest_icosphere(display_tolerance); }

/// Throws Error(bad_data) for the probe, whose values only a renderer computes.
void refuse_coordinate_card(const Scene &scene, std::string_view title);

} // namespace threefold
