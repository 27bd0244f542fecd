// SPDX-License-Identifier: MIT
// Everything that is not glass: rectangles and meshes, and where a ray meets them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verifier/tracer/embree_world.h"
#include "verifier/tracer/rectangles.h"

namespace threefold::tracer {

struct SurfaceHit {
    double distance = 0;
    Vec3 position{0};
    std::size_t object = 0; ///< index into scene.objects
    std::uint32_t triangle = 0;
    Vec2 uv{0};
    Vec3 normal{0}; ///< unit, towards the side the ray came from

    Left left() const { return {static_cast<std::uint32_t>(object), triangle}; }
};

/// Embree's numbers are single: they are finest about the orb, or else about the middle of what can be met. Where the
/// camera looks must not matter.
Vec3 finest_about(const Scene &scene);

/// Is there more to meet than a few rectangles, even in double precision?
bool needs_embree(const Scene &scene);

/// Embree finds candidates in single precision; where `exact`, distance, uv and normal are then computed in double from
/// the scene's own numbers. A ray that starts on a surface names it, so that no epsilon is needed. A few rectangles are
/// met one by one instead, in double precision; without a mesh there is no Embree at all.
class Surfaces {
public:
    Surfaces(const Scene &scene, bool exact);

    std::optional<SurfaceHit> intersect(const Ray &ray) const;

    /// Is anything in the way of a ray that leaves a surface at `left`?
    bool blocks(const Ray &ray, const SurfaceHit &left) const;

    /// The lanes of `active` that meet a surface no further than `limit`, and where.
    std::uint32_t intersect(const RayPacket &rays, std::uint32_t active, const Lanes &limit,
                            SurfaceHit (&hits)[lanes]) const;

    /// The lanes of `active` in whose way something stands, of rays that leave the surfaces `left`.
    std::uint32_t blocks(const RayPacket &rays, std::uint32_t active, const Left (&left)[lanes]) const;

    /// The rectangles that are met one by one, in double precision; with `only_rectangles` there is nothing else.
    const std::vector<Rectangle> &rectangles() const { return rectangles_; }
    bool only_rectangles() const { return !world_; }

private:
    SurfaceHit refine(Vec3 origin, Vec3 direction, const Candidate &found) const;

    const Scene *scene_;
    std::vector<Rectangle> rectangles_; ///< those that are not in Embree's world
    std::unique_ptr<EmbreeWorld> world_;
    bool exact_;
};

} // namespace threefold::tracer
