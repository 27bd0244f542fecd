// SPDX-License-Identifier: MIT
// Eight rays at once through one ball or shell of glass: the same light as trace_orb (orb.h), by vector units.
//
// In the plane of incidence a state is where the light is on its sphere and how much of it there is. Where follows from
// how often it crossed the wall and the hollow: wall^a * hollow^m, two tables of powers. So a state is a weight alone,
// and a step of all states is a handful of products; a ray in space is only made for light that leaves.
// The loops over the lanes are written so that the compiler turns them into vector instructions. packet.cpp is compiled
// for several instruction sets, of which the loader takes the best that the machine has; without contraction of
// products and sums all of them give the same bits.
#pragma once

#include <cstdint>
#include <vector>

#include "scenes/camera.h"
#include "verifier/tracer/orb.h"
#include "verifier/tracer/sampler.h"

namespace threefold::tracer {

inline constexpr int lanes = 8;

struct alignas(64) Lanes {
    double v[lanes];
    double &operator[](int lane) { return v[lane]; }
    double operator[](int lane) const { return v[lane]; }
};

struct LaneVectors {
    Lanes x, y, z;
    Vec3 at(int lane) const { return {x[lane], y[lane], z[lane]}; }
    void put(int lane, Vec3 p) {
        x[lane] = p.x;
        y[lane] = p.y;
        z[lane] = p.z;
    }
};

/// Rays of one pixel; every lane holds a ray, of use or not.
struct RayPacket {
    LaneVectors origin, direction;
};

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

/// Follows the light of the lanes in `active` until the weight inside is below `cut` in each, dropping no more than
/// that in all; or, with a `roulette` that is not 0 (a seed), letting what is lighter go on at random, seven in eight
/// not and the eighth with eight times the weight: then nothing is dropped. False, with nothing done, where some lanes
/// go through the hollow and others do not, or the glass is coated: ask trace_orb for each.
bool trace_packet(const Orb<double> &orb, const RayPacket &rays, const EntryPacket &entry, std::uint32_t active,
                  double cut, std::uint64_t roulette, PacketScratch &scratch);

/// A rectangle, ready to be met: u and v of a point p are 1/2 + dot(p - centre, along_u or along_v).
struct Rectangle {
    std::size_t object;
    Vec3 centre, normal, along_u, along_v;

    Rectangle(std::size_t index, const Quad &q)
        : object(index), centre(q.centre_mm), normal(glm::normalize(glm::cross(q.half_u_mm, q.half_v_mm))),
          along_u(0.5 * q.half_u_mm / glm::dot(q.half_u_mm, q.half_u_mm)),
          along_v(0.5 * q.half_v_mm / glm::dot(q.half_v_mm, q.half_v_mm)) {}
};

/// The nearest rectangle on each ray: its place in the list or -1, the distance (infinite where there is none), and the
/// point's coordinates.
struct RectangleHits {
    Lanes which, distance, u, v;
};
void meet_rectangles(const std::vector<Rectangle> &rectangles, const LaneVectors &origin, const LaneVectors &direction,
                     RectangleHits &hits);

} // namespace threefold::tracer
