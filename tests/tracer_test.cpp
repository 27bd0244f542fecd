// SPDX-License-Identifier: MIT
// Our tracer against closed forms, against a plain path-by-path reference, and against itself.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>

#include <glm/geometric.hpp>

#include "scenes/camera.h"
#include "scenes/error.h"
#include "scenes/validate.h"
#include "tests/catalogue_scene.h"
#include "verifier/claims/prediction.h"
#include "verifier/measure/optical_map.h"
#include "verifier/measure/radiance.h"
#include "verifier/tracer/orb.h"
#include "verifier/tracer/tracer.h"

namespace threefold {
namespace {

Scene scene(std::string_view name, const std::vector<Assignment> &assignments) {
    Scene made = catalogue_scene(name, assignments);
    validate(made);
    return made;
}

RenderJob job_of(Scene scene, Sampling sampling, int samples = 1) {
    RenderJob job;
    job.scene = std::move(scene);
    job.sampling = sampling;
    job.samples_per_pixel = samples;
    return job;
}

/// Every branch on its own, by vectors in space: no plane of incidence, no merging. Slow and plain on purpose.
struct PlainTree {
    double outer, inner, index, cut;
    double sum = 0, dropped = 0;
    Vec3 weighted_direction{0};

    void in_air(Vec3 p, Vec3 d, double weight) {
        sum += weight;
        weighted_direction += weight * d;
        (void)p;
    }

    /// At a sphere: `n` is the unit normal against the ray.
    void split(Vec3 p, Vec3 d, double weight, Vec3 n, double n1, double n2, auto reflected, auto transmitted) {
        const double c1 = -glm::dot(d, n), eta = n1 / n2, k = 1 - eta * eta * (1 - c1 * c1);
        double r = 1;
        if (k > 0) {
            const double c2 = std::sqrt(k);
            const double rs = (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2), rp = (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2);
            r = (rs * rs + rp * rp) / 2;
            go(weight * (1 - r), [&](double w) { transmitted(p, glm::normalize(eta * d + (eta * c1 - c2) * n), w); });
        }
        go(weight * r, [&](double w) { reflected(p, glm::normalize(d + 2 * c1 * n), w); });
    }

    void go(double weight, auto next) {
        if (weight < cut)
            dropped += weight;
        else
            next(weight);
    }

    void enter(Vec3 p, Vec3 d) {
        split(
            p, d, 1, glm::normalize(p), 1, index, [&](Vec3 q, Vec3 e, double w) { in_air(q, e, w); },
            [&](Vec3 q, Vec3 e, double w) { in_glass(q, e, w); });
    }

    void in_glass(Vec3 p, Vec3 d, double weight) {
        const double along = -glm::dot(p, d);
        const Vec3 foot = p + along * d;
        const double distance = glm::length(foot);
        if (along > 0 && distance < inner && glm::length(p) > inner * (1 + 1e-9)) {
            const Vec3 q = foot - std::sqrt(inner * inner - distance * distance) * d;
            split(
                q, d, weight, glm::normalize(q), index, 1, [&](Vec3 a, Vec3 e, double w) { in_glass(a, e, w); },
                [&](Vec3 a, Vec3 e, double w) { in_hollow(a, e, w); });
            return;
        }
        const Vec3 q = foot + std::sqrt(outer * outer - distance * distance) * d;
        split(
            q, d, weight, -glm::normalize(q), index, 1, [&](Vec3 a, Vec3 e, double w) { in_glass(a, e, w); },
            [&](Vec3 a, Vec3 e, double w) { in_air(a, e, w); });
    }

