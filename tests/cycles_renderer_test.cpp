// SPDX-License-Identifier: MIT
// The real Cycles against small closed forms and a vector form of Snell's law, both written here.
#include "exporter/blender/cycles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "exporter/run.h"
#include "scenes/camera.h"
#include "scenes/error.h"
#include "tests/temporary_folder.h"

using namespace threefold;

namespace {

// ---------------------------------------------------------------------------------------------------------------------
// What must come out

constexpr double radius_mm = 68;

std::optional<Vec3> refracted(Vec3 d, Vec3 normal, double ratio) {
    const double cosine = -glm::dot(d, normal), radicand = 1 - ratio * ratio * (1 - cosine * cosine);
    if (radicand < 0) return std::nullopt;
    return glm::normalize(ratio * d + (ratio * cosine - std::sqrt(radicand)) * normal);
}

struct Path {
    Ray ray;
    int crossings = 0;
};

/// Through spheres about the origin (the inner one is a hollow; 0: none): refracted wherever that can be, else
/// reflected.
Path through(Ray ray, double inner_mm, double index) {
    int crossings = 0;
    while (true) {
        double nearest = 1e300, radius = 0;
        for (const double r : {radius_mm, inner_mm}) {
            const double b = glm::dot(ray.origin_mm, ray.direction);
            const double c = glm::dot(ray.origin_mm, ray.origin_mm) - r * r;
            if (r == 0 || b * b < c) continue;
            for (const double t : {-b - std::sqrt(b * b - c), -b + std::sqrt(b * b - c)})
                if (t > 1e-7 && t < nearest) nearest = t, radius = r;
        }
        if (radius == 0) return {ray, crossings};
        const Vec3 at = ray.origin_mm + nearest * ray.direction;
        const bool inwards = glm::dot(ray.direction, at) < 0;
        const Vec3 normal = glm::normalize(inwards ? at : -at);
        const bool into_glass = inwards == (radius == radius_mm);
        const auto bent = refracted(ray.direction, normal, into_glass ? 1 / index : index);
        crossings += bent ? 1 : 0;
        ray = {at, bent ? *bent : glm::reflect(ray.direction, normal)};
    }
}

/// Distance of the straight ray from the origin.
double impact_mm(const Ray &ray) { return glm::length(glm::cross(ray.origin_mm, ray.direction)); }

/// The card lies across the z axis.
std::optional<Vec2> landing_mm(const Ray &ray, const Quad &card) {
    const double t = (card.centre_mm.z - ray.origin_mm.z) / ray.direction.z;
    const Vec3 at = ray.origin_mm + t * ray.direction;
    if (t < 0 || std::abs(at.x) > card.half_u_mm.x || std::abs(at.y) > card.half_v_mm.y) return std::nullopt;
    return Vec2(at);
}

Vec2 read_mm(Rgb pixel, const Quad &card) {
    return {(2 * pixel.r / pixel.b - 1) * card.half_u_mm.x, (2 * pixel.g / pixel.b - 1) * card.half_v_mm.y};
}

// ---------------------------------------------------------------------------------------------------------------------
// What does come out

class CyclesRenderer : public testing::Test {
protected:
    void SetUp() override {
        installed = find_renderer(cycles_adapter());
        if (!installed) GTEST_SKIP() << "Blender is not installed";
    }

    std::vector<Image> render(const RenderJob &job) {
        exported = compile_cycles(job);
        RunOptions options;
        options.folder = folder.path();
        return run_exported(cycles_adapter(), *installed, exported, job, options).images;
    }

