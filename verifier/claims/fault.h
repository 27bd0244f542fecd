// SPDX-License-Identifier: MIT
// Known faults, injected into what one renderer gets: what proves that a claim can fail, and how small a fault it sees.
// A fault has a kind and, unless it is there or not, a size; each is listed at the size that people make by mistake.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "exporter/job.h"
#include "scenes/scene.h"

namespace threefold {

enum class Fault {
    index_one_percent,     ///< index of every glass 1 % too high
    wall_ten_percent,      ///< wall of every shell 10 % too thick
    wall_doubled,          ///< wall of every shell twice as thick
    inner_normal_flipped,  ///< light that crosses the inner surface of a shell enters glass again
    inner_surface_missing, ///< every shell is a ball
    gamma_slip,            ///< every image is decoded once too often
    four_bounces,          ///< every path ends after its fourth glass surface
    camera_half_pixel,     ///< the film is shifted by half a pixel to the right
    camera_one_pixel,      ///< the film is shifted by one pixel to the right
    light_missing,         ///< one of the scene's lights is off
    texture_mirrored,      ///< every image is mirrored, left for right
    orb_one_millimetre,    ///< every orb stands 1 mm to the right
    tint_forgotten,        ///< the inner surface of a shell takes no light
    radiance_slip,         ///< every emitter and light, and the environment, 1 % too bright
};

struct FaultEntry {
    /// `one`: it is there or not. `real`, `whole`: any size between the honest value and the listed one.
    enum class Sizes { one, real, whole };

    Fault fault;
    std::string_view name; ///< "index+1%"
    std::string_view description;
    std::string_view kind; ///< faults that differ in their size alone share it: "wall"
    std::string_view unit; ///< of the size; empty: a plain number or a share
    Sizes sizes = Sizes::one;
    double listed = 1;                ///< the size that the name says
    double honest = 0;                ///< the size at which nothing is wrong
    double least = 0, greatest = 1e9; ///< what makes sense
};

/// All of them, for --help and for the power table.
const std::vector<FaultEntry> &faults();
const FaultEntry &entry_of(Fault fault);

/// A fault of a size.
struct InjectedFault {
    Fault fault = Fault::index_one_percent;
    double size = 0;

    InjectedFault() = default;
    InjectedFault(Fault listed); ///< of its listed size
    InjectedFault(Fault fault, double size) : fault(fault), size(size) {}
};

Fault parse_fault(std::string_view name);
/// "wall+10%", or of a size of one's own "wall+10%@0.02". Throws Error(usage).
InjectedFault parse_injected_fault(std::string_view text);
std::string_view to_string(Fault fault);
std::string to_string(const InjectedFault &injected);

/// Of what stands in the scene; faults of a renderer's own (`slip_of`) leave it as it is.
Scene with_fault(Scene scene, const InjectedFault &injected);
/// What no scene can say. Empty for a fault of the scene.
Slip slip_of(const InjectedFault &injected);
/// The whole of it.
RenderJob with_fault(RenderJob job, const InjectedFault &injected);

} // namespace threefold
