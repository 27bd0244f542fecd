// SPDX-License-Identifier: MIT
// The real POV-Ray against small closed forms and a vector form of Snell's law, both written here.
#include "exporter/povray/povray.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <unistd.h>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "exporter/run.h"
#include "scenes/camera.h"
#include "scenes/error.h"
#include "scenes/light.h"

using namespace threefold;
namespace fs = std::filesystem;

namespace {

// ---------------------------------------------------------------------------------------------------------------------
// What must come out

struct Sphere {
    double radius_mm, index_inside, index_outside;
};

std::optional<Vec3> refracted(Vec3 d, Vec3 normal, double from, double to) {
    double cosine = -glm::dot(d, normal);
    if (cosine < 0) normal = -normal, cosine = -cosine;
    const double ratio = from / to, radicand = 1 - ratio * ratio * (1 - cosine * cosine);
    if (radicand < 0) return std::nullopt;
    return glm::normalize(ratio * d + (ratio * cosine - std::sqrt(radicand)) * normal);
}

struct Path {
    Ray ray;
    int crossings = 0;
};

/// Follows a ray through concentric spheres about the origin: refracted wherever it can be, else reflected. A ray that
/// total reflection keeps inside for good ends in a direction of zero length.
Path through(Ray ray, const std::vector<Sphere> &spheres) {
    int crossings = 0;
    for (int segment = 0; segment < 1000; ++segment) {
        double nearest = 1e300;
        const Sphere *hit = nullptr;
        for (const Sphere &sphere : spheres) {
            const double middle = -glm::dot(ray.origin_mm, ray.direction);
            const Vec3 nearest_point = ray.origin_mm + middle * ray.direction; // no cancellation for a far eye
            const double square = sphere.radius_mm * sphere.radius_mm - glm::dot(nearest_point, nearest_point);
            if (square < 0) continue;
            for (const double t : {middle - std::sqrt(square), middle + std::sqrt(square)})
                if (t > 1e-7 && t < nearest) nearest = t, hit = &sphere;
        }
        if (!hit) return {ray, crossings};
        const Vec3 at = ray.origin_mm + nearest * ray.direction, normal = glm::normalize(at);
        const bool entering = glm::dot(ray.direction, normal) < 0;
        const double from = entering ? hit->index_outside : hit->index_inside;
        const double to = entering ? hit->index_inside : hit->index_outside;
        const auto bent = refracted(ray.direction, normal, from, to);
        crossings += bent ? 1 : 0;
        ray = {at, bent ? *bent : glm::reflect(ray.direction, normal)};
    }
    return {{ray.origin_mm, Vec3(0)}, crossings};
}

std::optional<Vec2> uv_of_landing(const Ray &ray, const Quad &quad) {
    const Vec3 normal = glm::cross(quad.half_u_mm, quad.half_v_mm);
    const double t = glm::dot(quad.centre_mm - ray.origin_mm, normal) / glm::dot(ray.direction, normal);
    const Vec3 on = ray.origin_mm + t * ray.direction - quad.centre_mm;
    const Vec2 uv(0.5 + 0.5 * glm::dot(on, quad.half_u_mm) / glm::dot(quad.half_u_mm, quad.half_u_mm),
                  0.5 + 0.5 * glm::dot(on, quad.half_v_mm) / glm::dot(quad.half_v_mm, quad.half_v_mm));
    if (!(t >= 0) || !std::isfinite(t) || uv.x < 0 || uv.x > 1 || uv.y < 0 || uv.y > 1) return std::nullopt;
    return uv;
}

double fresnel(double cosine, double n) {
    const double t = std::sqrt(1 - (1 - cosine * cosine) / (n * n));
    const double s = (cosine - n * t) / (cosine + n * t), p = (n * cosine - t) / (n * cosine + t);
    return 0.5 * (s * s + p * p);
}

/// Distance of the straight ray from the origin.
double impact_mm(const Ray &ray) { return glm::length(glm::cross(ray.origin_mm, ray.direction)); }

Rgb sample(const Texture &texture, Vec2 uv) {
    const auto texel = [&](int x, int y) {
        x = std::clamp(x, 0, texture.width - 1), y = std::clamp(y, 0, texture.height - 1);
        const auto i = static_cast<std::size_t>(3 * (y * texture.width + x));
        return Rgb(texture.rgb[i], texture.rgb[i + 1], texture.rgb[i + 2]) / 65535.0;
    };
    const Vec2 at(uv.x * texture.width - 0.5, (1 - uv.y) * texture.height - 0.5), low = glm::floor(at);
    const Vec2 f = at - low;
    const int x = static_cast<int>(low.x), y = static_cast<int>(low.y);
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), f.x), glm::mix(texel(x, y + 1), texel(x + 1, y + 1), f.x),
                    f.y);
}

