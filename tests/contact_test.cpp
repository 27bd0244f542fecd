// SPDX-License-Identifier: MIT
// Distance from a mesh to a sphere, against figures whose distance is known.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <glm/vec4.hpp>

#include "scenes/geometry.h"
#include "verifier/measure/contact.h"

namespace threefold {
namespace {

Mesh triangle(Vec3 a, Vec3 b, Vec3 c) { return {{a, b, c}, {{0, 1, 2}}, {}, {}}; }

/// Axis-parallel, its surface pointing outwards.
Mesh box(Vec3 low, Vec3 high) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.vertices_mm.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    for (const glm::uvec4 q : {glm::uvec4(0, 4, 6, 2), glm::uvec4(1, 3, 7, 5), glm::uvec4(0, 1, 5, 4),
                               glm::uvec4(2, 6, 7, 3), glm::uvec4(0, 2, 3, 1), glm::uvec4(4, 5, 7, 6)}) {
        mesh.triangles.emplace_back(q.x, q.y, q.z);
        mesh.triangles.emplace_back(q.x, q.z, q.w);
    }
    return mesh;
}

TEST(Clearance, TheInsideOfATriangleCountsNotOnlyItsCorners) {
    // A large triangle in the plane y = -5, touching nothing with its far corners.
    const Mesh floor = triangle({-1000, -5, -1000}, {1000, -5, -1000}, {0, -5, 1500});
    EXPECT_NEAR(clearance_mm(floor, {Vec3(0), 3}), 2, 1e-12);
    EXPECT_NEAR(clearance_mm(floor, {Vec3(0), 5}), 0, 1e-12);
    EXPECT_NEAR(clearance_mm(floor, {Vec3(0), 6}), -1, 1e-12);
}

TEST(Clearance, AnEdgeOrACornerMayBeNearest) {
    // Pythagoras: the edge passes the centre at 3-4-5, the corner at 2-3-6-7.
    EXPECT_NEAR(clearance_mm(triangle({3, 4, -50}, {3, 4, 50}, {30, 40, 0}), {Vec3(0), 1}), 4, 1e-12);
    EXPECT_NEAR(clearance_mm(triangle({2, 3, 6}, {20, 30, 61}, {21, 30, 60}), {Vec3(0), 1}), 6, 1e-12);
}

TEST(Clearance, AMeshInsideTheSphereOverlapsItAndSoDoesOneThatSwallowsIt) {
    EXPECT_NEAR(clearance_mm(box(Vec3(-1), Vec3(1)), {Vec3(0), 10}), -9, 1e-12);
    EXPECT_NEAR(clearance_mm(box(Vec3(-10), Vec3(10)), {Vec3(0), 2}), -12, 1e-12);
    EXPECT_NEAR(clearance_mm(box(Vec3(-10), Vec3(10)), {Vec3(0, 0, 15), 2}), 3, 1e-12);
}

TEST(Clearance, TrianglesWithoutAreaAndMeshesWithoutTrianglesAreNoTrouble) {
    EXPECT_NEAR(clearance_mm(triangle({0, 3, 0}, {0, 3, 0}, {0, 3, 0}), {Vec3(0), 1}), 2, 1e-12);
    EXPECT_NEAR(clearance_mm(triangle({-9, 3, 0}, {9, 3, 0}, {4, 3, 0}), {Vec3(0), 1}), 2, 1e-12);
    EXPECT_EQ(clearance_mm(Mesh{}, {Vec3(0), 1}), std::numeric_limits<double>::infinity());
}

} // namespace
} // namespace threefold
