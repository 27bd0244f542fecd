// SPDX-License-Identifier: MIT
// The real POV-Ray, and what must come out of it: Snell's law in vectors through concentric spheres, and the card.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include <unistd.h>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "exporter/povray/povray.h"
#include "exporter/run.h"
#include "scenes/camera.h"

namespace threefold::povray_tests {

// ---------------------------------------------------------------------------------------------------------------------
// What must come out

struct Sphere {
    double radius_mm, index_inside, index_outside;
};

inline std::optional<Vec3> refracted(Vec3 d, Vec3 normal, double from, double to) {
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
inline Path through(Ray ray, const std::vector<Sphere> &spheres) {
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

inline std::optional<Vec2> uv_of_landing(const Ray &ray, const Quad &quad) {
    const Vec3 normal = glm::cross(quad.half_u_mm, quad.half_v_mm);
    const double t = glm::dot(quad.centre_mm - ray.origin_mm, normal) / glm::dot(ray.direction, normal);
    const Vec3 on = ray.origin_mm + t * ray.direction - quad.centre_mm;
    const Vec2 uv(0.5 + 0.5 * glm::dot(on, quad.half_u_mm) / glm::dot(quad.half_u_mm, quad.half_u_mm),
                  0.5 + 0.5 * glm::dot(on, quad.half_v_mm) / glm::dot(quad.half_v_mm, quad.half_v_mm));
    if (!(t >= 0) || !std::isfinite(t) || uv.x < 0 || uv.x > 1 || uv.y < 0 || uv.y > 1) return std::nullopt;
    return uv;
}

inline double fresnel(double cosine, double n) {
    const double t = std::sqrt(1 - (1 - cosine * cosine) / (n * n));
    const double s = (cosine - n * t) / (cosine + n * t), p = (n * cosine - t) / (n * cosine + t);
    return 0.5 * (s * s + p * p);
}

/// Distance of the straight ray from the origin.
inline double impact_mm(const Ray &ray) { return glm::length(glm::cross(ray.origin_mm, ray.direction)); }

// ---------------------------------------------------------------------------------------------------------------------
// What does come out

class PovRay : public testing::Test {
protected:
    void SetUp() override {
        installed = find_renderer(povray_adapter());
        if (!installed) GTEST_SKIP() << "POV-Ray is not installed";
        const testing::TestInfo *info = testing::UnitTest::GetInstance()->current_test_info();
        folder =
            std::filesystem::temp_directory_path() / fmt::format("threefold-povray-{}-{}", info->name(), ::getpid());
    }
    void TearDown() override {
        if (!HasFailure() && !folder.empty()) std::filesystem::remove_all(folder); // a failure's pictures are kept
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
    std::filesystem::path folder;
    Exported exported;
};

inline RenderJob at_pixel_centres(Scene scene, double cut_weight = 1e-6) {
    RenderJob job;
    job.scene = std::move(scene);
    job.sampling = Sampling::pixel_centres;
    job.cut_weight = cut_weight;
    job.threads = 1;
    return job;
}

inline const Quad card{
    .centre_mm = {0, 0, -200}, .half_u_mm = {150, 0, 0}, .half_v_mm = {0, 150, 0}, .surface = CoordinateCard{}};

inline Scene scene_of(std::vector<Shape> shapes, int width_px = 48, int height_px = 40) {
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

inline double greatest_difference(const Rgb &a, const Rgb &b) {
    const Rgb d = glm::abs(a - b);
    return std::max({d.r, d.g, d.b});
}

inline void expect_card(const Image &image, const Camera &camera, const Quad &quad, const std::vector<Sphere> &spheres,
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

} // namespace threefold::povray_tests
