// SPDX-License-Identifier: MIT
// The study's lights, the environment's dome, and how lights are shared among samples.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "scenes/figure/light.h"
#include "scenes/light.h"

namespace threefold {
namespace {

double sum_of(const std::vector<Directional> &lights) {
    double sum = 0;
    for (const Directional &light : lights) sum += light.irradiance.r;
    return sum;
}

TEST(StudyLights, SumToWhatTheSceneFilesHold) {
    EXPECT_EQ(key_lights().size(), 100u);
    EXPECT_NEAR(sum_of(key_lights()), 4.16, 1e-12);
    EXPECT_NEAR(sum_of(study_lights()), 4.16 + 0.3 + 0.6, 1e-12);
}

TEST(StudyLights, ComeFromAboveAndFromTheEyesSide) {
    for (const Directional &light : key_lights()) {
        const Vec3 travel = glm::normalize(light.travel);
        EXPECT_LT(travel.y, -std::cos(45 * std::numbers::pi / 180));
        EXPECT_LT(travel.z, 0);
        EXPECT_GT(travel.x, 0) << "from the left of the picture";
    }
    // The file's first one: 32.5 and 55 degrees.
    EXPECT_NEAR(key_lights().front().travel.x, 0.5372996083 * 0.5735764364, 1e-9);
    EXPECT_NEAR(key_lights().front().travel.y, -0.8433914458, 1e-9);
    EXPECT_NEAR(key_lights().front().travel.z, -0.5372996083 * 0.8191520443, 1e-9);
}

TEST(Dome, LightsAPlaneOfAnyTiltAsItsEnvironmentDoes) {
    for (const Vec3 normal : {Vec3(0, 0, 1), Vec3(0, 1, 0), glm::normalize(Vec3(1, -2, 0.5))})
        for (const int n : {48, 1000}) {
            double irradiance = 0;
            for (const Directional &light : dome({Rgb(0.02), n}))
                irradiance += light.irradiance.r * std::max(0.0, -glm::dot(glm::normalize(light.travel), normal));
            EXPECT_NEAR(irradiance / (0.02 * std::numbers::pi), 1, 1.5 / n) << n;
        }
    EXPECT_TRUE(dome({Rgb(0), 48}).empty());
    EXPECT_TRUE(dome({Rgb(1), 0}).empty());
}

TEST(SharedLights, HaveTheWholeAsTheirMeanInEveryDirection) {
    std::vector<Directional> lights = study_lights();
    for (const Directional &light : dome({Rgb(0.02), 48})) lights.push_back(light);
    for (const std::size_t shares : {1u, 2u, 7u, 16u}) {
        const auto parts = shared_lights(lights, shares);
        ASSERT_EQ(parts.size(), shares);
        Vec3 flow(0), whole(0);
        for (const auto &part : parts)
            for (const Directional &light : part) flow += glm::normalize(light.travel) * light.irradiance.r;
        for (const Directional &light : lights) whole += glm::normalize(light.travel) * light.irradiance.r;
        EXPECT_LT(glm::length(flow / static_cast<double>(shares) - whole), 1e-12);
        for (const auto &part : parts) EXPECT_NEAR(sum_of(part) / sum_of(lights), 1, 0.35) << "no part is dark";
    }
}

} // namespace
} // namespace threefold
