// SPDX-License-Identifier: MIT
// Rays against meshes: known distances, and the tree of boxes against asking every triangle.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "verifier/measure/mesh_rays.h"

namespace threefold {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(MeshRays, MeetATriangleFromEitherSideAndNothingBehindThem) {
    const MeshRays wall(Mesh{{{-1, -1, -5}, {1, -1, -5}, {0, 2, -5}}, {{0, 1, 2}}, {}, {}});
    EXPECT_DOUBLE_EQ(wall.first_hit_mm({Vec3(0), Vec3(0, 0, -1)}), 5);
    EXPECT_DOUBLE_EQ(wall.first_hit_mm({Vec3(0, 0, -7), Vec3(0, 0, 1)}), 2);
    EXPECT_EQ(wall.first_hit_mm({Vec3(0), Vec3(0, 0, 1)}), infinite);
    EXPECT_EQ(wall.first_hit_mm({Vec3(3, 0, 0), Vec3(0, 0, -1)}), infinite);
    EXPECT_EQ(wall.first_hit_mm({Vec3(0), Vec3(1, 0, 0)}), infinite);
    EXPECT_EQ(MeshRays(Mesh{}).first_hit_mm({Vec3(0), Vec3(0, 0, -1)}), infinite);
}

TEST(MeshRays, TheTreeFindsWhatAskingEachTriangleFinds) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(-10, 10), size(-1, 1);
    const auto vector = [&](auto &from) { return Vec3(from(random), from(random), from(random)); };
    Mesh soup;
    std::vector<MeshRays> single;
    for (std::uint32_t i = 0; i < 500; ++i) {
        const Vec3 at = vector(place);
        const Mesh one{{at, at + vector(size), at + vector(size)}, {{0, 1, 2}}, {}, {}};
        soup.vertices_mm.insert(soup.vertices_mm.end(), one.vertices_mm.begin(), one.vertices_mm.end());
        soup.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
        single.emplace_back(one);
    }
    const MeshRays tree(soup);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const Ray ray{vector(place), glm::normalize(vector(size))};
        double nearest = infinite;
        for (const MeshRays &one : single) nearest = std::min(nearest, one.first_hit_mm(ray));
        EXPECT_EQ(tree.first_hit_mm(ray), nearest);
        hits += nearest < infinite;
    }
    EXPECT_GT(hits, 200);
}

} // namespace
} // namespace threefold