// ---------------------------------------------------------------------------------------------------------------------
// What does come out

class PovRay : public testing::Test {
protected:
    void SetUp() override {
        installed = find_renderer(povray_adapter());
        if (!installed) GTEST_SKIP() << "POV-Ray is not installed";
        const testing::TestInfo *info = testing::UnitTest::GetInstance()->current_test_info();
        folder = fs::temp_directory_path() / fmt::format("threefold-povray-{}-{}", info->name(), ::getpid());
    }
    void TearDown() override {
        if (!HasFailure() && !folder.empty()) fs::remove_all(folder); // a failure's pictures are kept
    }

    std::vector<Image> render(const RenderJob &job) {
        exported = compile_povray(job);
        RunOptions options;
        options.folder = folder;
        return run_exported(povray_adapter(), *installed, exported, job, options).images;
    }
    /// One stored step either way, plus single-precision colours.
    double step() const { return exported.accuracy.radiance_step + 3e-7 / exported.radiance_scale; }

    std::optional<InstalledRenderer> installed;
    fs::path folder;
    Exported exported;
};

RenderJob at_pixel_centres(Scene scene, double cut_weight = 1e-6) {
    RenderJob job;
    job.scene = std::move(scene);
    job.sampling = Sampling::pixel_centres;
    job.cut_weight = cut_weight;
    job.threads = 1;
    return job;
}

const Quad card{
    .centre_mm = {0, 0, -200}, .half_u_mm = {150, 0, 0}, .half_v_mm = {0, 150, 0}, .surface = CoordinateCard{}};

Scene scene_of(std::vector<Shape> shapes, int width_px = 48, int height_px = 40) {
    Scene scene;
    for (Shape &shape : shapes) scene.objects.push_back({"object", std::move(shape)});
    scene.camera.eye_mm = {0, 0, 900};
    scene.camera.width_px = width_px, scene.camera.height_px = height_px;
    return scene;
}

/// Calls `visit(row, column, ray)` for the sample of each pixel.
template <class Visit>
void for_each_sample(const Camera &camera, Visit visit) {
    for (int row = 0; row < camera.image_height_px(); ++row)
        for (int column = 0; column < camera.image_width_px(); ++column)
            visit(row, column, camera_ray(camera, pixel_sample(camera, column, row)));
}

double greatest_difference(const Rgb &a, const Rgb &b) {
    const Rgb d = glm::abs(a - b);
    return std::max({d.r, d.g, d.b});
}

void expect_card(const Image &image, const Camera &camera, const Quad &quad, const std::vector<Sphere> &spheres,
                 double tolerance, double rim_mm = -1, double least_share_seen = 0.25) {
    double worst = 0;
    int seen = 0;
    for_each_sample(camera, [&](int row, int column, const Ray &ray) {
        // Within a hair of an edge of the glass or of the inner rim the landing point changes without bound.
        for (const Sphere &sphere : spheres)
            if (std::abs(impact_mm(ray) - sphere.radius_mm) < rim_mm) return;
        const auto uv = uv_of_landing(through(ray, spheres).ray, quad);
        if (uv) ++seen;
        worst = std::max(worst, greatest_difference(image.at(column, row), uv ? Rgb(*uv, 1) : Rgb(0)));
    });
    EXPECT_GE(seen, least_share_seen * image.width * image.height);
    EXPECT_LE(worst, tolerance);
}

} // namespace

// ---------------------------------------------------------------------------------------------------------------------
// Camera and card

TEST_F(PovRay, sees_the_card_where_the_camera_rays_land_for_any_view_and_offset) {
    Scene oblique = scene_of({card});
    oblique.camera.eye_mm = {310, 170, 700}, oblique.camera.target_mm = {10, -20, -180};
    oblique.camera.up = {0.2, 1, 0.1}, oblique.camera.horizontal_fov_deg = 17;
    oblique.camera.film_offset_px = {0.3, -0.2};
    Scene crop = oblique;
    crop.camera.crop = Crop{5, 17, 40, 20};
    Scene orthographic = crop;
    orthographic.camera.projection = Projection::orthographic, orthographic.camera.orthographic_width_mm = 210;
    for (const Scene &scene : {oblique, crop, orthographic}) {
        RenderJob job = at_pixel_centres(scene);
        job.replicates = {{1, {0.5, 0.25}}};
        const Image image = render(job).front();
        Camera camera = scene.camera;
        camera.film_offset_px += job.replicates.front().film_offset_px;
        expect_card(image, camera, card, {}, step());
    }
}

