// SPDX-License-Identifier: MIT
#include "exporter/blender/icosphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <unordered_map>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

namespace threefold {

namespace {

Icosphere icosahedron() {
    const double g = std::numbers::phi;
    Icosphere ico;
    ico.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                    {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    // Any turn that no symmetry of the solid, no axis and no diagonal comes back to.
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1), 1.0, Vec3(0.36, 0.48, 0.8)));
    for (Vec3 &v : ico.vertices) v = turn * glm::normalize(v);
    ico.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    return ico;
}

void subdivide(Icosphere &ico) {
    std::unordered_map<std::uint64_t, std::uint32_t> middles;
    middles.reserve(ico.triangles.size() * 3 / 2);
    ico.vertices.reserve(ico.vertices.size() + ico.triangles.size() * 3 / 2);
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const std::uint64_t edge = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
        const auto [found, is_new] = middles.try_emplace(edge, static_cast<std::uint32_t>(ico.vertices.size()));
        if (is_new) ico.vertices.push_back(glm::normalize(ico.vertices[a] + ico.vertices[b]));
        return found->second;
    };
    std::vector<glm::uvec3> finer;
    finer.reserve(ico.triangles.size() * 4);
    for (const glm::uvec3 &t : ico.triangles) {
        const std::uint32_t ab = middle(t.x, t.y), bc = middle(t.y, t.z), ca = middle(t.z, t.x);
        finer.insert(finer.end(), {{t.x, ab, ca}, {t.y, bc, ab}, {t.z, ca, bc}, {ab, bc, ca}});
    }
    ico.triangles = std::move(finer);
}

/// 1 minus the distance of a triangle's plane from the centre, without cancellation: the plane is nearest at the circle
/// through the corners, of radius r = abc / (4 area), and 1 - sqrt(1 - r^2) = r^2 / (1 + sqrt(1 - r^2)).
double depth(Vec3 a, Vec3 b, Vec3 c) {
    const double radius =
        glm::distance(a, b) * glm::distance(b, c) * glm::distance(c, a) / (2 * glm::length(glm::cross(b - a, c - a)));
    return radius * radius / (1 + std::sqrt(1 - radius * radius));
}

/// The deepest triangle of each level. All twenty faces of the icosahedron are alike, and the triangle in the middle of
/// a face is its largest at every level (its corners stay symmetric about the face's centre), so it alone counts.
std::array<double, finest_icosphere + 1> depths() {
    const Icosphere ico = icosahedron();
    const glm::uvec3 face = ico.triangles.front();
    Vec3 a = ico.vertices[face.x], b = ico.vertices[face.y], c = ico.vertices[face.z];
    std::array<double, finest_icosphere + 1> deepest{};
    for (double &d : deepest) {
        d = depth(a, b, c);
        const Vec3 ab = glm::normalize(a + b), bc = glm::normalize(b + c), ca = glm::normalize(c + a);
        a = ab, b = bc, c = ca;
    }
    return deepest;
}

} // namespace

Icosphere make_icosphere(int level) {
    Icosphere ico = icosahedron();
    for (int i = 0; i < level; ++i) subdivide(ico);
    return ico;
}

IcosphereFit fit_icosphere(int level) {
    static const auto deepest = depths();
    const double depth = deepest[static_cast<std::size_t>(level)];
    // scale - 1 = 1 - scale (1 - depth)
    const double distance = depth / (2 - depth);
    return {level, 1 + distance, distance};
}

std::optional<IcosphereFit> coarsest_icosphere(double tolerance) {
    for (int level = 0; level <= finest_icosphere; ++level)
        if (const IcosphereFit fit = fit_icosphere(level); fit.distance <= tolerance) return fit;
    return std::nullopt;
}

} // namespace threefold
