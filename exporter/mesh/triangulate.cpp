// SPDX-License-Identifier: MIT
#include "exporter/mesh/triangulate.h"

#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>

namespace threefold {

namespace {

/// Twice the area of a triangle in the plane, positive where it turns to the left.
double turn(Vec2 a, Vec2 b, Vec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// Twice the polygon's area as a vector along its normal (Newell).
Vec3 area_of(std::span<const Vec3> polygon) {
    Vec3 sum(0);
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        sum += glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    return sum;
}

/// Along the axis that is nearest to the normal: exact in the other two coordinates.
std::vector<Vec2> flattened(std::span<const Vec3> polygon, Vec3 normal) {
    int along = 0;
    for (int k = 1; k < 3; ++k)
        if (std::abs(normal[k]) > std::abs(normal[along])) along = k;
    const int x = (along + 1) % 3, y = (along + 2) % 3;
    std::vector<Vec2> flat;
    flat.reserve(polygon.size());
    for (const Vec3 &p : polygon) flat.push_back(normal[along] < 0 ? Vec2(p[y], p[x]) : Vec2(p[x], p[y]));
    return flat;
}

/// Inside or on the border, but for a corner's own place.
bool holds(Vec2 a, Vec2 b, Vec2 c, Vec2 p) {
    if (p == a || p == b || p == c) return false;
    return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

} // namespace

std::vector<std::array<std::size_t, 3>> triangulate(std::span<const Vec3> polygon) {
    std::vector<std::array<std::size_t, 3>> triangles;
    const Vec3 area = area_of(polygon);
    if (polygon.size() < 3 || !(glm::length(area) > 0)) return triangles;
    const std::vector<Vec2> at = flattened(polygon, area);
    std::vector<std::size_t> left(polygon.size());
    std::iota(left.begin(), left.end(), 0);
    const auto is_ear = [&](std::size_t i) {
        const std::size_t n = left.size(), before = left[(i + n - 1) % n], here = left[i], after = left[(i + 1) % n];
        if (!(turn(at[before], at[here], at[after]) > 0)) return false;
        for (const std::size_t other : left)
            if (other != before && other != here && other != after && holds(at[before], at[here], at[after], at[other]))
                return false;
        return true;
    };
    const auto cut = [&](std::size_t i) {
        const std::size_t n = left.size(), before = left[(i + n - 1) % n], here = left[i], after = left[(i + 1) % n];
        if (glm::cross(polygon[here] - polygon[before], polygon[after] - polygon[before]) != Vec3(0))
            triangles.push_back({before, here, after});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
    };
    std::size_t i = 0;
    for (std::size_t tried = 0; left.size() > 3;) {
        if (is_ear(i)) {
            cut(i);
            tried = 0;
        } else {
            ++tried;
            ++i;
        }
        if (i >= left.size()) i = 0;
        if (tried <= left.size()) continue;
        // No ear is left where corners lie on a line, or the polygon crosses itself: a corner that adds least goes.
        std::size_t flattest = 0;
        double least = HUGE_VAL;
        for (std::size_t k = 0; k < left.size(); ++k) {
            const std::size_t n = left.size();
            const double t = std::abs(turn(at[left[(k + n - 1) % n]], at[left[k]], at[left[(k + 1) % n]]));
            if (t < least) {
                least = t;
                flattest = k;
            }
        }
        cut(flattest);
        tried = 0;
        i = 0;
    }
    cut(1);
    return triangles;
}

} // namespace threefold
