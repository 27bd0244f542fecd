// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "exporter/mesh/triangulate.h"

namespace threefold {
namespace {

/// The sum of the areas, each counted as it turns: with a triangle outside or twice it is not the polygon's.
double area(const std::vector<Vec3> &polygon, double *turned = nullptr) {
    double sum = 0;
    Vec3 whole(0);
    for (const auto &t : triangulate(polygon)) {
        const Vec3 n = glm::cross(polygon[t[1]] - polygon[t[0]], polygon[t[2]] - polygon[t[0]]) / 2.0;
        sum += glm::length(n);
        whole += n;
    }
    if (turned) *turned = glm::length(whole);
    return sum;
}

TEST(Triangulate, AConcavePolygonWithCornersOnALineHasItsOwnArea) {
    const std::vector<Vec3> u{{4, 0, 0},   {4, 5, 0},  {6, 5, 0}, {6, 0, 0}, {10, 0, 0},
                              {10, 10, 0}, {0, 10, 0}, {0, 5, 0}, {0, 0, 0}};
    double turned = 0;
    EXPECT_DOUBLE_EQ(area(u, &turned), 90);
    EXPECT_DOUBLE_EQ(turned, 90);
}

TEST(Triangulate, ItsAreaIsTheSameFromAnyFirstCornerInAnySenseAndPlane) {
    const std::vector<Vec3> u{{4, 0, 1},   {4, 5, 1},  {6, 5, 1}, {6, 0, 1}, {10, 0, 1},
                              {10, 10, 1}, {0, 10, 1}, {0, 5, 1}, {0, 0, 1}};
    for (std::size_t first = 0; first < u.size(); ++first)
        for (const bool reversed : {false, true})
            for (int plane = 0; plane < 3; ++plane) {
                std::vector<Vec3> p;
                for (std::size_t k = 0; k < u.size(); ++k) {
                    const Vec3 v = u[(first + (reversed ? u.size() - k : k)) % u.size()];
                    p.push_back(plane == 0 ? v : plane == 1 ? Vec3(v.z, v.x, v.y) : Vec3(v.x, v.z + v.y, v.y));
                }
                double turned = 0;
                const double right = plane == 2 ? 90 * std::numbers::sqrt2 : 90;
                EXPECT_NEAR(area(p, &turned), right, 1e-12 * right) << first << reversed << plane;
                EXPECT_NEAR(turned, right, 1e-12 * right) << first << reversed << plane;
            }
}

TEST(Triangulate, AStarOfManyCornersKeepsItsArea) {
    std::vector<Vec3> star;
    constexpr int points = 300;
    for (int k = 0; k < 2 * points; ++k) {
        const double angle = std::numbers::pi * k / points, radius = k % 2 ? 1 : 3;
        star.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
    const double right = points * 3 * std::sin(std::numbers::pi / points);
    EXPECT_NEAR(area(star), right, 1e-9);
}

TEST(Triangulate, WhatHasNoAreaGivesNothingAndWhatCrossesItselfEnds) {
    EXPECT_TRUE(triangulate(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}).empty());
    EXPECT_TRUE(triangulate(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).empty());
    EXPECT_FALSE(triangulate(std::vector<Vec3>{{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 3, 0}}).empty());
}

} // namespace
} // namespace threefold
