// SPDX-License-Identifier: MIT
#include "verifier/tracer/tracer.h"

#include <atomic>
#include <chrono>
#include <ctime>
#include <deque>
#include <limits>
#include <mutex>
#include <numbers>

#include <tbb/blocked_range2d.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "exporter/process/child.h"
#include "scenes/camera.h"
#include "scenes/error.h"
#include "scenes/validate.h"
#include "verifier/tracer/lights.h"
#include "verifier/tracer/orb.h"
#include "verifier/tracer/sampler.h"
#include "verifier/tracer/surfaces.h"

namespace threefold {

namespace {

using namespace tracer;

constexpr int tile_px = 16;
constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
/// Light between orbs dies out long before; a bound keeps the stack safe.
constexpr int greatest_depth = 64;

template <class Real>
std::vector<Orb<Real>> orbs_of(const Scene &scene, const Slip &slip) {
    std::vector<Orb<Real>> orbs;
    const auto add = [&](Vec3 centre, double outer, double inner, const Glass &glass) {
        orbs.push_back({Vector<Real>(centre), static_cast<Real>(outer), static_cast<Real>(inner),
                        static_cast<Real>(glass.index), static_cast<Real>(glass.interface_transmittance),
                        glass.coating});
        Orb<Real> &orb = orbs.back();
        orb.inner_transmittance = static_cast<Real>(
            slip.inner_tint_forgotten > 0 ? std::pow(glass.interface_transmittance, 1 - slip.inner_tint_forgotten)
                                          : glass.interface_transmittance);
        if (slip.inner_normal_flipped) orb.hollow_index = orb.index * orb.index; // as if it entered glass once more
        if (slip.most_interfaces) orb.most_interfaces = *slip.most_interfaces;
    };
    for (const Object &object : scene.objects)
        std::visit(overloaded{
                       [&](const GlassBall &b) { add(b.centre_mm, b.radius_mm, 0, b.glass); },
                       [&](const GlassShell &s) { add(s.centre_mm, s.outer_radius_mm, s.inner_radius_mm(), s.glass); },
                       [](const Quad &) {},
                       [](const Mesh &) {},
                   },
                   object.shape);
    return orbs;
}

/// The scene, ready to be asked for the radiance along a ray.
template <class Real>
class World {
public:
    World(const Scene &scene, const Slip &slip, const TreeEnd<Real> &end, int samples)
        : scene_(scene), end_(end), orbs_(orbs_of<Real>(scene, slip)), surfaces_(scene, std::is_same_v<Real, double>),
          lights_(scene, samples) {}

    /// What one thread and one sample carry along.
    struct Path {
        std::deque<TreeScratch<Real>> scratch;
        PixelSampler *sampler = nullptr;
        const std::vector<Light> *lights = nullptr;
        double dropped = 0;
    };

    const Lights &lights() const { return lights_; }

    /// `left` is the orb that the ray has just left, if any: it cannot meet it again.
    Rgb radiance(const RayOf<Real> &ray, double weight, std::size_t left, int depth, Path &path) const {
        Entry<Real> entry{};
        const std::size_t orb = nearest_orb(ray, left, entry);
        const Ray exact{Vec3(ray.origin), Vec3(ray.direction)};
        const auto hit = surfaces_.intersect(exact);
        if (hit && (orb == none || hit->distance <= static_cast<double>(entry.distance)))
            return leaving(*hit, *path.lights);
        if (orb == none) return scene_.environment ? scene_.environment->radiance : Rgb(0);
        if (depth >= greatest_depth) {
            path.dropped += weight;
            return Rgb(0);
        }
        while (path.scratch.size() <= static_cast<std::size_t>(depth)) path.scratch.emplace_back();
        Rgb sum(0);
        TreeEnd<Real> end = end_;
        end.cut = static_cast<Real>(std::min(1.0, static_cast<double>(end.cut) / weight));
        const Real dropped = trace_orb(
            orbs_[orb], ray, entry, end, path.scratch[static_cast<std::size_t>(depth)],
            [&](Vector<Real> from_centre, Vector<Real> direction, Real share) {
                const RayOf<Real> out{orbs_[orb].centre + from_centre, direction};
                sum += static_cast<double>(share) *
                       radiance(out, weight * static_cast<double>(share), orb, depth + 1, path);
            },
            [&path] { return static_cast<Real>(path.sampler->next()); });
        path.dropped += weight * static_cast<double>(dropped);
        return sum;
    }

private:
    std::size_t nearest_orb(const RayOf<Real> &ray, std::size_t left, Entry<Real> &nearest) const {
        std::size_t found = none;
        for (std::size_t i = 0; i < orbs_.size(); ++i) {
            Entry<Real> entry;
            if (i != left && intersect(orbs_[i], ray, entry) && (found == none || entry.distance < nearest.distance)) {
                nearest = entry;
                found = i;
            }
        }
        return found;
    }

    Rgb leaving(const SurfaceHit &hit, const std::vector<Light> &lights) const {
        const auto reflectance = surfaces_.reflectance(hit);
        if (!reflectance) return surfaces_.emitted(hit);
        Rgb irradiance(0);
        for (const Light &light : lights) {
            const double cosine = glm::dot(light.towards, hit.normal);
            if (cosine > 0) irradiance += light.irradiance * (cosine * passed(hit, light.towards));
        }
        return *reflectance * irradiance / std::numbers::pi;
    }

