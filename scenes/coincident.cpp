// SPDX-License-Identifier: MIT
#include "scenes/coincident.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace threefold {

namespace {

constexpr double in_plane = 2e-7; ///< of the size, and of a right angle

double size_mm(const Quad &q) { return glm::length(q.half_u_mm) + glm::length(q.half_v_mm); }

/// Half of what the rectangle covers of an axis.
double half_extent(const Quad &q, Vec3 axis) {
    return std::abs(glm::dot(q.half_u_mm, axis)) + std::abs(glm::dot(q.half_v_mm, axis));
}

} // namespace

bool coincide(const Quad &a, const Quad &b) {
    const Vec3 normal = glm::normalize(glm::cross(a.half_u_mm, a.half_v_mm)),
               other = glm::normalize(glm::cross(b.half_u_mm, b.half_v_mm)), apart = b.centre_mm - a.centre_mm;
    const double size = std::max(size_mm(a), size_mm(b));
    if (glm::length(glm::cross(normal, other)) > in_plane || std::abs(glm::dot(apart, normal)) > in_plane * size)
        return false;
    // Apart along the side of either: the theorem of separating axes.
    return std::ranges::none_of(std::array{a.half_u_mm, a.half_v_mm, b.half_u_mm, b.half_v_mm}, [&](Vec3 side) {
        const Vec3 axis = glm::normalize(side);
        return std::abs(glm::dot(apart, axis)) >= half_extent(a, axis) + half_extent(b, axis) - in_plane * size;
    });
}

} // namespace threefold