    void in_hollow(Vec3 p, Vec3 d, double weight) {
        const Vec3 q = p - 2 * glm::dot(p, d) * d;
        split(
            q, d, weight, -glm::normalize(q), 1, index, [&](Vec3 a, Vec3 e, double w) { in_hollow(a, e, w); },
            [&](Vec3 a, Vec3 e, double w) { in_glass(a, e, w); });
    }
};

class PlainTreeTest : public testing::TestWithParam<double> {};

TEST_P(PlainTreeTest, MergedTreeSendsTheSameLightTheSameWayAsAPlainTreeInSpace) {
    const double inner = GetParam(), outer = 68, index = 1.51714;
    for (const double b : {0.0, 12.3, 40.0, 60.0, 66.0}) {
        const Vec3 d = glm::normalize(Vec3(0.3, -0.2, -1));
        const Vec3 sideways = glm::normalize(glm::cross(d, Vec3(0, 1, 0)));
        const tracer::RayOf<double> ray{b * sideways - 500.0 * d, d};
        const tracer::Orb<double> orb{Vec3(0), outer, inner, index, 1, Coating::fresnel};
        tracer::Entry<double> entry{};
        ASSERT_TRUE(tracer::intersect(orb, ray, entry));
        tracer::TreeScratch<double> scratch;
        double sum = 0;
        Vec3 direction(0);
        const double dropped = tracer::trace_orb(
            orb, ray, entry, tracer::TreeEnd<double>{1e-9, 0}, scratch,
            [&](Vec3 p, Vec3 e, double w) {
                EXPECT_NEAR(glm::length(p), outer, 1e-11);
                EXPECT_NEAR(glm::length(e), 1, 1e-12);
                sum += w;
                direction += w * e;
            },
            [] { return 0.5; });
        EXPECT_NEAR(sum + dropped, 1, 1e-13);

        PlainTree plain{outer, inner, index, 1e-7};
        plain.enter(ray.origin + entry.distance * d, d);
        EXPECT_NEAR(plain.sum + plain.dropped, 1, 1e-12);
        EXPECT_NEAR(glm::length(plain.weighted_direction - direction), 0, 2 * plain.dropped + 1e-9) << "b = " << b;
    }
}

INSTANTIATE_TEST_SUITE_P(SolidAndHollow, PlainTreeTest, testing::Values(0.0, 30.0, 60.0, 66.64));

struct Landing {
    std::string scene;
    std::vector<Assignment> assignments;
};

void PrintTo(const Landing &landing, std::ostream *out) {
    *out << landing.scene;
    for (const Assignment &a : landing.assignments) *out << ' ' << a.name << '=' << a.value;
}

class LandingTest : public testing::TestWithParam<Landing> {};

TEST_P(LandingTest, NinetyFivePercentOfPixelsLandWithinATenBillionthOfTheRadius) {
    std::vector<Assignment> assignments = GetParam().assignments;
    for (const Assignment &a : {Assignment{"card.surface", "coordinate"},
                                {"glass.coating", "antireflective"},
                                {"image.width_px", "64"},
                                {"image.height_px", "64"}})
        assignments.push_back(a);
    const Scene s = scene(GetParam().scene, assignments);
    const OrbInScene orb = orb_of(s);
    const Quad &card = card_of(s);
    const Image image = trace(job_of(s, Sampling::pixel_centres)).images.front();
    std::vector<double> errors;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const Ray ray = camera_ray(s.camera, pixel_sample(s.camera, column, row));
            if (impact_parameter(ray, orb.centre_mm) >= 0.98 * orb.clear_radius_mm()) continue;
            const auto predicted = predicted_landing(orb, card, ray);
            const auto landed = landing_point(card, image.at(column, row));
            if (predicted && on_card(card, *predicted, 0.1)) {
                ASSERT_TRUE(landed) << column << ' ' << row;
                errors.push_back(glm::length(*landed - *predicted) / orb.optics.outer_mm);
            }
        }
    ASSERT_GT(errors.size(), 200u);
    EXPECT_LT(quantile(errors, 0.95), 1e-11);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, LandingTest,
    testing::Values(Landing{"solid", {}}, Landing{"hollow", {{"orb.wall_mm", "0.68"}}},
                    Landing{"hollow", {{"orb.wall_mm", "1.36"}}}, Landing{"hollow", {{"orb.wall_mm", "2.72"}}},
                    Landing{"solid", {{"glass.index", "1.05"}, {"eye.distance_mm", "500"}}},
                    Landing{"solid", {{"glass.index", "2.4"}, {"card.distance_mm", "100"}}},
                    Landing{"hollow",
                            {{"glass.index", "2.4"}, {"eye.distance_mm", "2000"}, {"card.distance_mm", "400"}}},
                    Landing{"hollow", {{"orb.wall_mm", "1e-6"}, {"orb.shift_mm", "10"}}}));

TEST(Furnace, EveryRingOfHalfAPercentOfTheRadiusIsOne) {
    for (const char *kind : {"hollow", "solid"}) {
        const Scene s = scene("furnace", {{"orb.kind", kind}, {"image.width_px", "512"}, {"image.height_px", "512"}});
        const TracerOutcome outcome = trace(job_of(s, Sampling::pixel_centres));
        const OrbInScene orb = orb_of(s);
        const auto rings = ring_means(outcome.images.front(), 200, [&](int column, int row) {
            const Ray ray = camera_ray(s.camera, pixel_sample(s.camera, column, row));
            return static_cast<int>(impact_parameter(ray, orb.centre_mm) / orb.optics.outer_mm * 200);
        });
        for (const double ring : rings)
            if (!std::isnan(ring)) {
                EXPECT_NEAR(ring, 1, 1e-5);
            }
        EXPECT_GT(outcome.missing_weight_mean, 0) << "a cut tree must own up to what it dropped";
        EXPECT_LT(outcome.missing_weight_greatest, 1e-5);
    }
}

TEST(Furnace, MissingWeightIsJustWhatThePictureLacks) {
    RenderJob job =
        job_of(scene("furnace", {{"image.width_px", "64"}, {"image.height_px", "64"}}), Sampling::pixel_centres);
    job.cut_weight = 1e-2;
    const TracerOutcome outcome = trace(job);
    const Rgb m = rectangle_mean(outcome.images.front(), 0, 0, 64, 64);
    EXPECT_GT(outcome.missing_weight_mean, 1e-4);
    EXPECT_NEAR(1 - m.g, outcome.missing_weight_mean, 1e-12);
}

TEST(Furnace, RouletteDropsNothingAndIsRightOnAverage) {
    TracerSettings settings;
    settings.transport = Transport::roulette;
    const TracerOutcome outcome = trace(
        job_of(scene("furnace", {{"image.width_px", "128"}, {"image.height_px", "128"}}), Sampling::box, 16), settings);
    EXPECT_EQ(outcome.missing_weight_mean, 0);
    EXPECT_NEAR(rectangle_mean(outcome.images.front(), 0, 0, 128, 128).g, 1, 1e-4);
}

TEST(Tracer, ThePictureIsTheSameForAnyNumberOfThreads) {
    RenderJob job = job_of(scene("hollow", {{"image.width_px", "48"}, {"image.height_px", "40"}}), Sampling::box, 4);
    job.threads = 1;
    const Image one = trace(job).images.front();
    for (const int threads : {2, 3, 8}) {
        job.threads = threads;
        EXPECT_EQ(trace(job).images.front().pixels, one.pixels) << threads;
    }
}

TEST(Tracer, SeedsGiveDifferentNoiseAndTheSameMean) {
    RenderJob job = job_of(scene("solid", {{"image.width_px", "64"}, {"image.height_px", "64"}}), Sampling::box, 16);
    job.replicates = {{1, {}}, {2, {}}};
    const TracerOutcome o = trace(job);
    EXPECT_NE(o.images[0].pixels, o.images[1].pixels);
    EXPECT_NEAR(rectangle_mean(o.images[0], 0, 0, 64, 64).g, rectangle_mean(o.images[1], 0, 0, 64, 64).g, 1e-3);
}

TEST(Tracer, SinglePrecisionIsCloseToDouble) {
    const RenderJob job =
        job_of(scene("hollow", {{"image.width_px", "64"}, {"image.height_px", "64"}}), Sampling::pixel_centres);
    TracerSettings single;
    single.precision = Precision::single_precision;
    const Image a = trace(job).images.front(), b = trace(job, single).images.front();
    std::vector<double> differences;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) differences.push_back(std::abs(a.pixels[i].g - b.pixels[i].g));
    EXPECT_NE(a.pixels, b.pixels);
    EXPECT_LT(quantile(differences, 0.95), 1e-4);
}

