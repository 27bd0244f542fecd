// SPDX-License-Identifier: MIT
#include "verifier/tracer/rectangles.h"

#include <limits>

namespace threefold::tracer {

namespace {

struct Meeting {
    double distance, u, v;
    bool met;
};

THREEFOLD_INLINE Meeting meet(const Rectangle &q, const LaneVectors &origin, const LaneVectors &direction, int l) {
    const double ox = origin.x.v[l], oy = origin.y.v[l], oz = origin.z.v[l];
    const double dx = direction.x.v[l], dy = direction.y.v[l], dz = direction.z.v[l];
    const double slope = dx * q.normal.x + dy * q.normal.y + dz * q.normal.z;
    const double distance =
        ((q.centre.x - ox) * q.normal.x + (q.centre.y - oy) * q.normal.y + (q.centre.z - oz) * q.normal.z) / slope;
    const double px = ox + distance * dx - q.centre.x, py = oy + distance * dy - q.centre.y,
                 pz = oz + distance * dz - q.centre.z;
    const double u = 0.5 + (px * q.along_u.x + py * q.along_u.y + pz * q.along_u.z);
    const double v = 0.5 + (px * q.along_v.x + py * q.along_v.y + pz * q.along_v.z);
    const bool met = (distance >= 0) & (u >= 0) & (u <= 1) & (v >= 0) & (v <= 1);
    return {distance, u, v, met};
}

} // namespace

THREEFOLD_VECTOR
void meet_rectangles(const std::vector<Rectangle> &rectangles, const LaneVectors &origin, const LaneVectors &direction,
                     RectangleHits &hits) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) {
        hits.which.v[l] = -1;
        hits.distance.v[l] = infinite;
        hits.u.v[l] = hits.v.v[l] = 0;
    }
    for (std::size_t i = 0; i < rectangles.size(); ++i) {
        const Rectangle &q = rectangles[i];
        const double number = static_cast<double>(i);
        THREEFOLD_LANES
        for (int l = 0; l < lanes; ++l) {
            const Meeting m = meet(q, origin, direction, l);
            const bool nearer = m.met & (m.distance < hits.distance.v[l]);
            hits.which.v[l] = nearer ? number : hits.which.v[l];
            hits.distance.v[l] = nearer ? m.distance : hits.distance.v[l];
            hits.u.v[l] = nearer ? m.u : hits.u.v[l];
            hits.v.v[l] = nearer ? m.v : hits.v.v[l];
        }
    }
}

THREEFOLD_VECTOR
std::uint32_t rectangles_block(const std::vector<Rectangle> &rectangles, const RayPacket &rays, const Lanes &left) {
    Lanes blocked;
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) blocked.v[l] = 0;
    for (const Rectangle &q : rectangles) {
        const double object = static_cast<double>(q.object);
        THREEFOLD_LANES
        for (int l = 0; l < lanes; ++l) {
            const Meeting m = meet(q, rays.origin, rays.direction, l);
            blocked.v[l] = (m.met & (left.v[l] != object)) ? 1 : blocked.v[l];
        }
    }
    std::uint32_t bits = 0;
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) bits |= static_cast<std::uint32_t>(blocked.v[l] > 0) << l;
    return bits;
}

} // namespace threefold::tracer