TEST_F(PovRay, renders_each_replicate_with_its_own_offset) {
    const Scene scene = scene_of({card}, 12, 12);
    RenderJob job = at_pixel_centres(scene);
    job.replicates.clear();
    for (std::uint64_t i = 0; i < 11; ++i) job.replicates.push_back({i, {0.09 * static_cast<double>(i), -0.4}});
    const std::vector<Image> images = render(job);
    ASSERT_EQ(images.size(), 11u);
    for (std::size_t i = 0; i < images.size(); ++i) {
        Camera camera = scene.camera;
        camera.film_offset_px = job.replicates[i].film_offset_px;
        expect_card(images[i], camera, card, {}, step());
    }
}

TEST_F(PovRay, renders_the_same_picture_at_any_scale_and_place) {
    for (const double scale : {1e-6, 1e6})
        for (const double offset : {0.0, 1e6}) {
            Quad quad = card;
            const Vec3 move = Vec3(1, -1, 2) * offset;
            const auto moved = [&](Vec3 p) { return (p + move) * scale; };
            quad.centre_mm = moved(quad.centre_mm), quad.half_u_mm *= scale, quad.half_v_mm *= scale;
            Scene scene = scene_of({GlassBall{.centre_mm = moved(Vec3(0)),
                                              .radius_mm = 68 * scale,
                                              .glass = {.coating = Coating::antireflective}},
                                    quad});
            const Camera standard = scene.camera;
            scene.camera.eye_mm = moved(scene.camera.eye_mm), scene.camera.target_mm = moved(scene.camera.target_mm);
            const Image image = render(at_pixel_centres(scene)).front();
            expect_card(image, standard, card, {{68, 1.51714, 1}}, step(), 0.02);
        }
}

TEST_F(PovRay, averages_a_box_without_bias) {
    // The card's right edge cuts a pixel: the mean over replicates is the covered share.
    Quad quad = card;
    quad.surface = Emissive{};
    Scene scene = scene_of({quad}, 4, 4);
    RenderJob job = at_pixel_centres(scene);
    job.sampling = Sampling::box, job.samples_per_pixel = 3;
    job.replicates.clear();
    for (std::uint64_t i = 0; i < 25; ++i) job.replicates.push_back({i});
    scene.camera.horizontal_fov_deg = job.scene.camera.horizontal_fov_deg = 20;
    const std::vector<Image> images = render(job);
    EXPECT_EQ(exported.supersampling, 2);
    const double half_px = 2 * (150.0 / 1100) / std::tan(10 * std::numbers::pi / 180); // half width of the card
    double mean = 0;
    for (const Image &image : images) mean += image.at(3, 1).r / static_cast<double>(images.size());
    // One of two columns of samples is on the card or not: at most 1/4 standard deviation each.
    EXPECT_NEAR(mean, half_px - 1, 4 * 0.25 / 5);
    EXPECT_GT(mean, 0.4);
    EXPECT_LT(mean, 0.7);
}

// ---------------------------------------------------------------------------------------------------------------------
// Glass

TEST_F(PovRay, bends_light_through_a_ball_as_snell_says) {
    const Scene scene = scene_of({GlassBall{.glass = {.coating = Coating::antireflective}}, card}, 96, 96);
    const Image image = render(at_pixel_centres(scene)).front();
    expect_card(image, scene.camera, card, {{68, 1.51714, 1}}, step());
}

TEST_F(PovRay, bends_light_through_shells_of_any_wall_as_snell_says) {
    for (const double wall : {20.0, 1.36, 0.01, 1e-4}) {
        const Scene scene =
            scene_of({GlassShell{.wall_mm = wall, .glass = {.coating = Coating::antireflective}}, card}, 64, 64);
        const Image image = render(at_pixel_centres(scene)).front();
        expect_card(image, scene.camera, card, {{68, 1.51714, 1}, {68 - wall, 1, 1.51714}}, 2e-5, 1e-3);
    }
}

