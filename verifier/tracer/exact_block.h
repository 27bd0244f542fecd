// SPDX-License-Identifier: MIT
// Does a triangle or a rectangle really stand in a ray's way, just where the ray starts? In double precision, from the
// scene's own numbers: Embree's start of a ray is single, and may lie below the neighbour of the triangle it is on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "scenes/camera.h"
#include "scenes/scene.h"

namespace threefold::tracer {

/// The ray meets it, edges included, at a height of its start over the plane of more than `rounding_mm`.
bool blocks(const Mesh &mesh, std::uint32_t triangle, Vec3 origin_mm, Vec3 direction, double rounding_mm);
bool blocks(const Quad &quad, Vec3 origin_mm, Vec3 direction, double rounding_mm);

/// The scene's own shapes, by the object's number. They must outlive this.
class ExactShapes {
public:
    void add(std::size_t object, const Mesh &mesh) { put(object, &mesh); }
    void add(std::size_t object, const Quad &quad) { put(object, &quad); }
    /// The greatest distance of a corner from the origin of single precision.
    void reach_to(double distance_mm);
    double reach_mm() const { return reach_mm_; }

    bool blocks(std::size_t object, std::uint32_t triangle, Vec3 origin_mm, Vec3 direction) const;

private:
    using Pointer = std::variant<std::monostate, const Mesh *, const Quad *>;
    void put(std::size_t object, Pointer shape);

    std::vector<Pointer> shapes_;
    double reach_mm_ = 0;
};

} // namespace threefold::tracer
