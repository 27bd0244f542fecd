// SPDX-License-Identifier: MIT
// Meshes and rectangles in an Embree hierarchy: single precision, so what it finds are candidates (surfaces.h).
#pragma once

#include <memory>

#include "scenes/camera.h"
#include "verifier/tracer/lanes.h"

namespace threefold::tracer {

/// The triangle (of a rectangle: 0) that a ray starts on: passed over by name. Its neighbours are met in double
/// precision where the ray starts near their plane.
struct Left {
    std::uint32_t object = 0, triangle = 0;
};

/// What a ray meets first; `object` is `nothing` where there is none. u, v: as Embree counts them.
struct Candidate {
    static constexpr std::uint32_t nothing = ~0u;
    std::uint32_t object = nothing, triangle = 0;
    float distance = 0, u = 0, v = 0;
};

class EmbreeWorld {
public:
    /// Coordinates are kept from `origin_mm` on.
    explicit EmbreeWorld(Vec3 origin_mm);
    ~EmbreeWorld();
    EmbreeWorld(const EmbreeWorld &) = delete;
    EmbreeWorld &operator=(const EmbreeWorld &) = delete;

    /// `object`: a number below 2^32 - 1, the name of what is met. The shape must outlive the world.
    void add(std::size_t object, const Quad &quad);
    void add(std::size_t object, const Mesh &mesh);
    /// After the last, before the first question.
    void commit();

    Candidate intersect(const Ray &ray) const;
    bool blocks(const Ray &ray, Left left) const;

    /// The lanes in `active`, up to a distance by lane (infinite: all the way; a little more than that is looked at).
    void intersect(const RayPacket &rays, std::uint32_t active, const Lanes &limit,
                   Candidate (&candidates)[lanes]) const;
    /// Those lanes of `active` in whose way something stands.
    std::uint32_t blocks(const RayPacket &rays, std::uint32_t active, const Left (&left)[lanes]) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Of the library this was built with: "3.13.5".
std::string embree_version();

} // namespace threefold::tracer