    /// The share of a light that reaches a surface: opaque surfaces block, glass follows the scene's rule.
    double passed(const SurfaceHit &hit, Vec3 towards) const {
        const Ray shadow{hit.position, towards};
        if (surfaces_.blocks(shadow, hit)) return 0;
        if (scene_.glass_shadow.rule == GlassShadow::Rule::none) return 1;
        const double through =
            scene_.glass_shadow.rule == GlassShadow::Rule::constant ? scene_.glass_shadow.transmittance : 0;
        double share = 1;
        Entry<Real> entry;
        for (const Orb<Real> &orb : orbs_)
            if (intersect(orb, RayOf<Real>{Vector<Real>(shadow.origin_mm), Vector<Real>(towards)}, entry))
                share *= through;
        return share;
    }

    const Scene &scene_;
    TreeEnd<Real> end_;
    std::vector<Orb<Real>> orbs_;
    Surfaces surfaces_;
    Lights lights_;
};

double process_cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

template <class Real>
void render(const RenderJob &job, const TreeEnd<Real> &end, const std::function<void(double)> &on_progress,
            TracerOutcome &outcome) {
    const Camera &camera = job.scene.camera;
    const int width = camera.image_width_px(), height = camera.image_height_px();
    const int samples = job.sampling == Sampling::box ? job.samples_per_pixel : 1;
    const World<Real> world(job.scene, job.slip, end, samples);
    const double pixels = static_cast<double>(width) * height * static_cast<double>(job.replicates.size());

    std::atomic<double> done = 0;
    std::mutex progress_mutex;
    tbb::enumerable_thread_specific<typename World<Real>::Path> paths;
    double missing_sum = 0;
    for (const Replicate &replicate : job.replicates) {
        Image image(width, height);
        std::vector<double> missing(image.pixels.size());
        const auto render_pixel = [&](int column, int row, typename World<Real>::Path &path) {
            PixelSampler sampler(replicate.seed, column, row);
            path.sampler = &sampler;
            path.dropped = 0;
            const auto turn = static_cast<std::size_t>(sampler.next() * 65536);
            Rgb sum(0);
            for (int k = 0; k < samples; ++k) {
                path.lights = &world.lights().share(static_cast<std::size_t>(k), turn);
                const Vec2 at =
                    job.sampling == Sampling::pixel_centres
                        ? pixel_sample(camera, column, row)
                        : Vec2(column, row) + sampler.position(static_cast<std::uint32_t>(k)) + camera.film_offset_px;
                const Ray ray = camera_ray(camera, at + replicate.film_offset_px);
                sum += world.radiance({Vector<Real>(ray.origin_mm), Vector<Real>(ray.direction)}, 1, none, 0, path);
            }
            image.at(column, row) = sum / static_cast<double>(samples);
            missing[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(column)] = path.dropped / samples;
        };
        tbb::parallel_for(tbb::blocked_range2d<int>(0, height, tile_px, 0, width, tile_px), [&](const auto &tile) {
            if (interrupt_requested) throw Error(Exit::interrupted, "interrupted");
            typename World<Real>::Path &path = paths.local();
            for (int row = tile.rows().begin(); row != tile.rows().end(); ++row)
                for (int column = tile.cols().begin(); column != tile.cols().end(); ++column)
                    render_pixel(column, row, path);
            const double now = done += static_cast<double>(tile.rows().size() * tile.cols().size());
            if (on_progress) {
                const std::lock_guard lock(progress_mutex);
                on_progress(now / pixels);
            }
        });
        for (const double m : missing) {
            missing_sum += m;
            outcome.missing_weight_greatest = std::max(outcome.missing_weight_greatest, m);
        }
        outcome.images.push_back(std::move(image));
    }
    outcome.missing_weight_mean = missing_sum / pixels;
}

} // namespace

TracerOutcome trace(const RenderJob &job, const TracerSettings &settings,
                    const std::function<void(double)> &on_progress) {
    const Needs n = needs(job.scene);
    if (n.caustics) throw Error(Exit::bad_data, "the tracer does not follow caustics onto diffuse surfaces");
    if (n.environment_on_diffuse)
        throw Error(Exit::bad_data,
                    "the tracer lights diffuse surfaces by parallel lights only: give the environment a dome of them");
    const auto start = std::chrono::steady_clock::now();
    const double cpu_start = process_cpu_seconds();
    TracerOutcome outcome;
    const bool roulette = settings.transport == Transport::roulette;
    tbb::task_arena arena(job.threads > 0 ? job.threads : tbb::task_arena::automatic);
    arena.execute([&] {
        const auto run = [&]<class Real>(Real) {
            render<Real>(job,
                         {static_cast<Real>(roulette ? 0 : job.cut_weight),
                          static_cast<Real>(roulette ? settings.roulette_weight : 0)},
                         on_progress, outcome);
        };
        switch (settings.precision) {
        case Precision::single_precision:
            run(float{});
            break;
        case Precision::double_precision:
            run(double{});
            break;
        }
    });
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    outcome.cpu_seconds = process_cpu_seconds() - cpu_start;
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
