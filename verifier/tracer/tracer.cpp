// SPDX-License-Identifier: MIT
#include "verifier/tracer/tracer.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <mutex>
#include <optional>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "exporter/process/child.h"
#include "scenes/access.h"
#include "scenes/camera.h"
#include "scenes/error.h"
#include "scenes/geometry.h"
#include "scenes/validate.h"
#include "verifier/tracer/pixel.h"

namespace threefold {

namespace {

using namespace tracer;

double cpu_seconds(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

/// Other renders may go on in this process: with one thread its own clock says what is this render's.
clockid_t set_up_clock(const RenderJob &job) {
    return job.threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_PROCESS_CPUTIME_ID;
}

/// Numbers are finest about the origin, and the orb is where they matter: the scene with its first orb there. Nothing
/// of it is lost, since differences of near numbers are exact. Empty where the orb stands there already, or there is
/// none.
std::optional<Scene> about_its_orb(const Scene &scene) {
    const auto orb = first_orb(scene);
    if (!orb || orb->centre_mm == Vec3(0)) return std::nullopt;
    const Vec3 centre = orb->centre_mm;
    Scene moved = scene;
    for (Object &object : moved.objects)
        std::visit(overloaded{[&](GlassBall &b) { b.centre_mm -= centre; },
                              [&](GlassShell &s) { s.centre_mm -= centre; }, [&](Quad &q) { q.centre_mm -= centre; },
                              [&](Mesh &m) {
                                  for (Vec3 &v : m.vertices_mm) v -= centre;
                              }},
                   object.shape);
    moved.camera.eye_mm -= centre;
    moved.camera.target_mm -= centre;
    return moved;
}

constexpr double spacing = 0x1p-23; ///< of numbers in single precision, over their size

/// Which of two things a ray meets first is told by their distances from the eye, rounded.
void refuse_too_far_an_eye(const Scene &scene) {
    constexpr double greatest_share = 0.1;
    for (const Object &object : scene.objects) {
        const auto orb = outer_sphere(object.shape);
        if (!orb) continue;
        const double distance_mm = glm::distance(orb->centre_mm, scene.camera.eye_mm);
        const double farthest_mm = greatest_share / spacing * orb->radius_mm;
        if (distance_mm > farthest_mm)
            throw Error(
                Exit::bad_data,
                fmt::format("the tracer in single precision: the eye is {:.3g} mm from an orb of radius {:.3g} mm; "
                            "beyond {:.3g} mm it cannot tell whether the orb or what stands behind comes first",
                            distance_mm, orb->radius_mm, farthest_mm),
                "use double precision");
    }
}

/// A ray inside glass meets nothing but the orb's own surfaces. A hand that is pressed into it by less than what
/// matters to a picture is let pass.
void refuse_meshes_in_glass(const Scene &scene) {
    constexpr double least_share = 1 - 1e-3; // of the radius
    for (const Object &orb : scene.objects) {
        const auto sphere = outer_sphere(orb.shape);
        if (!sphere) continue;
        for (const Object &other : scene.objects) {
            const Mesh *mesh = std::get_if<Mesh>(&other.shape);
            if (!mesh) continue;
            const double nearest_mm = distance_to(*mesh, sphere->centre_mm);
            if (nearest_mm < least_share * sphere->radius_mm)
                throw Error(Exit::bad_data,
                            fmt::format("the mesh {} reaches into the glass orb {} ({:.4g} mm from its centre, radius "
                                        "{:.4g} mm): the tracer meets nothing in there",
                                        other.name, orb.name, nearest_mm, sphere->radius_mm),
                            "move it out of the orb, or render with POV-Ray or Cycles");
        }
    }
}

/// Through Embree a ray begins at a place in single precision: so far away that this is a good part of a pixel.
void refuse_too_far_an_eye_for_embree(const Scene &scene) {
    constexpr double greatest_px = 0.05;
    if (!needs_embree(scene)) return;
    const Film film(scene.camera);
    const double distance_mm = glm::distance(scene.camera.eye_mm, finest_about(scene));
    const double pixel_mm = film.pixel() * (film.is_perspective() ? distance_mm : 1);
    if (spacing * distance_mm > greatest_px * pixel_mm)
        throw Error(Exit::bad_data,
                    fmt::format("the tracer meets meshes, and many rectangles, from an eye in single precision: {:.3g} "
                                "mm away that is {:.2g} of a pixel, {:g} at most",
                                distance_mm, spacing * distance_mm / pixel_mm, greatest_px),
                    "bring the eye nearer, or make the field of view wider or the pixels fewer");
}

template <class Real>
void render(const RenderJob &job, const TreeEnd<Real> &end, const std::function<void(double)> &on_progress,
            Sampler sampler, double cpu_start, TracerOutcome &outcome) {
    const Camera &camera = job.scene.camera;
    const int width = camera.image_width_px(), height = camera.image_height_px();
    const int samples = job.sampling == Sampling::box ? job.samples_per_pixel : 1;
    const World<Real> world(job.scene, job.slip, end, samples);
    outcome.set_up_cpu_seconds = cpu_seconds(set_up_clock(job)) - cpu_start;
    const double pixels = static_cast<double>(width) * height * static_cast<double>(job.replicates.size());

    const double of_all = static_cast<double>(tiles_of(camera)) * static_cast<double>(job.replicates.size());
    std::atomic<double> done = 0, rendering_cpu = 0;
    std::mutex progress_mutex;
    tbb::enumerable_thread_specific<PixelScratch<Real>> scratches;
    double missing_sum = 0;
    for (const Replicate &replicate : job.replicates) {
        Image image(width, height);
        std::vector<double> missing(image.pixels.size());
        const PixelRenderer<Real> pixel(world, job, replicate, sampler);
        tbb::parallel_for(tbb::blocked_range<int>(0, tiles_of(camera)), [&](const auto &tiles) {
            const double start = cpu_seconds(CLOCK_THREAD_CPUTIME_ID);
            PixelScratch<Real> &scratch = scratches.local();
            for (int tile = tiles.begin(); tile != tiles.end(); ++tile) {
                if (interrupt_requested) throw Error(Exit::interrupted, "interrupted");
                render_tile(pixel, camera, tile, scratch, image.pixels, missing);
            }
            rendering_cpu += cpu_seconds(CLOCK_THREAD_CPUTIME_ID) - start;
            if (on_progress) {
                const double now = done += static_cast<double>(tiles.size());
                const std::lock_guard lock(progress_mutex);
                on_progress(now / of_all);
            }
        });
        for (const double m : missing) {
            missing_sum += m;
            outcome.missing_weight_greatest = std::max(outcome.missing_weight_greatest, m);
        }
        outcome.images.push_back(std::move(image));
    }
    outcome.missing_weight_mean = missing_sum / pixels;
    outcome.cpu_seconds = outcome.set_up_cpu_seconds + rendering_cpu;
}

} // namespace

TracerOutcome trace(const RenderJob &job, const TracerSettings &settings,
                    const std::function<void(double)> &on_progress) {
    if (std::optional<Scene> moved = about_its_orb(job.scene)) {
        RenderJob same = job;
        same.scene = *std::move(moved);
        return trace(same, settings, on_progress);
    }
    const auto start = std::chrono::steady_clock::now();
    const double cpu_start = cpu_seconds(set_up_clock(job));
    const Needs n = needs(job.scene);
    if (n.caustics) throw Error(Exit::bad_data, "the tracer does not follow caustics onto diffuse surfaces");
    if (n.environment_on_diffuse)
        throw Error(Exit::bad_data,
                    "the tracer lights diffuse surfaces by parallel lights only: give the environment a dome of them");
    if (job.most_bounces)
        throw Error(Exit::bad_data, "the tracer ends a tree by its weight, not by a number of surfaces");
    refuse_meshes_in_glass(job.scene);
    refuse_too_far_an_eye_for_embree(job.scene);
    TracerOutcome outcome;
    const bool roulette = settings.transport == Transport::roulette;
    tbb::task_arena arena(job.threads > 0 ? job.threads : tbb::task_arena::automatic);
    arena.execute([&] {
        const auto run = [&]<class Real>(Real) {
            render<Real>(job,
                         {static_cast<Real>(roulette ? 0 : job.cut_weight),
                          static_cast<Real>(roulette ? settings.roulette_weight : 0)},
                         on_progress, settings.sampler, cpu_start, outcome);
        };
        switch (settings.precision) {
        case Precision::single_precision:
            refuse_too_far_an_eye(job.scene);
            run(float{});
            break;
        case Precision::double_precision:
            run(double{});
            break;
        }
    });
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return outcome;
}

Accuracy tracer_accuracy(const RenderJob &job, const TracerSettings &settings) {
    double extent = glm::length(job.scene.camera.eye_mm - job.scene.camera.target_mm);
    for (const Object &object : job.scene.objects)
        if (const Quad *quad = std::get_if<Quad>(&object.shape))
            extent = std::max(extent,
                              glm::length(quad->centre_mm - job.scene.camera.target_mm) + glm::length(quad->half_u_mm));
    // Some ten roundings at the scale of the scene.
    const double rounding = settings.precision == Precision::double_precision ? 1.1e-16 : 6e-8;
    Accuracy accuracy;
    accuracy.rounding_mm = 10 * rounding * extent;
    accuracy.radiance_step = rounding;
    accuracy.cut_weight = settings.transport == Transport::tree ? job.cut_weight : 0;
    accuracy.cuts_whole_trees = true;
    return accuracy;
}

} // namespace threefold
