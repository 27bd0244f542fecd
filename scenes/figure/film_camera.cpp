// SPDX-License-Identifier: MIT
// Built in units of its length, the lens at the origin looking along -z, then moved.
#include "scenes/figure/film_camera.h"

#include <cmath>
#include <numbers>

#include <glm/vec4.hpp>

namespace threefold::figure {

namespace {

void add_box(Mesh &mesh, Vec3 low, Vec3 high) {
    const auto first = static_cast<unsigned>(mesh.vertices_mm.size());
    for (unsigned i = 0; i < 8; ++i)
        mesh.vertices_mm.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    for (const glm::uvec4 q : {glm::uvec4(0, 2, 3, 1), glm::uvec4(4, 5, 7, 6), glm::uvec4(0, 1, 5, 4),
                               glm::uvec4(2, 6, 7, 3), glm::uvec4(0, 4, 6, 2), glm::uvec4(1, 3, 7, 5)}) {
        mesh.triangles.emplace_back(first + q.x, first + q.y, first + q.z);
        mesh.triangles.emplace_back(first + q.x, first + q.z, first + q.w);
    }
}

/// A surface of revolution about `axis` through `origin`; `profile` holds (along the axis, radius).
void add_turned(Mesh &mesh, Vec3 origin, Vec3 axis, Vec3 across, const std::vector<Vec2> &profile) {
    constexpr unsigned sides = 48;
    const Vec3 third(axis.y * across.z - axis.z * across.y, axis.z * across.x - axis.x * across.z,
                     axis.x * across.y - axis.y * across.x);
    const auto first = static_cast<unsigned>(mesh.vertices_mm.size());
    for (const Vec2 p : profile)
        for (unsigned i = 0; i < sides; ++i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            mesh.vertices_mm.push_back(origin + axis * p.x +
                                       (across * std::cos(angle) + third * std::sin(angle)) * p.y);
        }
    for (unsigned ring = 0; ring + 1 < profile.size(); ++ring)
        for (unsigned i = 0; i < sides; ++i) {
            const unsigned a = first + ring * sides + i, b = first + ring * sides + (i + 1) % sides;
            mesh.triangles.emplace_back(a, b, b + sides);
            mesh.triangles.emplace_back(a, b + sides, a + sides);
        }
}

} // namespace

Mesh film_camera(Vec3 eye_mm, double length_mm) {
    Mesh mesh;
    constexpr double none = 1e-3; // no ring shrinks to a point
    add_turned(mesh, Vec3(0), {0, 0, 1}, {1, 0, 0},
               {{0.10, none}, {0.10, 0.055}, {0, 0.150}, {0, 0.165}, {0.22, 0.07}, {0.30, 0.07}}); // hood and lens
    add_box(mesh, {-0.10, -0.17, 0.28}, {0.10, 0.15, 0.90});
    add_box(mesh, {-0.07, 0.02, 0.90}, {-0.01, 0.10, 1.0}); // finder
    add_box(mesh, {-0.03, 0.15, 0.40}, {0.03, 0.20, 0.80}); // what the reels stand on
    for (const double z : {0.38, 0.78})
        add_turned(mesh, {0, 0.36, z}, {1, 0, 0}, {0, 1, 0},
                   {{-0.05, none}, {-0.05, 0.05}, {-0.035, 0.06}, {-0.035, 0.16}, {-0.05, 0.17}, {-0.05, 0.20},
                    {0.05, 0.20}, {0.05, 0.17}, {0.035, 0.16}, {0.035, 0.06}, {0.05, 0.05}, {0.05, none}});
    for (Vec3 &v : mesh.vertices_mm) v = eye_mm + length_mm * v;
    return mesh;
}

} // namespace threefold::figure
