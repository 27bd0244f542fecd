// SPDX-License-Identifier: MIT
// Eight rays at once against one ray at a time, where they meet surfaces and are in their shadow.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "scenes/texture.h"
#include "verifier/tracer/paints.h"
#include "verifier/tracer/pixel.h"
#include "verifier/tracer/shadow_rays.h"
#include "verifier/tracer/tracer.h"

namespace threefold::tracer {
namespace {

/// Wavy ground of `side` squares a side, two rectangles above it, and an orb over all.
Scene landscape(unsigned side) {
    Mesh ground;
    for (unsigned row = 0; row <= side; ++row)
        for (unsigned column = 0; column <= side; ++column) {
            const double x = 200.0 * column / side - 100, z = 200.0 * row / side - 100;
            ground.vertices_mm.emplace_back(x, 9 * std::sin(0.1 * x) * std::cos(0.07 * z), z);
            ground.uv.emplace_back(x / 200 + 0.5, z / 200 + 0.5);
        }
    for (unsigned row = 0; row < side; ++row)
        for (unsigned column = 0; column < side; ++column) {
            const unsigned a = row * (side + 1) + column;
            ground.triangles.emplace_back(a, a + side + 2, a + 1);
            ground.triangles.emplace_back(a, a + side + 1, a + side + 2);
        }
    ground.surface = Diffuse{Rgb(0.7, 0.5, 0.3)};
    Scene s;
    s.objects = {{"ground", ground},
                 {"board", Quad{{20, 30, 10}, {15, 5, 0}, {0, 0, 12}, Diffuse{Rgb(0.4)}}},
                 {"lamp", Quad{{-40, 40, -30}, {10, 0, 0}, {0, 0, 10}, Emissive{Rgb(0.9)}}},
                 {"orb", GlassBall{{0, 60, 0}, 20, {}}}};
    s.lights = {{{0.2, -1, 0.1}, Rgb(1, 0.8, 0.6)}, {{-0.9, -0.4, 0.3}, Rgb(0.3)}, {{0, 0, 1}, Rgb(0.2)}};
    s.glass_shadow = {GlassShadow::Rule::constant, 0.6};
    s.camera.eye_mm = {0, 120, 300};
    s.camera.target_mm = {0, 10, 0};
    s.camera.horizontal_fov_deg = 40;
    s.camera.width_px = 48;
    s.camera.height_px = 32;
    return s;
}

RayPacket random_rays(std::mt19937_64 &random) {
    std::uniform_real_distribution<double> place(-120, 120);
    RayPacket rays;
    for (int l = 0; l < lanes; ++l) {
        const Vec3 from(place(random), 80 + 0.3 * place(random), place(random));
        const Vec3 to(place(random), 0.3 * place(random), place(random));
        rays.origin.put(l, from);
        rays.direction.put(l, glm::normalize(to - from));
    }
    return rays;
}

TEST(Surfaces, EightRaysMeetWhatOneRayMeetsUpToALimit) {
    const Scene scene = landscape(30);
    const Surfaces surfaces(scene, true);
    std::mt19937_64 random(11);
    int met_by_some = 0;
    for (int round = 0; round < 500; ++round) {
        const RayPacket rays = random_rays(random);
        Lanes limit;
        for (int l = 0; l < lanes; ++l) limit[l] = l % 2 ? std::numeric_limits<double>::infinity() : 90;
        const std::uint32_t active = 0xb7;
        SurfaceHit hits[lanes];
        const std::uint32_t met = surfaces.intersect(rays, active, limit, hits);
        EXPECT_EQ(met & ~active, 0u);
        for (std::uint32_t bits = active; bits; bits &= bits - 1) {
            const int l = std::countr_zero(bits);
            const auto alone = surfaces.intersect(Ray{rays.origin.at(l), rays.direction.at(l)});
            ASSERT_EQ(met >> l & 1u, alone && alone->distance <= limit[l] ? 1u : 0u);
            if (!(met >> l & 1u)) continue;
            ++met_by_some;
            EXPECT_EQ(hits[l].object, alone->object);
            EXPECT_EQ(hits[l].triangle, alone->triangle);
            EXPECT_NEAR(hits[l].distance, alone->distance, 1e-11);
            EXPECT_LT(glm::length(hits[l].uv - alone->uv), 1e-12);
            EXPECT_EQ(hits[l].normal, alone->normal);
        }
    }
    EXPECT_GT(met_by_some, 500);
}

TEST(Surfaces, EightRaysAreBlockedWhereOneIsAndNeverByWhatTheyLeave) {
    const Scene scene = landscape(30);
    const Surfaces surfaces(scene, true);
    std::mt19937_64 random(12);
    Lanes limit;
    for (double &v : limit.v) v = std::numeric_limits<double>::infinity();
    int blocked_by_some = 0, open_to_some = 0;
    for (int round = 0; round < 1500; ++round) {
        const RayPacket rays = random_rays(random);
        SurfaceHit hits[lanes];
        const std::uint32_t met = surfaces.intersect(rays, all_lanes, limit, hits);
        RayPacket shadow = rays;
        Left left[lanes];
        for (std::uint32_t bits = met; bits; bits &= bits - 1) {
            const int l = std::countr_zero(bits);
            const Vec3 light = glm::normalize(Vec3(std::sin(round + l), 1, std::cos(round)));
            shadow.origin.put(l, hits[l].position);
            shadow.direction.put(l, glm::dot(light, hits[l].normal) > 0 ? light : -light);
            left[l] = hits[l].left();
        }
        const std::uint32_t blocked = surfaces.blocks(shadow, met, left);
        for (std::uint32_t bits = met; bits; bits &= bits - 1) {
            const int l = std::countr_zero(bits);
            const bool alone = surfaces.blocks(Ray{shadow.origin.at(l), shadow.direction.at(l)}, hits[l]);
            EXPECT_EQ(blocked >> l & 1u, alone ? 1u : 0u);
            (alone ? blocked_by_some : open_to_some) += 1;
        }
    }
    EXPECT_GT(blocked_by_some, 100);
    EXPECT_GT(open_to_some, 1000);
}

TEST(Surfaces, AFlatMeshShadowsNothingOfItself) {
    Scene scene = landscape(1);
    for (Vec3 &v : std::get<Mesh>(scene.objects[0].shape).vertices_mm) v.y = 0.1 * v.x + 0.3; // tilted, so rounded
    scene.objects.resize(1);
    const Surfaces surfaces(scene, true);
    for (int k = 0; k < 1000; ++k) {
        const Ray down{{0.173 * k - 86, 50, 0.11 * k - 60}, {0, -1, 0}};
        const auto hit = surfaces.intersect(down);
        ASSERT_TRUE(hit);
        EXPECT_FALSE(surfaces.blocks(Ray{hit->position, glm::normalize(Vec3(1, 0.2, 0.3))}, *hit));
    }
}

TEST(ShadowRays, GiveThePixelsWhatEachHitAndLightAloneGive) {
    for (const GlassShadow::Rule rule :
         {GlassShadow::Rule::none, GlassShadow::Rule::opaque, GlassShadow::Rule::constant}) {
        Scene scene = landscape(30);
        scene.glass_shadow.rule = rule;
        const Surfaces surfaces(scene, true);
        const std::vector<Orb<double>> orbs{{Vec3(0, 60, 0), 20, 0, 1.5, 1, Coating::fresnel}};
        const Lights lights(scene, 1);
        ShadowRays shadows;
        std::mt19937_64 random(14);
        std::vector<Rgb> pixels(5, Rgb(0)), expected(5, Rgb(0));
        int through_glass = 0;
        for (int round = 0; round < 600; ++round) {
            const Vec3 from(0.1 * round - 30, 90, 0.07 * round - 21), to(0.19 * round - 60, 0, 40 - 0.13 * round);
            const auto hit = surfaces.intersect(Ray{from, glm::normalize(to - from)});
            if (!hit || hit->object == 2) continue;
            const Rgb factor(0.3, 0.001 * round, 0.7);
            const auto pixel = static_cast<std::uint32_t>(round % 5);
            shadows.add(*hit, factor, lights.share(0, 0), pixel);
            for (const Light &light : lights.share(0, 0)) {
                const double cosine = glm::dot(light.towards, hit->normal);
                const Ray ray{hit->position, light.towards};
                if (!(cosine > 0) || surfaces.blocks(ray, *hit)) continue;
                Entry<double> entry{};
                const bool glass = intersect(orbs[0], RayOf<double>{ray.origin_mm, ray.direction}, entry);
                through_glass += glass;
                const double share = !glass || rule == GlassShadow::Rule::none ? 1
                                     : rule == GlassShadow::Rule::opaque       ? 0
                                                                               : 0.6;
                expected[pixel] += factor * light.irradiance * (cosine * share);
            }
        }
        EXPECT_GT(shadows.size(), 800u);
        EXPECT_GT(through_glass, 20);
        shadows.cast(surfaces, orbs, scene.glass_shadow, lights.all(), pixels, nullptr);
        EXPECT_EQ(shadows.size(), 0u);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            EXPECT_GT(expected[i].r, 1);
            EXPECT_LT(glm::length(pixels[i] - expected[i]), 1e-10);
        }
    }
}

TEST(ShadowRays, KnowStrongLightsOfAllSharesAsOne) {
    Scene scene = landscape(1);
    for (int k = 0; k < 40; ++k) scene.lights.push_back({Vec3(0.01 * k, -1, 0.02), Rgb(0.01)});
    const Lights lights(scene, 4);
    EXPECT_EQ(lights.all().size(), 43u);
    for (std::size_t k = 0; k < 4; ++k)
        for (const Light &light : lights.share(k, 0)) {
            EXPECT_EQ(lights.all()[light.number].towards, light.towards);
            EXPECT_EQ(lights.all()[light.number].irradiance, light.irradiance);
        }
}

TEST(ShadowRays, GiveTheSamePictureForAnyNumberOfThreads) {
    RenderJob job;
    job.scene = landscape(30);
    job.samples_per_pixel = 12;
    job.cut_weight = 1e-2;
    job.threads = 1;
    const Image one = trace(job).images[0];
    job.threads = 4;
    const Image four = trace(job).images[0];
    EXPECT_EQ(one.pixels, four.pixels);
    EXPECT_GT(one.at(24, 25).g, 0.01);
}

TEST(Sights, AreWhatTheTexturesSayAtAnyPointOfAnySize) {
    std::mt19937_64 random(13);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const auto &[width, height] : {std::pair(2, 2), std::pair(3, 7), std::pair(64, 2), std::pair(301, 200)}) {
        auto texture = std::make_shared<Texture>(Texture{width, height, {}});
        for (int i = 0; i < 3 * width * height; ++i) texture->rgb.push_back(static_cast<std::uint16_t>(random()));
        Scene scene;
        scene.objects = {{"a", Quad{{}, {1, 0, 0}, {0, 1, 0}, Emissive{texture}}},
                         {"b", Quad{{}, {1, 0, 0}, {0, 1, 0}, CoordinateCard{}}}};
        const Paints paints(scene);
        const std::vector<Sight> sights{
            {Sight::Kind::constant, Rgb(0.1, 0.2, 0.3)}, *paints.sight(0), *paints.sight(1)};
        for (int round = 0; round < 200; ++round) {
            RectangleHits hits;
            Lanes weight;
            const auto edge = [&] { return round % 4 ? unit(random) : std::round(unit(random)); };
            for (int l = 0; l < lanes; ++l) {
                hits.which[l] = l % 3 - 1;
                hits.u[l] = edge();
                hits.v[l] = edge();
                weight[l] = unit(random);
            }
            const std::uint32_t asked = static_cast<std::uint32_t>(random()) & all_lanes;
            Glance on_the_way;
            Seen seen;
            glance(sights, hits, weight, 2, asked, on_the_way, seen);
            read(on_the_way, seen);
            Rgb expected(0);
            for (int l = 0; l < lanes; ++l) {
                if (!(asked >> l & 1u)) {
                    EXPECT_EQ(seen.at(l), Rgb(0));
                    continue;
                }
                const Vec2 uv(hits.u[l], hits.v[l]);
                const Rgb colour = l % 3 == 0 ? Rgb(0.1, 0.2, 0.3) : l % 3 == 1 ? sample(*texture, uv) : Rgb(uv, 1);
                expected += 2 * weight[l] * colour;
                EXPECT_LT(glm::length(seen.at(l) - 2 * weight[l] * colour), 1e-14);
            }
            EXPECT_LT(glm::length(seen.sum() - expected), 1e-13);
        }
    }
}