// Nothing stands over a flat net: its cells must not shade one another, though Embree's numbers are single.
TEST(Tracer, AFlatNetOfFineCellsShadesNoneOfItself) {
    for (const double elevation_deg : {0.2, 1.0, 5.0, 30.0}) {
        Scene s;
        s.objects = {{"orb", GlassBall{{0, 0, 0}, 68, {}}}};
        s.glass_shadow.rule = GlassShadow::Rule::none;
        const Vec3 u = glm::normalize(Vec3(1, 0.3, 0.2)), n = glm::normalize(glm::cross(u, Vec3(0.1, 0.2, -1))),
                   v = glm::cross(n, u), middle(300, -230, 120);
        Mesh net{.vertices_mm = {}, .triangles = {}, .uv = {}, .surface = Diffuse{Rgb(0.5)}};
        constexpr int cells = 120;
        for (int j = 0; j <= cells; ++j)
            for (int i = 0; i <= cells; ++i)
                net.vertices_mm.push_back(middle + 0.5 * (i - cells / 2) * u + 0.5 * (j - cells / 2) * v);
        for (unsigned j = 0; j < cells; ++j)
            for (unsigned i = 0; i < cells; ++i) {
                const unsigned a = j * (cells + 1) + i, b = a + cells + 1;
                net.triangles.insert(net.triangles.end(), {{a, a + 1, b}, {b, a + 1, b + 1}});
            }
        s.objects.push_back({"net", net});
        const double elevation = elevation_deg * std::numbers::pi / 180;
        s.lights = {
            Directional{-(std::cos(elevation) * glm::normalize(u + 0.7 * v) + std::sin(elevation) * n), Rgb(1)}};
        s.camera.eye_mm = middle + 200.0 * n;
        s.camera.target_mm = middle;
        s.camera.up = v;
        s.camera.projection = Projection::orthographic;
        s.camera.orthographic_width_mm = 50;
        s.camera.width_px = s.camera.height_px = 256;
        RenderJob job;
        job.scene = s;
        job.samples_per_pixel = 4;
        const Image image = trace(job).images.front();
        const double lit = 0.5 / std::numbers::pi * std::sin(elevation);
        std::size_t darker = 0;
        for (const Rgb &pixel : image.pixels) darker += !(std::abs(pixel.g - lit) < 1e-9 * lit);
        EXPECT_EQ(darker, 0u) << "at " << elevation_deg << " degrees";
    }
}