    std::optional<InstalledRenderer> installed;
    TemporaryFolder folder;
    Exported exported;
};

Camera small_camera(int width_px, int height_px) {
    Camera camera;
    camera.width_px = width_px;
    camera.height_px = height_px;
    return camera;
}

/// As far away as the camera's `eye_mm.z`, just around the orb.
Camera camera_on_orb(double eye_mm, int size_px) {
    Camera camera = small_camera(size_px, size_px);
    camera.eye_mm = {0, 0, eye_mm};
    camera.horizontal_fov_deg = 2.2 * std::asin(radius_mm / eye_mm) * 180 / std::numbers::pi;
    return camera;
}

Quad card_at(double distance_mm, double half_mm, Surface surface = CoordinateCard{}) {
    return {.centre_mm = {0, 0, -distance_mm},
            .half_u_mm = {half_mm, 0, 0},
            .half_v_mm = {0, half_mm, 0},
            .surface = surface};
}

RenderJob job_of(Camera camera, std::vector<Object> objects, Sampling sampling = Sampling::pixel_centres) {
    RenderJob job;
    job.scene.camera = camera;
    job.scene.objects = std::move(objects);
    job.sampling = sampling;
    return job;
}

Rgb mean(const Image &image) {
    Rgb sum(0);
    for (const Rgb &p : image.pixels) sum += p;
    return sum / static_cast<double>(image.pixels.size());
}

/// Greatest distance in pixels between where the card is and where the picture shows it.
double registration_px(const RenderJob &job, const std::vector<Image> &images) {
    const Quad &card = std::get<Quad>(job.scene.objects.front().shape);
    double worst = 0;
    int seen = 0;
    for (std::size_t i = 0; i < images.size(); ++i) {
        Camera camera = job.scene.camera;
        camera.film_offset_px += job.replicates[i].film_offset_px;
        const double distance_mm =
            camera.projection == Projection::perspective ? camera.eye_mm.z - card.centre_mm.z : 1;
        const double pixel_mm = 2 * film_half_width(camera) / camera.width_px * distance_mm;
        for (int y = 0; y < images[i].height; ++y)
            for (int x = 0; x < images[i].width; ++x)
                if (const auto at = landing_mm(camera_ray(camera, pixel_sample(camera, x, y)), card)) {
                    worst = std::max(worst, glm::distance(read_mm(images[i].at(x, y), card), *at) / pixel_mm);
                    ++seen;
                }
    }
    EXPECT_GT(seen, 500);
    return worst;
}

TEST_F(CyclesRenderer, shows_the_card_where_the_camera_says) {
    RenderJob job = job_of(small_camera(96, 64), {{"card", card_at(200, 200)}});
    job.scene.camera.film_offset_px = {0.1, 0.2};
    job.replicates = {{1, {0, 0}}, {2, {0.25, -0.375}}};
    EXPECT_LT(registration_px(job, render(job)), 1e-4);
}

TEST_F(CyclesRenderer, shows_a_crop_as_a_window_of_the_film) {
    RenderJob job = job_of(small_camera(960, 640), {{"card", card_at(200, 200)}});
    job.scene.camera.crop = Crop{100, 500, 40, 20};
    EXPECT_LT(registration_px(job, render(job)), 3e-4); // a 3 millionth of the whole film
}

TEST_F(CyclesRenderer, shows_the_card_from_aside_and_in_parallel_projection) {
    RenderJob job = job_of(small_camera(96, 64), {{"card", card_at(200, 200)}});
    job.scene.camera.eye_mm = {300, 200, 700};
    job.scene.camera.target_mm = {20, -30, -200};
    job.scene.camera.up = {0.1, 1, 0};
    EXPECT_LT(registration_px(job, render(job)), 3e-4);
    job.scene.camera.projection = Projection::orthographic;
    EXPECT_LT(registration_px(job, render(job)), 3e-4);
}

struct Bend {
    double index, wall_mm, eye_mm, card_mm; ///< wall 0: solid
};

class CyclesBends : public CyclesRenderer, public testing::WithParamInterface<Bend> {};

TEST_P(CyclesBends, light_as_snell_says) {
    const auto [index, wall_mm, eye_mm, card_distance_mm] = GetParam();
    const Glass glass{index, 1, Coating::antireflective};
    const Shape orb = wall_mm > 0 ? Shape(GlassShell{Vec3(0), radius_mm, wall_mm, glass})
                                  : Shape(GlassBall{Vec3(0), radius_mm, glass});
    const Quad card = card_at(card_distance_mm, 150);
    const RenderJob job = job_of(camera_on_orb(eye_mm, 80), {{"orb", orb}, {"card", card}});
    const Image image = render(job).front();
    EXPECT_LE(exported.accuracy.surface_mm, usual_surface_share * radius_mm);

    std::vector<double> errors;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Ray ray = camera_ray(job.scene.camera, pixel_sample(job.scene.camera, x, y));
            if (impact_mm(ray) >= radius_mm) continue;
            const auto at = landing_mm(through(ray, wall_mm > 0 ? radius_mm - wall_mm : 0, index).ray, card);
            if (!at) continue;
            const double error = image.at(x, y).b == 0 ? 1e9 : glm::distance(read_mm(image.at(x, y), card), *at);
            errors.push_back(error / radius_mm);
        }
    ASSERT_GT(errors.size(), 500u);
    std::ranges::sort(errors);
    const double median = errors[errors.size() / 2], p95 = errors[errors.size() * 95 / 100];
    RecordProperty("p95", fmt::format("{:.3g}", p95));
    EXPECT_LT(median, 3e-5);
    EXPECT_LT(p95, 2e-4);
    EXPECT_LT(errors.back(), 1e-2); // rays that just miss the hollow, or leave along the surface
}

