// SPDX-License-Identifier: MIT
// What of the figure no parameter changes: made by store_figure.cpp when Threefold is built, kept in the library.
#pragma once

#include "scenes/scene.h"

namespace threefold::figure {

/// make_hand_shape() of hand_shape.h.
Mesh stored_hand_shape();
/// paint_heights() of painted_relief.h for usual_relief_columns.
std::vector<double> stored_heights();
/// paint_relief_texture() of painted_relief.h.
std::vector<std::uint16_t> stored_relief_texture();

/// paint_robe_texture() of scenes/catalogue/painted_robe.h.
std::vector<std::uint16_t> stored_robe_texture();

/// What precedes the lists in the stored bytes: how long they are. They follow in this order, as they lie in memory.
struct StoredCounts {
    std::uint64_t hand_vertices, heights, hand_triangles, relief_samples, robe_samples;
};

} // namespace threefold::figure