TEST_F(PovRay, loses_no_light_in_a_white_furnace_but_what_it_is_told_to_drop) {
    Scene scene = scene_of({GlassShell{}}, 24, 24);
    scene.environment = Environment{Rgb(3)};
    double worst = 0;
    const Image image = render(at_pixel_centres(scene)).front();
    for (const Rgb &pixel : image.pixels) worst = std::max(worst, std::abs(1 - pixel.r / 3));
    EXPECT_LT(worst, 5e-3);
}

TEST_F(PovRay, applies_the_interface_transmittance_at_every_crossing_and_to_no_reflection) {
    // In a ball every internal reflection has the same F: F + (1-F)^2 tau^2 (1 + F + F^2 + ...) = F + (1 - F) tau^2.
    const double tau = 0.8, n = 1.51714;
    Scene scene = scene_of({GlassBall{.glass = {n, tau, Coating::fresnel}}}, 32, 32);
    scene.environment = Environment{Rgb(1)};
    const Image image = render(at_pixel_centres(scene)).front();
    double worst = 0;
    for_each_sample(scene.camera, [&](int row, int column, const Ray &ray) {
        const double b = impact_mm(ray) / 68;
        const double f = b < 1 ? fresnel(std::sqrt(1 - b * b), n) : 1;
        worst = std::max(worst, std::abs(image.at(column, row).r - (f + (1 - f) * tau * tau)));
    });
    EXPECT_LT(worst, 1.5e-5);
}

TEST_F(PovRay, divides_light_in_a_shell_as_fresnel_says_in_all_orders) {
    // All surfaces are met at two angles only, so the tree folds into three unknowns: what a ray sees in the wall going
    // inwards, in the wall going outwards, and in the hollow.
    const double tau = 0.9, n = 1.51714, inner = 58;
    Scene scene = scene_of({GlassShell{.wall_mm = 68 - inner, .glass = {n, tau, Coating::fresnel}}}, 24, 24);
    scene.environment = Environment{Rgb(1)};
    const Image image = render(at_pixel_centres(scene, 1e-8)).front();
    double worst = 0;
    for_each_sample(scene.camera, [&](int row, int column, const Ray &ray) {
        const double b = impact_mm(ray);
        const double f1 = b < 68 ? fresnel(std::sqrt(1 - b * b / 68 / 68), n) : 1;
        const double f2 = b < inner ? fresnel(std::sqrt(1 - b * b / inner / inner), n) : 1;
        double inwards = 0, outwards = 0, hollow = 0;
        for (int i = 0; i < 2000; ++i) {
            outwards = f1 * inwards + (1 - f1) * tau;
            hollow = f2 * hollow + (1 - f2) * tau * outwards;
            inwards = f2 * outwards + (1 - f2) * tau * hollow;
        }
        worst = std::max(worst, std::abs(image.at(column, row).r - (f1 + (1 - f1) * tau * inwards)));
    });
    EXPECT_LT(worst, 3e-5);
}

TEST_F(PovRay, sees_from_inside_the_hollow_the_wall_and_the_ball) {
    struct View {
        Shape orb;
        std::vector<Sphere> spheres;
    };
    const Glass glass{.coating = Coating::antireflective};
    for (const View &view : {View{GlassShell{.wall_mm = 20, .glass = glass}, {{68, 1.51714, 1}, {48, 1, 1.51714}}},
                             View{GlassBall{.glass = glass}, {{68, 1.51714, 1}}}})
        for (const Vec3 eye : {Vec3(20, 5, 11), Vec3(35, 5, -40), Vec3(50, 5, 11)}) {
            Scene scene = scene_of({view.orb, card}, 32, 32);
            scene.camera.eye_mm = eye, scene.camera.target_mm = eye + Vec3(-1, 0, -30);
            scene.camera.horizontal_fov_deg = 30;
            const Image image = render(at_pixel_centres(scene)).front();
            // From the last place all light is kept inside for good, through more reflections than POV-Ray's stack
            // holds.
            const bool trapped = eye.x == 50;
            expect_card(image, scene.camera, card, view.spheres, step(), -1, trapped ? 0 : 0.5);
        }
}

