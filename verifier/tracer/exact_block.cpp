// SPDX-License-Identifier: MIT
#include "verifier/tracer/exact_block.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

namespace threefold::tracer {

namespace {

/// Where the ray meets the plane, from `corner` on.
std::optional<Vec3> met_from(Vec3 corner, Vec3 normal, Vec3 origin_mm, Vec3 direction, double rounding_mm) {
    const double slope = glm::dot(direction, normal), along = glm::dot(corner - origin_mm, normal);
    // Ahead of the ray where both have one sign.
    if (!(std::copysign(along, along * slope) > rounding_mm * glm::length(normal))) return std::nullopt;
    return origin_mm + along / slope * direction - corner;
}

} // namespace

bool blocks(const Mesh &mesh, std::uint32_t triangle, Vec3 origin_mm, Vec3 direction, double rounding_mm) {
    const glm::uvec3 t = mesh.triangles[triangle];
    const Vec3 a = mesh.vertices_mm[t.x], ab = mesh.vertices_mm[t.y] - a, ac = mesh.vertices_mm[t.z] - a;
    const Vec3 n = glm::cross(ab, ac);
    const auto p = met_from(a, n, origin_mm, direction, rounding_mm);
    if (!p) return false;
    const double area2 = glm::dot(n, n), b = glm::dot(glm::cross(*p, ac), n), c = glm::dot(glm::cross(ab, *p), n);
    return b >= 0 && c >= 0 && b + c <= area2;
}

bool blocks(const Quad &quad, Vec3 origin_mm, Vec3 direction, double rounding_mm) {
    const Vec3 n = glm::cross(quad.half_u_mm, quad.half_v_mm);
    const auto p = met_from(quad.centre_mm, n, origin_mm, direction, rounding_mm);
    return p && std::abs(glm::dot(*p, quad.half_u_mm)) <= glm::dot(quad.half_u_mm, quad.half_u_mm) &&
           std::abs(glm::dot(*p, quad.half_v_mm)) <= glm::dot(quad.half_v_mm, quad.half_v_mm);
}

void ExactShapes::put(std::size_t object, Pointer shape) {
    if (shapes_.size() <= object) shapes_.resize(object + 1);
    shapes_[object] = shape;
}

void ExactShapes::reach_to(double distance_mm) { reach_mm_ = std::max(reach_mm_, distance_mm); }

bool ExactShapes::blocks(std::size_t object, std::uint32_t triangle, Vec3 origin_mm, Vec3 direction) const {
    constexpr double rounding = 1e-12; // of a place on a surface, computed in double precision
    return std::visit(
        overloaded{
            [](std::monostate) { return true; },
            [&](const Mesh *m) { return tracer::blocks(*m, triangle, origin_mm, direction, rounding * reach_mm_); },
            [&](const Quad *q) { return tracer::blocks(*q, origin_mm, direction, rounding * reach_mm_); },
        },
        shapes_[object]);
}

} // namespace threefold::tracer
