// SPDX-License-Identifier: MIT
// A few rectangles, met one by one and eight rays at once, in double precision.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include "verifier/tracer/lanes.h"

namespace threefold::tracer {

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

/// The lanes whose rays meet any rectangle but that of object `left` (a number by lane).
std::uint32_t rectangles_block(const std::vector<Rectangle> &rectangles, const RayPacket &rays, const Lanes &left);

} // namespace threefold::tracer