// A step beside the place that is lit does stand in the way, however low.
TEST(Tracer, AStepOfAThousandthOfAMillimetreCastsItsShadow) {
    Scene s;
    constexpr double high = 1e-3;
    Mesh step{.vertices_mm = {{-50, 0, -50},
                              {0, 0, -50},
                              {0, 0, 50},
                              {-50, 0, 50},
                              {0, high, -50},
                              {50, high, -50},
                              {50, high, 50},
                              {0, high, 50}},
              .triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 7}, {1, 7, 2}, {4, 5, 6}, {4, 6, 7}},
              .uv = {},
              .surface = Diffuse{Rgb(0.5)}};
    s.objects = {{"step", step}};
    const double elevation = 0.01; // the shadow is 0.1 mm wide
    s.lights = {Directional{{-std::cos(elevation), -std::sin(elevation), 0}, Rgb(1)}};
    s.camera.eye_mm = {-0.1, 10, 0};
    s.camera.target_mm = {-0.1, 0, 0};
    s.camera.up = {0, 0, 1};
    s.camera.projection = Projection::orthographic;
    s.camera.orthographic_width_mm = 0.2;
    s.camera.width_px = 40;
    s.camera.height_px = 2;
    RenderJob job;
    job.scene = s;
    job.samples_per_pixel = 64;
    const Image image = trace(job).images.front();
    double dark = 0;
    for (int column = 0; column < 40; ++column) dark += image.at(column, 0).g == 0 ? 0.005 : 0;
    EXPECT_NEAR(dark, high / std::tan(elevation), 0.006);
}

TEST(Tracer, LightsADiffuseSurfaceByLambertAndTheGlassShadowRule) {
    Scene s;
    s.objects = {{"floor", Quad{{0, 0, -100}, {200, 0, 0}, {0, 200, 0}, Diffuse{Rgb(0.5)}}},
                 {"orb", GlassBall{{0, 0, 0}, 20, {}}}};
    s.lights = {{{0, 0, -1}, Rgb(3)}};
    s.camera.eye_mm = {150, 0, 400};
    s.camera.target_mm = {0, 0, -100};
    s.camera.width_px = s.camera.height_px = 9; // the middle pixel looks at the point straight behind the orb
    s.camera.horizontal_fov_deg = 1;
    const double lit = 0.5 * 3 / M_PI;
    const auto middle = [&](GlassShadow::Rule rule, double transmittance) {
        s.glass_shadow = {rule, transmittance};
        return trace(job_of(s, Sampling::pixel_centres)).images.front().at(4, 4).g;
    };
    EXPECT_NEAR(middle(GlassShadow::Rule::none, 1), lit, 1e-12);
    EXPECT_NEAR(middle(GlassShadow::Rule::opaque, 1), 0, 1e-12);
    EXPECT_NEAR(middle(GlassShadow::Rule::constant, 0.3), 0.3 * lit, 1e-12);
    s.glass_shadow.rule = GlassShadow::Rule::caustic;
    EXPECT_THROW(trace(job_of(s, Sampling::pixel_centres)), Error);
}