INSTANTIATE_TEST_SUITE_P(BallsAndShells, CyclesBends,
                         testing::Values(Bend{1.05, 0, 500, 100}, Bend{1.51714, 0, 900, 250}, Bend{2.4, 0, 2000, 400},
                                         Bend{1.05, 1.36, 2000, 400}, Bend{1.51714, 1.36, 900, 250},
                                         Bend{1.51714, 0.1, 900, 250}, Bend{2.4, 2.72, 500, 100}));

TEST_F(CyclesRenderer, keeps_a_furnace_at_one) {
    RenderJob job = job_of(camera_on_orb(900, 64), {{"orb", GlassShell{}}}, Sampling::box);
    job.scene.environment = Environment{Rgb(1)};
    const Image image = render(job).front();
    EXPECT_NEAR(mean(image).g, 1, 1e-4);
    // No noise at all, since every branch has its own share of the samples; one path in 60,000 is lost.
    EXPECT_LE(std::ranges::count_if(image.pixels, [](const Rgb &p) { return std::abs(p.g - 1) > 1e-5; }), 4);
}

TEST_F(CyclesRenderer, takes_the_transmittance_at_every_crossing_and_at_no_reflection) {
    const double wall_mm = 5;
    RenderJob job = job_of(camera_on_orb(900, 64),
                           {{"orb", GlassShell{Vec3(0), radius_mm, wall_mm, {1.5, 0.5, Coating::antireflective}}}});
    job.scene.environment = Environment{Rgb(1)};
    const Image image = render(job).front();
    int counts[5] = {};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Ray ray = camera_ray(job.scene.camera, pixel_sample(job.scene.camera, x, y));
            const double b = impact_mm(ray);
            if (std::abs(b - radius_mm) < 0.01 || std::abs(b - (radius_mm - wall_mm)) < 0.01) continue;
            const int crossings = through(ray, radius_mm - wall_mm, 1.5).crossings;
            ++counts[crossings];
            EXPECT_NEAR(image.at(x, y).g, std::pow(0.5, crossings), 1e-6) << "b = " << b;
        }
    EXPECT_GT(counts[0], 100);
    EXPECT_GT(counts[2], 100); // the totally reflecting rim
    EXPECT_GT(counts[4], 1000);
}

TEST_F(CyclesRenderer, reflects_by_fresnel_whatever_the_transmittance) {
    Camera camera = camera_on_orb(900, 320);
    camera.crop = Crop{152, 152, 16, 16}; // the middle of the orb: normal incidence to 1e-3
    RenderJob job = job_of(camera, {{"orb", GlassBall{Vec3(0), radius_mm, {1.5, 0, Coating::fresnel}}}}, Sampling::box);
    job.samples_per_pixel = 1024;
    job.surface_tolerance_mm = 0.1;
    job.scene.environment = Environment{Rgb(1)};
    EXPECT_NEAR(mean(render(job).front()).g, 0.04, 4 * std::sqrt(0.04 / (256 * 1024)));

    // All orders that leave at the back: T^2 (1 + R^2 + R^4 + ...) = (1 - R) / (1 + R)
    std::get<GlassBall>(job.scene.objects.front().shape).glass.interface_transmittance = 1;
    job.scene.environment.reset();
    job.scene.objects.push_back({"card", card_at(200, 2000, Emissive{Rgb(2, 1, 0.5)})});
    const Rgb seen = mean(render(job).front());
    const double expected = 0.96 / 1.04;
    EXPECT_NEAR(seen.g, expected, 4 * std::sqrt(expected * (1 - expected) / (256 * 1024)));
    EXPECT_NEAR(seen.r, 2 * seen.g, 1e-5);
    EXPECT_NEAR(seen.b, 0.5 * seen.g, 1e-5);
}

