// SPDX-License-Identifier: MIT
// Everything that is not glass: rectangles and meshes in an Embree hierarchy, and the light that leaves them.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "scenes/camera.h"
#include "verifier/tracer/packet.h"

namespace threefold::tracer {

struct SurfaceHit {
    double distance = 0;
    Vec3 position{0};
    std::size_t object = 0; ///< index into scene.objects
    std::uint32_t triangle = 0;
    Vec2 uv{0};
    Vec3 normal{0}; ///< unit, towards the side the ray came from
};

/// Embree finds candidates in single precision; where `exact`, distance, uv and normal are then computed in double from
/// the scene's own numbers. A ray that starts on a surface names it, so that no epsilon is needed.
class Surfaces {
public:
    Surfaces(const Scene &scene, bool exact);
    ~Surfaces();
    Surfaces(const Surfaces &) = delete;
    Surfaces &operator=(const Surfaces &) = delete;

    std::optional<SurfaceHit> intersect(const Ray &ray, const SurfaceHit *left = nullptr) const;

    /// Is anything in the way of a ray that leaves a surface at `left`?
    bool blocks(const Ray &ray, const SurfaceHit &left) const;

    /// The rectangles that are met one by one, in double precision; with `only_rectangles` there is nothing else.
    const std::vector<Rectangle> &rectangles() const;
    bool only_rectangles() const;

    /// Radiance of an emitter, or reflectance of a diffuse surface, at a hit.
    Rgb emitted(const SurfaceHit &hit) const;
    std::optional<Rgb> reflectance(const SurfaceHit &hit) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Of the library this was built with: "3.13.5".
std::string embree_version();

} // namespace threefold::tracer
