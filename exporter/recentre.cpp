// SPDX-License-Identifier: MIT
#include "exporter/recentre.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/access.h"
#include "scenes/geometry.h"

namespace threefold {

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

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A clearance of orbs and meshes below this share of the radius is a contact that was meant (and rounded), not a gap
/// to be kept open: a spot of a thousandth of the radius at most is then not told from the glass. A flat backdrop shows
/// it in the middle of the picture, and an eye so near sees nothing else: for these every gap counts.
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
        gap = std::min(gap, std::abs(glm::distance(scene.camera.eye_mm, sphere.centre_mm) - sphere.radius_mm));
        for (const Sphere &other : spheres)
            if (sphere.centre_mm != other.centre_mm) keep_open(sphere, clearance(sphere, other));
    }
    for (const Object &object : scene.objects)
        for_each_triangle(object.shape, [&](const Triangle &t) {
            for (const Sphere &sphere : spheres)
                if (std::holds_alternative<Quad>(object.shape))
                    gap = std::min(gap, clearance(sphere, t));
                else
                    keep_open(sphere, clearance(sphere, t));
        });
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
        for_each_triangle(object.shape, [&](const Triangle &t) {
            for (const Vec3 &p : {t.a, t.b, t.c})
                frame.extent_mm = std::max(frame.extent_mm, glm::distance(p, frame.origin_mm));
        });
    frame.smallest_gap_mm = smallest_gap(scene, spheres);
    frame.smallest_sphere_mm = infinite;
    for (const Sphere &sphere : spheres)
        frame.smallest_sphere_mm = std::min(frame.smallest_sphere_mm, sphere.radius_mm);
    return frame;
}

} // namespace threefold
