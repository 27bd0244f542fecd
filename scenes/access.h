// SPDX-License-Identifier: MIT
// The glass, the surface, or the outer sphere of any shape, if it has one.
#pragma once

#include <optional>
#include <utility>

#include "scenes/scene.h"

namespace threefold {

inline const Glass *glass_of(const Shape &shape) {
    using Result = const Glass *;
    return std::visit(overloaded{
                          [](const GlassBall &ball) { return &ball.glass; },
                          [](const GlassShell &shell) { return &shell.glass; },
                          [](const Quad &) { return Result(nullptr); },
                          [](const Mesh &) { return Result(nullptr); },
                      },
                      shape);
}

inline const Surface *surface_of(const Shape &shape) {
    using Result = const Surface *;
    return std::visit(overloaded{
                          [](const GlassBall &) { return Result(nullptr); },
                          [](const GlassShell &) { return Result(nullptr); },
                          [](const Quad &quad) { return &quad.surface; },
                          [](const Mesh &mesh) { return &mesh.surface; },
                      },
                      shape);
}

struct Sphere {
    Vec3 centre_mm;
    double radius_mm;
};

/// What bounds a glass orb.
inline std::optional<Sphere> outer_sphere(const Shape &shape) {
    using Result = std::optional<Sphere>;
    return std::visit(overloaded{
                          [](const GlassBall &b) {
                              return Result({b.centre_mm, b.radius_mm});
                          },
                          [](const GlassShell &s) {
                              return Result({s.centre_mm, s.outer_radius_mm});
                          },
                          [](const Quad &) { return Result(); },
                          [](const Mesh &) { return Result(); },
                      },
                      shape);
}

inline std::optional<Sphere> first_orb(const Scene &scene) {
    for (const Object &object : scene.objects)
        if (const auto orb = outer_sphere(object.shape)) return orb;
    return std::nullopt;
}

inline Glass *glass_of(Shape &shape) { return const_cast<Glass *>(glass_of(std::as_const(shape))); }
inline Surface *surface_of(Shape &shape) { return const_cast<Surface *>(surface_of(std::as_const(shape))); }

} // namespace threefold
