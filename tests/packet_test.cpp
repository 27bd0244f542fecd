// SPDX-License-Identifier: MIT
// Eight rays at once against one ray at a time.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "scenes/camera.h"
#include "verifier/tracer/packet.h"

namespace threefold::tracer {
namespace {

RayPacket rays_at(double outer, std::mt19937_64 &random, double least, double most) {
    std::uniform_real_distribution<double> impact(least, most), angle(-3, 3);
    RayPacket rays;
    for (int l = 0; l < lanes; ++l) {
        const Vec3 d = glm::normalize(Vec3(std::sin(angle(random)), std::cos(angle(random)), angle(random)));
        const Vec3 sideways = glm::normalize(glm::cross(d, Vec3(0.3, 1, 0.2)));
        rays.origin.put(l, impact(random) * outer * sideways - 7 * outer * d);
        rays.direction.put(l, d);
    }
    return rays;
}

/// All light that leaves: its weight, and its momentum and place by weight.
struct Light {
    double weight = 0, dropped = 0;
    Vec3 direction{0}, origin{0};
};

class PacketTest : public testing::TestWithParam<double> {};

TEST_P(PacketTest, SendsTheSameLightTheSameWayAsOneRayAtATime) {
    const double inner = GetParam(), outer = 68;
    std::mt19937_64 random(5);
    for (int round = 0; round < 200; ++round) {
        Orb<double> orb{Vec3(0), outer, inner, 1.05 + 0.01 * round, round % 2 ? 0.89 : 1.0, Coating::fresnel};
        orb.inner_transmittance = orb.interface_transmittance;
        const double border = inner > 0 ? std::min(1.0, orb.index * inner / outer) : 1.0;
        const RayPacket rays =
            round % 3 && border < 1 ? rays_at(outer, random, border, 1) : rays_at(outer, random, 0, border);
        EntryPacket entry;
        intersect(orb, rays, entry);
        PacketScratch scratch;
        if (!trace_packet(orb, rays, entry, entry.hits, 1e-12, 0, scratch)) continue;
        for (int l = 0; l < lanes; ++l) {
            if (!(entry.hits >> l & 1u)) continue;
            const RayOf<double> ray{rays.origin.at(l), rays.direction.at(l)};
            Entry<double> alone{};
            ASSERT_TRUE(intersect(orb, ray, alone));
            Light a, b;
            TreeScratch<double> tree;
            a.dropped = trace_orb(
                orb, ray, alone, TreeEnd<double>{1e-12, 0}, tree,
                [&](Vec3 p, Vec3 d, double w) {
                    a.weight += w;
                    a.direction += w * d;
                    a.origin += w * p;
                },
                [] { return 0.5; });
            for (std::size_t i = 0; i < scratch.count; ++i) {
                const ExitPacket &out = scratch.exits[i];
                b.weight += out.weight[l];
                b.direction += out.weight[l] * out.direction.at(l);
                b.origin += out.weight[l] * out.origin.at(l);
            }
            EXPECT_LE(scratch.dropped[l], 1e-12);
            EXPECT_NEAR(a.weight, b.weight, 3e-12);
            EXPECT_LT(glm::length(a.direction - b.direction), 1e-10);
            EXPECT_LT(glm::length(a.origin - b.origin), 1e-10 * outer);
        }
    }
}

TEST_P(PacketTest, RouletteIsRightOnAverageAndDropsNothing) {
    const double outer = 68;
    std::mt19937_64 random(6);
    const Orb<double> orb{Vec3(0), outer, GetParam(), 1.5, 1, Coating::fresnel};
    const RayPacket rays = rays_at(outer, random, 0, 0.4);
    EntryPacket entry;
    intersect(orb, rays, entry);
    PacketScratch scratch;
    double sum = 0, squares = 0;
    constexpr int rounds = 4000;
    for (int round = 0; round < rounds; ++round) {
        ASSERT_TRUE(trace_packet(orb, rays, entry, entry.hits, 0.05, 1000003u * (round + 1u), scratch));
        double weight = 0;
        for (std::size_t i = 0; i < scratch.count; ++i) weight += scratch.exits[i].weight[0];
        EXPECT_EQ(scratch.dropped[0], 0);
        sum += weight;
        squares += weight * weight;
    }
    const double mean = sum / rounds, error = std::sqrt((squares / rounds - mean * mean) / rounds);
    EXPECT_GT(error, 0);
    EXPECT_NEAR(mean, 1, 5 * error);
}

INSTANTIATE_TEST_SUITE_P(SolidAndHollow, PacketTest, testing::Values(0.0, 20.0, 60.0, 66.64, 68 - 1e-9));

TEST(Packet, LooksThroughThePixelWhereTheCameraDoes) {
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        Camera camera;
        camera.projection = projection;
        camera.eye_mm = {30, -200, 500};
        camera.width_px = 40;
        camera.height_px = 30;
        camera.crop = Crop{3, 4, 20, 20};
        const Film film(camera);
        for (int column = 0; column < 20; ++column) {
            const PixelSampler sampler(7, column, 5);
            RayPacket rays;
            camera_rays(film, sampler, 8, Vec2(column, 5), rays);
            for (int l = 0; l < lanes; ++l) {
                const Ray ray =
                    camera_ray(camera, Vec2(column, 5) + sampler.position(8 + static_cast<std::uint32_t>(l)));
                EXPECT_LT(glm::length(rays.direction.at(l) - ray.direction), 1e-15);
                EXPECT_LT(glm::length(rays.origin.at(l) - ray.origin_mm), 1e-12);
            }
        }
    }
}

/// As published: x ^= v_i for each bit i of k, v_0 = 2^31, v_{i+1} = v_i ^ (v_i >> 1).
TEST(Packet, SecondDimensionIsSobols) {
    std::mt19937 random(3);
    for (int round = 0; round < 1000; ++round) {
        const std::uint32_t k = round < 32 ? 1u << round : static_cast<std::uint32_t>(random());
        std::uint32_t x = 0, v = 1u << 31;
        for (std::uint32_t bits = k; bits; bits >>= 1, v ^= v >> 1)
            if (bits & 1) x ^= v;
        EXPECT_EQ(second_dimension(k), x);
    }
}

} // namespace
} // namespace threefold::tracer
