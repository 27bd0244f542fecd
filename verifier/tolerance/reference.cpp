// SPDX-License-Identifier: MIT
#include "verifier/tolerance/reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "exporter/process/child.h"
#include "scenes/access.h"
#include "scenes/error.h"
#include "scenes/texture.h"
#include "verifier/claims/orb_light.h"
#include "verifier/measure/optical_map.h"
#include "verifier/optics/transmitted_ray.h"
#include "verifier/tracer/sampler.h"
#include "verifier/tracer/tracer.h"

namespace threefold {

namespace {

/// Glass alone, which neither takes nor gives light, in uniform surroundings.
bool is_furnace(const Scene &scene) {
    return scene.environment && std::ranges::all_of(scene.objects, [](const Object &object) {
               const Glass *glass = glass_of(object.shape);
               return glass && glass->interface_transmittance == 1;
           });
}

/// One ray stays one ray, and ends on a rectangle that emits.
bool is_single_path(const Scene &scene) {
    int orbs = 0;
    for (const Object &object : scene.objects) {
        if (const Glass *glass = glass_of(object.shape)) {
            ++orbs;
            if (glass->coating != Coating::antireflective) return false;
            continue;
        }
        const Quad *quad = std::get_if<Quad>(&object.shape);
        if (!quad || std::holds_alternative<Diffuse>(quad->surface)) return false;
    }
    return orbs <= 1;
}

Rgb radiance_at(const Quad &quad, Vec2 uv) {
    return std::visit(overloaded{
                          [](const Diffuse &) { return Rgb(0); },
                          [&](const Emissive &emissive) { return sample(emissive.radiance, uv); },
                          [&](const CoordinateCard &) { return Rgb(uv.x, uv.y, 1); },
                      },
                      quad.surface);
}

struct Met {
    double distance = std::numeric_limits<double>::infinity();
    Rgb radiance{0};
};

Met meet(const Scene &scene, const Ray &ray) {
    Met met;
    met.radiance = scene.environment ? scene.environment->radiance : Rgb(0);
    for (const Object &object : scene.objects) {
        const Quad *quad = std::get_if<Quad>(&object.shape);
        if (!quad) continue;
        const auto at = optics::landing_on_plane(ray, quad->centre_mm, glm::cross(quad->half_u_mm, quad->half_v_mm));
        if (!at || !on_card(*quad, *at)) continue;
        const double distance = glm::length(*at - ray.origin_mm);
        if (distance < met.distance) met = {distance, radiance_at(*quad, coordinates_on(*quad, *at))};
    }
    return met;
}

/// Snell's law and Bouguer's invariant: the angles to the radius are asin(b / R), asin(b / (n R)) in the glass, and
/// asin(b / (n r)) at the inner surface, so a ray reflected there sweeps twice the difference of the last two about
/// the centre.
double coated_turn_rad(const OrbInScene &orb, double b_mm) {
    const auto impact = optics::impact_at(orb.optics, b_mm);
    if (optics::course(orb.optics, impact) != optics::Course::totally_reflected)
        return optics::deflection(orb.optics, impact).value_or(0);
    const double outside = std::asin(b_mm / orb.optics.outer_mm);
    const double glass = std::asin(b_mm / (orb.optics.index * orb.optics.outer_mm));
    const double inner = std::asin(std::min(1.0, b_mm / (orb.optics.index * orb.optics.inner_mm)));
    return 2 * (inner - glass) - std::numbers::pi + 2 * outside;
}

Rgb single_path(const Scene &scene, const std::optional<OrbInScene> &orb, const Ray &ray) {
    const Met straight = meet(scene, ray);
    if (!orb) return straight.radiance;
    const double b = impact_parameter(ray, orb->centre_mm);
    const double along = glm::dot(orb->centre_mm - ray.origin_mm, ray.direction);
    const double radius = orb->optics.outer_mm;
    if (b >= radius || along < 0) return straight.radiance;
    if (straight.distance < along - std::sqrt((radius - b) * (radius + b))) return straight.radiance;
    const auto course = optics::course(orb->optics, optics::impact_at(orb->optics, b));
    const int crossings = course == optics::Course::through_hollow ? 4 : 2;
    const Ray exit = turned_about_orb(*orb, ray, coated_turn_rad(*orb, b));
    return meet(scene, exit).radiance * std::pow(orb->glass.interface_transmittance, crossings);
}

Image single_path_picture(const Scene &scene, int samples, std::uint64_t seed) {
    const bool has_orb =
        std::ranges::any_of(scene.objects, [](const Object &o) { return glass_of(o.shape) != nullptr; });
    const std::optional<OrbInScene> orb = has_orb ? std::optional(orb_of(scene)) : std::nullopt;
    const Film film(scene.camera);
    Image image(scene.camera.image_width_px(), scene.camera.image_height_px());
    tbb::parallel_for(tbb::blocked_range<int>(0, image.height), [&](const auto &rows) {
        if (interrupt_requested) throw Error(Exit::interrupted, "interrupted");
        for (int row = rows.begin(); row != rows.end(); ++row)
            for (int column = 0; column < image.width; ++column) {
                const tracer::PixelSampler sampler(seed, column, row);
                Rgb sum(0);
                for (int k = 0; k < samples; ++k)
                    sum += single_path(scene, orb,
                                       film.ray(Vec2(column, row) + sampler.position(static_cast<std::uint32_t>(k)) +
                                                scene.camera.film_offset_px));
                image.at(column, row) = sum / static_cast<double>(samples);
            }
    });
    return image;
}

constexpr int first_samples = 16, most_samples = 1 << 16;
constexpr std::uint64_t most_refinements = 2; ///< the first aims by the pilot, the second mends what that missed

std::vector<std::uint64_t> reference_seeds_of(const ReferenceRequest &request, std::uint64_t stage) {
    std::vector<std::uint64_t> seeds;
    for (std::uint64_t k = 0; k < static_cast<std::uint64_t>(request.pictures); ++k)
        seeds.push_back(tracer::mix(request.seed ^ tracer::mix(0x7ef0000u + 16 * stage + k)));
    return seeds;
}

/// Samples enough for the error, from what so many had; nothing when that is good enough, or all that can be afforded.
std::optional<int> samples_for(double error, int samples, const ReferenceRequest &request, double left_cpu_s,
                               double cpu_s_per_sample) {
    if (error <= request.error) return std::nullopt;
    // The error falls at least as the root of the samples, and mostly faster: asked for between the two.
    const double wanted = samples * std::pow(error / request.error, 1.6);
    const double affordable = cpu_s_per_sample > 0 ? left_cpu_s / cpu_s_per_sample : most_samples;
    const double n = std::ceil(std::clamp(std::min(wanted, affordable), 1.0, double(most_samples)));
    return n > samples ? std::optional(static_cast<int>(n)) : std::nullopt;
}

} // namespace

std::optional<std::vector<Image>> closed_form_pictures(const Scene &scene, int samples, int count, std::uint64_t seed) {
    if (is_furnace(scene))
        return std::vector{
            Image(scene.camera.image_width_px(), scene.camera.image_height_px(), scene.environment->radiance)};
    if (!is_single_path(scene)) return std::nullopt;
    std::vector<Image> all;
    for (int k = 0; k < count; ++k)
        all.push_back(single_path_picture(scene, samples, tracer::mix(seed + static_cast<std::uint64_t>(k))));
    return all;
}

ReferencePicture make_reference(const Scene &scene, const ReferenceRequest &request) {
    if (is_furnace(scene)) {
        ReferencePicture exact = exact_reference(closed_form_pictures(scene, 1, 1, request.seed)->front());
        exact.kind = "closed form: uniform surroundings";
        return exact;
    }
    if (is_single_path(scene)) {
        ReferencePicture r;
        for (int n = first_samples;;) {
            r = to_reference(*closed_form_pictures(scene, n, request.pictures, tracer::mix(request.seed ^ 0xc105edu)));
            const auto more = n == first_samples ? samples_for(r.error, n, request, 0, 0) : std::nullopt;
            r.kind = fmt::format("closed form of the single path, {} points a pixel", request.pictures * n);
            if (!more) return r;
            n = std::min(*more, 4096);
        }
    }
    RenderJob job;
    job.scene = scene;
    job.cut_weight = 1e-6;
    job.threads = request.threads;
    double cpu = 0;
    std::optional<int> more = first_samples;
    ReferencePicture r;
    for (std::uint64_t stage = 0; more; ++stage) {
        job.samples_per_pixel = *more;
        job.replicates.clear();
        for (const std::uint64_t seed : reference_seeds_of(request, stage)) job.replicates.push_back({seed, {0, 0}});
        const TracerOutcome outcome = trace(job, {}, request.on_progress);
        cpu += outcome.cpu_seconds;
        r = to_reference(outcome.images);
        r.cpu_seconds = cpu;
        r.kind = fmt::format("our tracer: {} samples a pixel, double, cut 1e-6 ({:.1e} of the light is dropped)",
                             request.pictures * *more, outcome.missing_weight_mean);
        more = stage < most_refinements
                   ? samples_for(r.error, *more, request, request.most_cpu_s - cpu, outcome.cpu_seconds / *more)
                   : std::nullopt;
    }
    return r;
}

} // namespace threefold