TEST_F(PovRay, reflects_totally_at_the_inner_wall_of_a_coated_shell) {
    const double tau = 0.5, wall = 10;
    Scene scene = scene_of({GlassShell{.wall_mm = wall, .glass = {1.51714, tau, Coating::antireflective}}}, 48, 48);
    scene.environment = Environment{Rgb(1)};
    const Image image = render(at_pixel_centres(scene)).front();
    double worst = 0;
    int rim = 0;
    for_each_sample(scene.camera, [&](int row, int column, const Ray &ray) {
        const double b = impact_mm(ray);
        if (b > 58 && b < 68) ++rim;
        const double expected = b > 68 ? 1 : b > 58 ? tau * tau : tau * tau * tau * tau;
        worst = std::max(worst, std::abs(image.at(column, row).r - expected));
        EXPECT_EQ(std::pow(tau, through(ray, {{68, 1.51714, 1}, {58, 1, 1.51714}}).crossings), expected);
    });
    EXPECT_GT(rim, 100);
    EXPECT_LE(worst, step());
}

// ---------------------------------------------------------------------------------------------------------------------
// Surfaces and light

std::shared_ptr<const Texture> small_texture() {
    Texture texture{.width = 3, .height = 2, .rgb = {}};
    for (int i = 0; i < 18; ++i) texture.rgb.push_back(static_cast<std::uint16_t>((i * 7919 + 13) * 61 % 65536));
    return std::make_shared<const Texture>(texture);
}

TEST_F(PovRay, shows_a_texture_upright_and_bilinear_on_a_quad_and_on_a_mesh) {
    const auto texture = small_texture();
    Quad quad = card;
    quad.surface = Emissive{texture};
    const auto at = [&](double u, double v) {
        return quad.centre_mm + (2 * u - 1) * quad.half_u_mm + (2 * v - 1) * quad.half_v_mm;
    };
    const Mesh mesh{.vertices_mm = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)},
                    .triangles = {{0, 1, 2}, {0, 2, 3}},
                    .uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                    .surface = Emissive{texture}};
    for (const Shape &shape : {Shape(quad), Shape(mesh)}) {
        Scene scene = scene_of({shape}, 60, 50);
        scene.camera.horizontal_fov_deg = 17;
        const Image image = render(at_pixel_centres(scene)).front();
        double worst = 0;
        for_each_sample(scene.camera, [&](int row, int column, const Ray &ray) {
            const auto uv = uv_of_landing(ray, quad);
            worst = std::max(worst, greatest_difference(image.at(column, row), uv ? sample(*texture, *uv) : Rgb(0)));
        });
        EXPECT_LE(worst, step() + 1e-6);
    }
}

TEST_F(PovRay, shows_a_mesh_card_like_a_quad_card_and_from_behind) {
    const auto at = [&](double u, double v) {
        return card.centre_mm + (2 * u - 1) * card.half_u_mm + (2 * v - 1) * card.half_v_mm;
    };
    const Mesh mesh{.vertices_mm = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)},
                    .triangles = {{0, 1, 2}, {0, 2, 3}},
                    .uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                    .surface = CoordinateCard{}};
    for (const Shape &shape : {Shape(card), Shape(mesh)}) {
        Scene scene = scene_of({shape});
        scene.camera.eye_mm = {30, 20, -1200};
        const Image image = render(at_pixel_centres(scene)).front();
        expect_card(image, scene.camera, card, {}, step() + 1e-6);
    }
}

TEST_F(PovRay, lights_a_diffuse_surface_as_lambert_says) {
    const auto texture = small_texture();
    Quad quad = card;
    quad.surface = Diffuse{texture};
    Scene scene = scene_of({quad});
    scene.lights = {{{1, -2, -3}, Rgb(2, 3, 4)}, {{0, 0, -1}, Rgb(0.5)}, {{0, 0, 1}, Rgb(100)}}; // the last from behind
    const Image image = render(at_pixel_centres(scene)).front();
    const Rgb irradiance = Rgb(2, 3, 4) * 3.0 / std::sqrt(14.0) + 0.5;
    double worst = 0;
    for_each_sample(scene.camera, [&](int row, int column, const Ray &ray) {
        const auto uv = uv_of_landing(ray, quad);
        const Rgb expected = uv ? sample(*texture, *uv) * irradiance / std::numbers::pi : Rgb(0);
        worst = std::max(worst, greatest_difference(image.at(column, row), expected));
    });
    EXPECT_LE(worst, step() + 2e-6);
}

