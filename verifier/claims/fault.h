// SPDX-License-Identifier: MIT
// Known faults, injected into the scene that one renderer gets: what proves that a claim can fail.
#pragma once

#include <string_view>
#include <vector>

#include "scenes/scene.h"

namespace threefold {

enum class Fault {
    index_one_percent,     ///< index of every glass 1 % too high
    wall_doubled,          ///< wall of every shell twice as thick
    inner_surface_missing, ///< every shell is a ball
    camera_one_pixel,      ///< the film is shifted by one pixel to the right
    texture_mirrored,      ///< every image is mirrored, left for right
    radiance_slip,         ///< every emitter and the environment 1 % too bright
    orb_one_millimetre,    ///< every orb stands 1 mm to the right
};

struct FaultEntry {
    Fault fault;
    std::string_view name; ///< "index+1%"
    std::string_view description;
};

/// All of them, for --help and for the power table.
const std::vector<FaultEntry> &faults();
Fault parse_fault(std::string_view name);
std::string_view to_string(Fault fault);

Scene with_fault(Scene scene, Fault fault);

} // namespace threefold