TEST_F(CyclesRenderer, lays_textures_upright_and_blends_between_texel_centres) {
    auto texture = std::make_shared<Texture>();
    texture->width = 3, texture->height = 2;
    for (int i = 0; i < 18; ++i) texture->rgb.push_back(static_cast<std::uint16_t>(1000 + 3571 * i));
    Camera camera = small_camera(48, 48);
    camera.projection = Projection::orthographic;
    camera.orthographic_width_mm = 200;
    const Quad card = card_at(0, 100, Emissive{std::shared_ptr<const Texture>(texture)});
    Mesh behind; // the same texture on a mesh; seen where the card is not, which is nowhere
    behind.vertices_mm = {{-100, -100, -9}, {100, -100, -9}, {100, 100, -9}};
    behind.triangles = {{0, 1, 2}};
    behind.uv = {{0, 0}, {1, 0}, {1, 1}};
    behind.surface = card.surface;
    const Image on_card = render(job_of(camera, {{"card", card}, {"mesh", behind}})).front();
    const Image on_mesh = render(job_of(camera, {{"mesh", behind}})).front();
    const auto texel = [&](int x, int y) {
        const auto i = static_cast<std::size_t>(3 * (std::clamp(y, 0, 1) * 3 + std::clamp(x, 0, 2)));
        return Rgb(texture->rgb[i], texture->rgb[i + 1], texture->rgb[i + 2]) / 65535.0;
    };
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 48; ++x) {
            const Vec2 at((x + 0.5) / 48 * 3 - 0.5, (y + 0.5) / 48 * 2 - 0.5);
            const int i = static_cast<int>(std::floor(at.x)), j = static_cast<int>(std::floor(at.y));
            const double f = at.x - i, g = at.y - j;
            const Rgb expected = (1 - g) * ((1 - f) * texel(i, j) + f * texel(i + 1, j)) +
                                 g * ((1 - f) * texel(i, j + 1) + f * texel(i + 1, j + 1));
            EXPECT_LT(glm::length(on_card.at(x, y) - expected), 2e-6) << x << ", " << y;
            if (x + y > 48) {
                EXPECT_LT(glm::length(on_mesh.at(x, y) - expected), 2e-6) << x << ", " << y;
            }
            if (x + y < 46) {
                EXPECT_EQ(on_mesh.at(x, y), Rgb(0)) << x << ", " << y;
            }
        }
}

TEST_F(CyclesRenderer, lights_diffuse_surfaces_and_shades_them_by_the_scenes_rule) {
    Camera camera = small_camera(80, 40);
    camera.projection = Projection::orthographic;
    camera.orthographic_width_mm = 800;
    RenderJob job = job_of(camera, {{"wall", card_at(200, 400, Diffuse{Rgb(0.5, 0.25, 1)})},
                                    {"orb", GlassShell{Vec3(0), radius_mm, 1.36, {1.5, 0.9, Coating::fresnel}}}});
    job.scene.lights = {{Vec3(-1, 0, -1), Rgb(3, 2, 1)}};
    job.surface_tolerance_mm = 0.05;
    const Rgb lit = Rgb(1.5, 0.5, 1) * std::sqrt(0.5) / std::numbers::pi;
    struct Case {
        GlassShadow shadow;
        double share;
    };
    for (const Case &c : {Case{{GlassShadow::Rule::none, 1}, 1}, Case{{GlassShadow::Rule::opaque, 1}, 0},
                          Case{{GlassShadow::Rule::constant, 0.36}, 0.36}}) {
        job.scene.glass_shadow = c.shadow;
        const Image image = render(job).front();
        EXPECT_LT(glm::length(image.at(70, 20) - lit), 1e-6);           // in the open
        EXPECT_LT(glm::length(image.at(20, 20) - c.share * lit), 1e-6); // in the shadow's middle, at x = -200 mm
    }
}

