// SPDX-License-Identifier: MIT
// Triangles of flat shapes, and distances to them. Millimetres.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "scenes/scene.h"

namespace threefold {

struct Triangle {
    Vec3 a, b, c;
};

inline Triangle triangle_of(const Mesh &mesh, std::size_t index) {
    const glm::uvec3 t = mesh.triangles[index];
    return {mesh.vertices_mm[t.x], mesh.vertices_mm[t.y], mesh.vertices_mm[t.z]};
}

/// Calls `f` with each triangle of a flat shape, none of a sphere. No list of them is made: a mesh may have millions.
template <class F>
void for_each_triangle(const Shape &shape, F f) {
    std::visit(overloaded{
                   [](const GlassBall &) {},
                   [](const GlassShell &) {},
                   [&](const Quad &quad) {
                       const Vec3 a = quad.centre_mm - quad.half_u_mm - quad.half_v_mm, b = a + 2.0 * quad.half_u_mm,
                                  c = b + 2.0 * quad.half_v_mm, d = a + 2.0 * quad.half_v_mm;
                       f(Triangle{a, b, c});
                       f(Triangle{a, c, d});
                   },
                   [&](const Mesh &mesh) {
                       for (std::size_t i = 0; i < mesh.triangles.size(); ++i) f(triangle_of(mesh, i));
                   },
               },
               shape);
}

inline double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
    const Vec3 ab = b - a;
    const double length_squared = glm::dot(ab, ab);
    const double t = length_squared > 0 ? std::clamp(glm::dot(p - a, ab) / length_squared, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + t * ab);
}

/// To the nearest point of the triangle: above its inside, or on an edge.
inline double distance_to_triangle(Vec3 p, const Triangle &t) {
    const Vec3 normal = glm::cross(t.b - t.a, t.c - t.a);
    const double area = glm::length(normal);
    const bool over_inside = area > 0 && glm::dot(glm::cross(t.b - t.a, p - t.a), normal) >= 0 &&
                             glm::dot(glm::cross(t.c - t.b, p - t.b), normal) >= 0 &&
                             glm::dot(glm::cross(t.a - t.c, p - t.c), normal) >= 0;
    if (over_inside) return std::abs(glm::dot(p - t.a, normal)) / area;
    return std::min(
        {distance_to_segment(p, t.a, t.b), distance_to_segment(p, t.b, t.c), distance_to_segment(p, t.c, t.a)});
}

/// Of the nearest point of any triangle; infinite for a mesh without triangles.
inline double distance_to(const Mesh &mesh, Vec3 p) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        least = std::min(least, distance_to_triangle(p, triangle_of(mesh, i)));
    return least;
}

} // namespace threefold