TEST_F(PovRay, casts_the_shadow_that_the_rule_says_and_never_shows_its_proxy) {
    Quad quad = card;
    quad.surface = Diffuse{Rgb(1)};
    using Rule = GlassShadow::Rule;
    for (const auto &[rule, transmittance, expected] :
         {std::tuple{Rule::none, 0.3, 1.0}, std::tuple{Rule::opaque, 0.3, 0.0}, std::tuple{Rule::constant, 0.3, 0.3}}) {
        // The light comes at a slant: the shadow lies beside the orb. Behind it, the wall is seen through coated glass.
        Scene scene = scene_of({GlassShell{.glass = {.coating = Coating::antireflective}}, quad}, 64, 32);
        scene.camera.horizontal_fov_deg = 20;
        scene.lights = {{{1, 0, -1}, Rgb(std::numbers::pi * std::numbers::sqrt2)}};
        scene.glass_shadow = {rule, transmittance};
        const Image image = render(at_pixel_centres(scene)).front();
        double worst = 0;
        int in_shadow = 0, through_glass = 0;
        for_each_sample(scene.camera, [&](int row, int column, const Ray &straight) {
            const Ray ray = through(straight, {{68, 1.51714, 1}, {66.64, 1, 1.51714}}).ray;
            const auto uv = uv_of_landing(ray, quad);
            if (!uv) {
                EXPECT_EQ(image.at(column, row), Rgb(0));
                return;
            }
            const Vec3 at(300 * (uv->x - 0.5), 300 * (uv->y - 0.5), -200);
            const double b = glm::length(glm::cross(at, glm::normalize(Vec3(-1, 0, 1))));
            if (std::abs(b - 68) < 1e-3) return;
            (b < 68 ? in_shadow : through_glass) += b < 68 || impact_mm(straight) < 68 ? 1 : 0;
            worst = std::max(worst, std::abs(image.at(column, row).r - (b < 68 ? expected : 1)));
        });
        EXPECT_GT(in_shadow, 50);
        EXPECT_GT(through_glass, 50);
        EXPECT_LE(worst, step() + 2e-6);
    }
}

TEST_F(PovRay, casts_the_shadow_of_a_dome_as_of_other_lights) {
    Quad quad = card;
    quad.surface = Diffuse{Rgb(1)};
    Scene scene = scene_of({GlassBall{.glass = {.coating = Coating::antireflective}}, quad}, 32, 16);
    scene.camera.horizontal_fov_deg = 20;
    scene.environment = Environment{Rgb(0.5), 24};
    scene.glass_shadow = {GlassShadow::Rule::opaque, 1};
    const Image image = render(at_pixel_centres(scene)).front();
    double worst = 0;
    int in_shadow = 0;
    for_each_sample(scene.camera, [&](int row, int column, const Ray &straight) {
        const auto uv = uv_of_landing(straight, quad);
        if (!uv || impact_mm(straight) < 69) return;
        const Vec3 at(300 * (uv->x - 0.5), 300 * (uv->y - 0.5), -200);
        double expected = 0, nearest_edge = 1e9;
        bool shadowed = false;
        for (const Directional &light : dome(*scene.environment)) {
            const Vec3 travel = glm::normalize(light.travel);
            if (travel.z >= 0) continue; // from behind the card
            const double b = glm::length(glm::cross(at, travel));
            nearest_edge = std::min(nearest_edge, std::abs(b - 68));
            if (b < 68 && glm::dot(at, travel) > 0)
                shadowed = true;
            else
                expected += light.irradiance.r * -travel.z / std::numbers::pi;
        }
        if (nearest_edge < 1e-3) return;
        in_shadow += shadowed;
        worst = std::max(worst, std::abs(image.at(column, row).r - expected));
    });
    EXPECT_GT(in_shadow, 50);
    EXPECT_LE(worst, 2 * step() + 4e-6);
}

// ---------------------------------------------------------------------------------------------------------------------
// Names

TEST_F(PovRay, never_runs_what_a_name_says) {
    Scene scene = scene_of({card}, 16, 16);
    scene.name = "\"; #include \"evil.inc\" \n #declare x = 1; /*\r\n#fopen F \"canary\" write\n";
    scene.objects.front().name = "*/ \\\" } \n#include \"evil.inc\"\u2028\u0085 sphere { 0, 1 } \xff\xfe // \x01";
    fs::create_directories(folder);
    std::ofstream(folder / "evil.inc") << "#fopen F \"canary\" write\n#write (F, \"ran\")\n#fclose F\n";
    const Image image = render(at_pixel_centres(scene)).front();
    EXPECT_FALSE(fs::exists(folder / "canary"));
    expect_card(image, scene.camera, card, {}, step());
}