TEST_F(CyclesRenderer, averages_a_box_without_leaning_to_the_pixels_centre) {
    Camera camera = small_camera(64, 64);
    camera.projection = Projection::orthographic;
    camera.orthographic_width_mm = 64; // a pixel is a millimetre
    Quad half_plane = card_at(10, 100, Emissive{Rgb(1)});
    half_plane.centre_mm.x = -100 + 0.25;
    RenderJob job = job_of(camera, {{"half-plane", half_plane}}, Sampling::box);
    job.samples_per_pixel = 8;
    double covered = 0;
    const Image image = render(job).front();
    for (int y = 0; y < 64; ++y) covered += image.at(32, y).g / 64;
    EXPECT_NEAR(covered, 0.25, 0.01); // with the pixel's centre as one sample in eight: 0.219
    EXPECT_EQ(image.at(31, 7).g, 1);
    EXPECT_EQ(image.at(33, 7).g, 0);
}

TEST_F(CyclesRenderer, makes_other_noise_of_other_seeds_and_the_same_of_the_same) {
    RenderJob job = job_of(camera_on_orb(900, 32),
                           {{"orb", GlassBall{Vec3(0), radius_mm, {}}}, {"card", card_at(200, 300, Emissive{Rgb(1)})}},
                           Sampling::box);
    job.surface_tolerance_mm = 0.05;
    job.samples_per_pixel = 64;
    job.replicates = {{1, {0, 0}}, {2, {0.5, 0}}, {std::uint64_t{1} << 40, {0, 0}}, {1, {0, 0}}};
    const std::vector<Image> images = render(job);
    ASSERT_EQ(images.size(), 4u);
    const auto difference = [](const Image &a, const Image &b) {
        double worst = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i)
            worst = std::max(worst, glm::length(a.pixels[i] - b.pixels[i]));
        return worst;
    };
    EXPECT_GT(difference(images[0], images[2]), 0.01);
    EXPECT_LT(difference(images[0], images[3]), 1e-5);
    EXPECT_NEAR(mean(images[0]).g, mean(images[2]).g, 4 * std::sqrt(2 * 0.08 / (32 * 32 * 64)));
    // What Cycles keeps between replicates changes none of them.
    job.replicates = {{2, {0.5, 0}}};
    EXPECT_LT(difference(render(job).front(), images[1]), 1e-5);
}

TEST_F(CyclesRenderer, runs_no_code_in_a_name) {
    const std::vector<std::string> names{"'''); import os; os.system(\"touch pwned\") #",
                                         "\"\"\"\nraise SystemExit(9)\n",
                                         "\\",
                                         "\\'''",
                                         std::string("\0nul", 4),
                                         "\xff\xfe broken",
                                         "\u7403 \u2028 {0} %s",
                                         "",
                                         std::string(500, 'x')};
    RenderJob job = job_of(small_camera(8, 8), {});
    for (const std::string &name : names) job.scene.objects.push_back({name, card_at(200, 200)});
    job.scene.name = names.front();
    EXPECT_NEAR(render(job).front().at(4, 4).b, 1, 1e-6);
    EXPECT_FALSE(std::filesystem::exists(folder / "pwned"));
    EXPECT_FALSE(std::filesystem::exists("pwned"));
}

TEST_F(CyclesRenderer, says_why_a_script_failed) {
    const RenderJob job = job_of(small_camera(8, 8), {{"orb", GlassBall{}}, {"card", card_at(200, 200)}});
    Exported broken = compile_cycles(job);
    for (ExportedFile &file : broken.files)
        if (file.name.ends_with(".bin")) file.bytes.resize(file.bytes.size() / 2);
    RunOptions options;
    options.folder = folder.path();
    try {
        run_exported(cycles_adapter(), *installed, broken, job, options);
        FAIL() << "a mesh that is cut short must not pass";
    } catch (const Error &error) {
        EXPECT_NE(std::string(error.what()).find("a mesh file is too short"), std::string::npos) << error.what();
    }
}

} // namespace