TEST(Tracer, SeesAMeshAsTheRectangleThatItIs) {
    Scene quad;
    quad.camera.width_px = quad.camera.height_px = 32;
    quad.camera.eye_mm = {30, 20, 300};
    quad.camera.horizontal_fov_deg = 20;
    Scene mesh = quad;
    quad.objects = {{"card", Quad{{0, 0, -50}, {40, 0, 0}, {0, 40, 0}, CoordinateCard{}}}};
    Mesh m;
    m.vertices_mm = {{-40, -40, -50}, {40, -40, -50}, {40, 40, -50}, {-40, 40, -50}};
    m.uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    m.triangles = {{0, 1, 2}, {0, 2, 3}};
    m.surface = CoordinateCard{};
    mesh.objects = {{"card", m}};
    const Image a = trace(job_of(quad, Sampling::pixel_centres)).images.front();
    const Image b = trace(job_of(mesh, Sampling::pixel_centres)).images.front();
    for (std::size_t i = 0; i < a.pixels.size(); ++i) EXPECT_LT(glm::length(a.pixels[i] - b.pixels[i]), 1e-12);
}

RC_GTEST_PROP(TracerProperty, APictureStaysWhenTheWholeSceneIsScaled, ()) {
    const double factor = std::pow(10.0, *rc::gen::inRange(-6, 7));
    Scene s = scene("hollow", {{"image.width_px", "12"}, {"image.height_px", "12"}, {"card.surface", "coordinate"}});
    Scene t = s;
    auto &shell = std::get<GlassShell>(t.objects[0].shape);
    shell.outer_radius_mm *= factor;
    shell.wall_mm *= factor;
    auto &card = std::get<Quad>(t.objects[1].shape);
    card.centre_mm *= factor;
    card.half_u_mm *= factor;
    card.half_v_mm *= factor;
    t.camera.eye_mm *= factor;
    const Image a = trace(job_of(s, Sampling::pixel_centres)).images.front();
    const Image b = trace(job_of(t, Sampling::pixel_centres)).images.front();
    for (std::size_t i = 0; i < a.pixels.size(); ++i) RC_ASSERT(glm::length(a.pixels[i] - b.pixels[i]) < 1e-11);
}

/// A scene of rectangles that shine goes by packets gathered from many pixels; with one more that does not, too
/// small to be hit, every pixel goes alone.
TEST(Tracer, SeesTheSameByGatheredPacketsAsByThePixelsOwn) {
    for (const char *wall : {"1.36", "20", "0.001"}) {
        RenderJob job =
            job_of(scene("hollow", {{"card.surface", "textured"}, {"orb.wall_mm", wall}}), Sampling::box, 16);
        job.cut_weight = 1e-9;
        if (job.scene.environment) job.scene.environment->dome_directions = 8; // for the one that does not shine
        Camera &camera = job.scene.camera;
        camera.width_px = camera.height_px = 37;
        const Image plain = trace(job).images[0];
        job.scene.objects.push_back(
            {"speck", Quad{camera.eye_mm + Vec3(0, 0, 1e4), {1e-6, 0, 0}, {0, 1e-6, 0}, Diffuse{Rgb(0.5)}}});
        const Image general = trace(job).images[0];
        const Film film(camera);
        int compared = 0;
        for (int row = 0; row < 37; ++row)
            for (int column = 0; column < 37; ++column) {
                const Ray ray = film.ray(Vec2(column + 0.5, row + 0.5));
                if (glm::length(glm::cross(ray.direction, -ray.origin_mm)) > 67) continue; // beside: more samples
                ++compared;
                EXPECT_LT(glm::length(plain.at(column, row) - general.at(column, row)), 1e-8) << column << ' ' << row;
            }
        EXPECT_GT(compared, 500);
    }
}

} // namespace
} // namespace threefold
