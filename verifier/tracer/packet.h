// SPDX-License-Identifier: MIT
// Eight rays at once through one ball or shell of glass: the same light as trace_orb (orb.h), by vector units.
//
// In the plane of incidence a state is where the light is on its sphere and how much of it there is. Where follows from
// how often it crossed the wall and the hollow: wall^a * hollow^m, two tables of powers. So a state is a weight alone,
// and a step of all states is a handful of products; a ray in space is only made for light that leaves.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/camera.h"
#include "verifier/tracer/lanes.h"
#include "verifier/tracer/orb.h"
#include "verifier/tracer/sampler.h"

namespace threefold::tracer {

struct EntryPacket {
    Lanes distance, impact, depth;
    LaneVectors foot;
    std::uint32_t hits = 0; ///< bit by lane
};

/// Light on its way out: one ray and weight by lane. `greatest` of the weights.
struct ExitPacket {
    LaneVectors origin, direction;
    Lanes weight;
    double greatest;
};

/// What a packet leaves behind, and scratch memory of one thread.
struct PacketScratch {
    std::vector<ExitPacket> exits; ///< the first `count` hold
    std::size_t count = 0;
    Lanes dropped; ///< weight that was cut off, by lane

    struct State {
        Lanes inward, outward, hollow; ///< weights; as in trace_orb
    };
    struct Power {
        Lanes cosine, sine;
    };
    std::vector<State> now, next;
    std::vector<Power> wall, hollow; ///< turns by an even number of walls, and by crossings of the hollow
};

/// The camera's rays through eight samples of a pixel, `first` and those after it; `corner_px`: of the pixel, offsets
/// of the film added. As PixelSampler::position and Film::ray.
void camera_rays(const Film &film, const PixelSampler &sampler, std::uint32_t first, Vec2 corner_px, RayPacket &rays);

/// As `intersect` in orb.h, of all lanes.
void intersect(const Orb<double> &orb, const RayPacket &rays, EntryPacket &entry);

/// Of the lanes in `active`, those that go through the hollow, or those that do not, whichever the first of them does.
std::uint32_t same_way(const Orb<double> &orb, const EntryPacket &entry, std::uint32_t active);

/// Follows the light of the lanes in `active` until the weight inside is below `cut` in each, dropping no more than
/// that in all; or, with a `roulette` that is not 0 (a seed), letting what is lighter go on at random, seven in eight
/// not and the eighth with eight times the weight: then nothing is dropped. False, with nothing done, where some lanes
/// go through the hollow and others do not (see same_way), or the glass is coated: ask trace_orb for each.
bool trace_packet(const Orb<double> &orb, const RayPacket &rays, const EntryPacket &entry, std::uint32_t active,
                  double cut, std::uint64_t roulette, PacketScratch &scratch);

} // namespace threefold::tracer
