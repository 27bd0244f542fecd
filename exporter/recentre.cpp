// SPDX-License-Identifier: MIT
#include "exporter/recentre.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/access.h"

namespace threefold {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

std::vector<Sphere> glass_spheres(const Scene &scene) {
    std::vector<Sphere> spheres;
    for (const Object &object : scene.objects)
        std::visit(overloaded{[&](const GlassBall &ball) {
                                  spheres.push_back({ball.centre_mm, ball.radius_mm});
                              },
                              [&](const GlassShell &shell) {
                                  spheres.push_back({shell.centre_mm, shell.outer_radius_mm});
                                  if (shell.inner_radius_mm() > 0)
                                      spheres.push_back({shell.centre_mm, shell.inner_radius_mm()});
                              },
                              [](const Quad &) {}, [](const Mesh &) {}},
                   object.shape);
    return spheres;
}

struct Triangle {
    Vec3 a, b, c;
};

Vec3 corner(const Quad &quad, double u, double v) {
    return quad.centre_mm + (2 * u - 1) * quad.half_u_mm + (2 * v - 1) * quad.half_v_mm;
}

std::vector<Triangle> triangles(const Shape &shape) {
    return std::visit(
        overloaded{[](const GlassBall &) { return std::vector<Triangle>{}; },
                   [](const GlassShell &) { return std::vector<Triangle>{}; },
                   [](const Quad &quad) {
                       const Vec3 a = corner(quad, 0, 0), b = corner(quad, 1, 0), c = corner(quad, 1, 1),
                                  d = corner(quad, 0, 1);
                       return std::vector<Triangle>{{a, b, c}, {a, c, d}};
                   },
                   [](const Mesh &mesh) {
                       std::vector<Triangle> all;
                       for (const glm::uvec3 &t : mesh.triangles)
                           all.push_back({mesh.vertices_mm[t.x], mesh.vertices_mm[t.y], mesh.vertices_mm[t.z]});
                       return all;
                   }},
        shape);
}

double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
    const Vec3 ab = b - a;
    const double length_squared = glm::dot(ab, ab);
    const double t = length_squared > 0 ? std::clamp(glm::dot(p - a, ab) / length_squared, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + t * ab);
}

double distance_to_triangle(Vec3 p, const Triangle &t) {
    const Vec3 normal = glm::cross(t.b - t.a, t.c - t.a);
    const double area = glm::length(normal);
    const bool over_inside = area > 0 && glm::dot(glm::cross(t.b - t.a, p - t.a), normal) >= 0 &&
                             glm::dot(glm::cross(t.c - t.b, p - t.b), normal) >= 0 &&
                             glm::dot(glm::cross(t.a - t.c, p - t.c), normal) >= 0;
    if (over_inside) return std::abs(glm::dot(p - t.a, normal)) / area;
    return std::min(
        {distance_to_segment(p, t.a, t.b), distance_to_segment(p, t.b, t.c), distance_to_segment(p, t.c, t.a)});
}

/// A clearance below this share of the radius is a contact that was meant (and rounded), not a gap to be kept open.
constexpr double contact = 1e-6;

/// Zero when the triangle cuts through the sphere.
double clearance(const Sphere &sphere, const Triangle &t) {
    const double nearest = distance_to_triangle(sphere.centre_mm, t);
    const double farthest = std::max({glm::distance(sphere.centre_mm, t.a), glm::distance(sphere.centre_mm, t.b),
                                      glm::distance(sphere.centre_mm, t.c)});
    if (nearest > sphere.radius_mm) return nearest - sphere.radius_mm;
    return std::max(0.0, sphere.radius_mm - farthest);
}

/// Zero when the spheres cut one another.
double clearance(const Sphere &one, const Sphere &other) {
    const double between = glm::distance(one.centre_mm, other.centre_mm);
    return std::max(
        {0.0, between - one.radius_mm - other.radius_mm, std::abs(one.radius_mm - other.radius_mm) - between});
}

double smallest_gap(const Scene &scene, std::span<const Sphere> spheres) {
    double gap = infinite;
    for (const Object &object : scene.objects)
        std::visit(overloaded{[&](const GlassBall &ball) { gap = std::min(gap, ball.radius_mm); },
                              [&](const GlassShell &shell) {
                                  gap = std::min({gap, shell.outer_radius_mm, shell.wall_mm});
                                  if (shell.inner_radius_mm() > 0) gap = std::min(gap, shell.inner_radius_mm());
                              },
                              [](const Quad &) {}, [](const Mesh &) {}},
                   object.shape);

    const auto keep_open = [&gap](const Sphere &sphere, double distance_mm) {
        if (distance_mm > contact * sphere.radius_mm) gap = std::min(gap, distance_mm);
    };
    for (const Sphere &sphere : spheres) {
        keep_open(sphere, std::abs(glm::distance(scene.camera.eye_mm, sphere.centre_mm) - sphere.radius_mm));
        for (const Sphere &other : spheres)
            if (sphere.centre_mm != other.centre_mm) keep_open(sphere, clearance(sphere, other));
    }
    for (const Object &object : scene.objects)
        for (const Triangle &t : triangles(object.shape))
            for (const Sphere &sphere : spheres) keep_open(sphere, clearance(sphere, t));
    return gap;
}

Vec3 origin(const Scene &scene) {
    for (const Object &object : scene.objects) {
        const auto centre =
            std::visit(overloaded{[](const GlassBall &ball) { return std::optional<Vec3>(ball.centre_mm); },
                                  [](const GlassShell &shell) { return std::optional<Vec3>(shell.centre_mm); },
                                  [](const Quad &) { return std::optional<Vec3>(); },
                                  [](const Mesh &) { return std::optional<Vec3>(); }},
                       object.shape);
        if (centre) return *centre;
    }
    return scene.camera.target_mm;
}

} // namespace

Frame render_frame(const Scene &scene) {
    Frame frame;
    frame.origin_mm = origin(scene);
    const std::vector<Sphere> spheres = glass_spheres(scene);
    frame.extent_mm = glm::distance(scene.camera.eye_mm, frame.origin_mm);
    for (const Sphere &sphere : spheres)
        frame.extent_mm =
            std::max(frame.extent_mm, glm::distance(sphere.centre_mm, frame.origin_mm) + sphere.radius_mm);
    for (const Object &object : scene.objects)
        for (const Triangle &t : triangles(object.shape))
            for (const Vec3 &p : {t.a, t.b, t.c})
                frame.extent_mm = std::max(frame.extent_mm, glm::distance(p, frame.origin_mm));
    frame.smallest_gap_mm = smallest_gap(scene, spheres);
    return frame;
}

} // namespace threefold