TEST(Sights, AreNoneForATextureOfOneTexelWhichIsSeenAllTheSame) {
    Scene scene;
    scene.objects = {{"card", Quad{{0, 0, -10},
                                   {500, 0, 0},
                                   {0, 500, 0},
                                   Emissive{std::make_shared<Texture>(Texture{1, 1, {65535, 0, 13107}})}}}};
    EXPECT_FALSE(Paints(scene).sight(0));
    scene.camera.width_px = scene.camera.height_px = 4;
    RenderJob job;
    job.scene = scene;
    EXPECT_LT(glm::length(trace(job).images[0].at(1, 2) - Rgb(1, 0, 0.2)), 1e-12);
}

TEST(SamplesOfAPixel, AreAPositiveNumberHoweverManyAreAsked) {
    constexpr int most = std::numeric_limits<int>::max();
    EXPECT_EQ(samples_of_pixel(16, false), 16);
    EXPECT_EQ(samples_of_pixel(16, true), 64);
    EXPECT_EQ(samples_of_pixel(536870912, true), 2147483648);
    EXPECT_EQ(samples_of_pixel(most, true), most);
}

TEST(SamplerKinds, CoverThePixelEvenlyAndAreAllRightOnAverage) {
    constexpr int n = 24;
    for (const Sampler kind : {Sampler::sobol, Sampler::stratified, Sampler::random}) {
        Vec2 mean(0);
        std::vector<int> cells(n);
        constexpr int pixels = 200;
        for (int pixel = 0; pixel < pixels; ++pixel) {
            PixelSampler sampler(5, pixel, 3);
            sampler.use(kind, n);
            for (int k = 0; k < n; ++k) {
                const Vec2 at = sampler.position(static_cast<std::uint32_t>(k));
                ASSERT_TRUE(at.x >= 0 && at.x < 1 && at.y >= 0 && at.y < 1);
                mean += at / double(n * pixels);
                ++cells[static_cast<std::size_t>(static_cast<int>(at.x * 4) + 4 * static_cast<int>(at.y * 6))];
            }
        }
        EXPECT_LT(glm::length(mean - Vec2(0.5)), 0.02);
        for (const int count : cells) {
            if (kind == Sampler::stratified) {
                EXPECT_EQ(count, pixels);
            }
        }
    }
}

} // namespace
} // namespace threefold::tracer
