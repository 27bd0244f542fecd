// SPDX-License-Identifier: MIT
#include "verifier/measure/mesh_rays.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>

namespace threefold {
namespace {

constexpr std::uint32_t leaf = 4;
constexpr double infinite = std::numeric_limits<double>::infinity();

double hit_mm(const Triangle &t, const Ray &ray) {
    const Vec3 ab = t.b - t.a, ac = t.c - t.a, p = glm::cross(ray.direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0) return infinite;
    const Vec3 from_a = ray.origin_mm - t.a, q = glm::cross(from_a, ab);
    const double u = glm::dot(from_a, p) / determinant, v = glm::dot(ray.direction, q) / determinant;
    if (!(u >= 0 && v >= 0 && u + v <= 1)) return infinite;
    const double distance = glm::dot(ac, q) / determinant;
    return distance > 0 ? distance : infinite;
}

/// Distance at which the ray enters the box; infinite where it misses it.
double entry_mm(Vec3 low, Vec3 high, const Ray &ray, Vec3 inverse) {
    double from = 0, to = infinite;
    for (int axis = 0; axis < 3; ++axis) {
        double near = (low[axis] - ray.origin_mm[axis]) * inverse[axis],
               far = (high[axis] - ray.origin_mm[axis]) * inverse[axis];
        if (near > far) std::swap(near, far);
        // Written so that NaN (a ray within a side's plane) leaves the box open.
        if (near > from) from = near;
        if (far < to) to = far;
    }
    return from <= to * (1 + 1e-12) ? from : infinite;
}

} // namespace

MeshRays::MeshRays(const Mesh &mesh) {
    triangles_.reserve(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) triangles_.push_back(triangle_of(mesh, i));
    nodes_.reserve(triangles_.size() / 2 + 1);
    nodes_.emplace_back();
    build(0, 0, static_cast<std::uint32_t>(triangles_.size()));
}

void MeshRays::build(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
    Vec3 low(infinite), high(-infinite);
    for (std::uint32_t i = first; i < first + count; ++i)
        for (const Vec3 &p : {triangles_[i].a, triangles_[i].b, triangles_[i].c})
            low = glm::min(low, p), high = glm::max(high, p);
    nodes_[node] = {low, high, first, count};
    if (count <= leaf) return;
    const Vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto begin = triangles_.begin() + first;
    const std::uint32_t half = count / 2;
    std::nth_element(begin, begin + half, begin + count, [axis](const Triangle &s, const Triangle &t) {
        return s.a[axis] + s.b[axis] + s.c[axis] < t.a[axis] + t.b[axis] + t.c[axis];
    });
    const auto children = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    nodes_.emplace_back();
    nodes_[node].first = children;
    nodes_[node].count = 0;
    build(children, first, half);
    build(children + 1, first + half, count - half);
}

double MeshRays::first_hit_mm(const Ray &ray) const {
    const Vec3 inverse = 1.0 / ray.direction;
    double nearest = infinite;
    std::array<std::uint32_t, 64> open; // halves of at most 2^32 triangles: 32 levels, two children each
    std::size_t size = 0;
    open[size++] = 0;
    while (size > 0) {
        const Node &node = nodes_[open[--size]];
        if (!(entry_mm(node.low, node.high, ray, inverse) < nearest)) continue;
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
            nearest = std::min(nearest, hit_mm(triangles_[i], ray));
        if (node.count == 0 && !triangles_.empty()) {
            open[size++] = node.first;
            open[size++] = node.first + 1;
        }
    }
    return nearest;
}

} // namespace threefold
