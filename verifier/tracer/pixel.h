// SPDX-License-Identifier: MIT
// The radiance of a pixel: its samples, eight at once by double precision.
#pragma once

#include <atomic>
#include <bit>
#include <cstdint>

#include "exporter/process/child.h"
#include "scenes/error.h"
#include "verifier/tracer/gathered_rays.h"
#include "verifier/tracer/packet.h"
#include "verifier/tracer/shadow_rays.h"
#include "verifier/tracer/world.h"

namespace threefold::tracer {

/// Where no glass is seen samples cost little: there are more of them, as far as there are numbers for them.
constexpr std::int64_t samples_of_pixel(int samples, bool beside_glass) {
    constexpr std::int64_t more = 4, most = std::int64_t{1} << 32; // positions have numbers of 32 bits
    const std::int64_t all = samples;
    return beside_glass && all * more <= most ? all * more : all;
}

/// Asked within pixels: one of very many samples must not keep a person waiting.
inline void stop_if_interrupted() {
    if (interrupt_requested.load(std::memory_order_relaxed)) throw Error(Exit::interrupted, "interrupted");
}

template <class Real>
struct PixelScratch {
    typename World<Real>::Path path;
    PacketScratch packet;
    ShadowRays shadows;
    GatheredRays gathered;
    SurfaceHit hits[lanes];
    std::vector<CastRays> *log = nullptr; ///< of the rays that ask for surfaces, for those who measure
};

template <class Real>
class PixelRenderer {
public:
    PixelRenderer(const World<Real> &world, const RenderJob &job, const Replicate &replicate,
                  Sampler sampler = Sampler::sobol)
        : world_(world), film_(job.scene.camera), camera_(job.scene.camera), replicate_(replicate), sampler_(sampler),
          samples_(job.sampling == Sampling::box ? job.samples_per_pixel : 1), box_(job.sampling == Sampling::box),
          surroundings_(surroundings_of_orbs()) {}

    /// Adds to pixels[row * width + column], some of it only with `finish`. `missing`, by pixel: weight of the branches
    /// that were dropped, mean over the samples.
    void operator()(int column, int row, PixelScratch<Real> &scratch, std::vector<Rgb> &pixels,
                    std::vector<double> &missing) const {
        auto &path = scratch.path;
        PixelSampler sampler(replicate_.seed, column, row);
        path.sampler = &sampler;
        path.dropped = 0;
        const auto turn = static_cast<std::size_t>(sampler.next() * 65536);
        Rgb sum(0);
        std::int64_t samples = samples_;
        Pixel pixel{column, row,
                    static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(camera_.image_width_px()) +
                        static_cast<std::uint32_t>(column),
                    turn, 1};
        bool packets = false;
        if constexpr (std::is_same_v<Real, double>) {
            packets = box_;
            if (packets) {
                samples = samples_of_pixel(samples_, world_.is_plain() && sees_no_glass(column, row));
                pixel.share = 1.0 / static_cast<double>(samples);
                sampler.use(sampler_, samples);
                for (std::int64_t k = 0; k < samples; k += lanes) {
                    stop_if_interrupted();
                    sum += packet(pixel, static_cast<std::uint32_t>(k),
                                  static_cast<int>(std::min<std::int64_t>(lanes, samples - k)), scratch);
                    if (scratch.shadows.size() > many_shadow_rays || scratch.gathered.size() > many_gathered_rays)
                        finish(scratch, pixels, missing);
                }
            }
        }
        if (!packets) sampler.use(sampler_, samples);
        for (std::int64_t k = 0; !packets && k < samples; ++k) {
            stop_if_interrupted();
            path.lights = &world_.lights().share(static_cast<std::size_t>(k), turn);
            const Ray ray = film_.ray(position(sampler, column, row, static_cast<std::uint32_t>(k)));
            sum += world_.radiance({Vector<Real>(ray.origin_mm), Vector<Real>(ray.direction)}, 1, none, 0, path);
        }
        missing[pixel.number] += path.dropped / static_cast<double>(samples);
        pixels[pixel.number] += sum / static_cast<double>(samples);
    }

    /// Adds the light of what was gathered.
    void finish(PixelScratch<Real> &scratch, std::vector<Rgb> &pixels, std::vector<double> &missing) const {
        if constexpr (std::is_same_v<Real, double>) {
            if (scratch.gathered.size() > 0)
                scratch.gathered.take([&](const GatheredRays::Packet &p) { trace(p, scratch, pixels, missing); });
            if (scratch.shadows.size() > 0)
                scratch.shadows.cast(world_.surfaces(), world_.orbs(), world_.scene().glass_shadow,
                                     world_.lights().all(), pixels, scratch.log);
        }
    }

private:
    // So many still fit a processor's cache.
    static constexpr std::size_t many_shadow_rays = 1 << 14, many_gathered_rays = 1 << 11;

    struct Pixel {
        int column, row;
        std::uint32_t number;
        std::size_t turn; ///< of the shares of light
        double share;     ///< of a sample in the pixel
    };

    Vec2 position(const PixelSampler &sampler, int column, int row, std::uint32_t k) const {
        const Vec2 at = box_ ? Vec2(column, row) + sampler.position(k) + camera_.film_offset_px
                             : pixel_sample(camera_, column, row);
        return at + replicate_.film_offset_px;
    }

    /// A cone about the direction to an orb's centre (perspective), or a cylinder (orthographic), that holds all pixels
    /// the orb is seen in.
    struct Surroundings {
        Vec3 to_centre;
        double sine, cosine; ///< of the cone's angle
        double radius_mm;    ///< of the cylinder
    };

    std::vector<Surroundings> surroundings_of_orbs() const {
        std::vector<Surroundings> all;
        const double reach = film_.pixel() * std::numbers::sqrt2 / 2; // angle or mm
        for (const Orb<Real> &orb : world_.orbs()) {
            const Vec3 to_centre = Vec3(orb.centre) - camera_.eye_mm;
            const auto outer_mm = static_cast<double>(orb.outer);
            const double angle = std::asin(std::min(1.0, outer_mm / glm::length(to_centre))) + reach;
            all.push_back({to_centre, std::sin(angle), std::cos(angle), outer_mm + reach});
        }
        return all;
    }

    /// By where the pixel's middle looks: for every sample of the pixel, so that the choice does not depend on where
    /// the samples lie.
    bool sees_no_glass(int column, int row) const {
        const Ray middle = film_.ray(pixel_sample(camera_, column, row) + replicate_.film_offset_px);
        for (const Surroundings &orb : surroundings_) {
            switch (camera_.projection) {
            case Projection::perspective: {
                const double across = glm::length(glm::cross(orb.to_centre, middle.direction));
                // The sine of the angle by which the cone is wider than the pixel is off its axis.
                if (orb.sine * glm::dot(orb.to_centre, middle.direction) >= orb.cosine * across) return false;
                break;
            }
            case Projection::orthographic: {
                const Vec3 to_centre = orb.to_centre + (camera_.eye_mm - middle.origin_mm);
                if (glm::length(glm::cross(to_centre, middle.direction)) <= orb.radius_mm) return false;
                break;
            }
            }
        }
        return true;
    }

    const std::vector<Light> &lights_of(const Pixel &pixel, std::uint32_t sample) const {
        return world_.lights().share(sample, pixel.turn);
    }

    /// The sum of the samples first to first + n - 1, but for the light of what waits for shadow rays.
    Rgb packet(const Pixel &pixel, std::uint32_t first, int n, PixelScratch<double> &scratch) const {
        RayPacket rays;
        camera_rays(film_, *scratch.path.sampler, first,
                    Vec2(pixel.column, pixel.row) + camera_.film_offset_px + replicate_.film_offset_px, rays);
        const std::uint32_t active = all_lanes >> (lanes - n);
        Rgb sum(0);
        EntryPacket entry;
        if (world_.is_plain()) {
            RectangleHits hits;
            meet_rectangles(world_.surfaces().rectangles(), rays.origin, rays.direction, hits);
            std::uint32_t inside = 0;
            if (!world_.orbs().empty()) {
                intersect(world_.orbs()[0], rays, entry);
                for (std::uint32_t bits = entry.hits & active; bits; bits &= bits - 1) {
                    const int l = std::countr_zero(bits);
                    if (entry.distance[l] < hits.distance[l]) inside |= 1u << l;
                }
            }
            Lanes weight;
            for (double &w : weight.v) w = 1;
            if (active != inside) {
                Glance on_the_way;
                Seen seen;
                glance(world_.sights(), hits, weight, 1, active & ~inside, on_the_way, seen);
                read(on_the_way, seen);
                sum += seen.sum();
            }
            if (inside && !(world_.end().roulette > 0) && GatheredRays::pays(world_.orbs()[0], entry, active, inside)) {
                scratch.gathered.add(rays, entry, inside, pixel.number, pixel.share);
                inside = 0;
            }
            if (inside) sum += glass(0, rays, entry, inside, pixel, first, scratch);
            return sum;
        }
        // The nearest orb of each ray, unless a surface is nearer.
        const auto &orbs = world_.orbs();
        Lanes nearest;
        for (double &distance : nearest.v) distance = std::numeric_limits<double>::infinity();
        std::size_t orb_of[lanes] = {none, none, none, none, none, none, none, none};
        for (std::size_t i = 0; i < orbs.size(); ++i) {
            intersect(orbs[i], rays, entry);
            for (std::uint32_t bits = entry.hits & active; bits; bits &= bits - 1) {
                const int l = std::countr_zero(bits);
                if (!(entry.distance[l] < nearest[l])) continue;
                nearest[l] = entry.distance[l];
                orb_of[l] = i;
            }
        }
        const auto &hits = scratch.hits;
        const std::uint32_t met = meet_surfaces(rays, active, nearest, scratch);
        std::uint32_t left = active & ~met;
        for (std::uint32_t bits = met; bits; bits &= bits - 1) {
            const int l = std::countr_zero(bits);
            sum += arriving(hits[l], 1, pixel, first + static_cast<std::uint32_t>(l), scratch);
        }
        for (std::size_t i = 0; i < orbs.size() && left; ++i) {
            std::uint32_t inside = 0;
            for (int l = 0; l < lanes; ++l) inside |= static_cast<std::uint32_t>(orb_of[l] == i) << l;
            inside &= left;
            left &= ~inside;
            if (!inside) continue;
            if (orbs.size() > 1) intersect(orbs[i], rays, entry);
            sum += glass(i, rays, entry, inside, pixel, first, scratch);
        }
        return sum + static_cast<double>(std::popcount(left)) * world_.environment();
    }

    /// Where the rays of `active` meet surfaces is in scratch.hits.
    std::uint32_t meet_surfaces(const RayPacket &rays, std::uint32_t active, const Lanes &limit,
                                PixelScratch<double> &scratch) const {
        if (scratch.log) scratch.log->push_back({rays, active, false});
        return world_.surfaces().intersect(rays, active, limit, scratch.hits);
    }

    /// What shines is given back; what reflects waits for its shadow rays.
    Rgb arriving(const SurfaceHit &hit, double weight, const Pixel &pixel, std::uint32_t sample,
                 PixelScratch<double> &scratch) const {
        const Rgb colour = world_.paints().colour(hit.object, hit.uv.x, hit.uv.y);
        if (world_.paints().shines(hit.object)) return weight * colour;
        scratch.shadows.add(hit, colour * (weight * pixel.share / std::numbers::pi), lights_of(pixel, sample),
                            pixel.number);
        return Rgb(0);
    }

    Rgb glass(std::size_t orb, const RayPacket &rays, const EntryPacket &entry, std::uint32_t inside,
              const Pixel &pixel, std::uint32_t first, PixelScratch<double> &scratch) const {
        auto &path = scratch.path;
        const TreeEnd<double> &end = world_.end();
        const bool roulette = end.roulette > 0;
        PacketScratch &p = scratch.packet;
        Rgb sum(0);
        // The tail goes on as a whole or not at all, so it is asked later than a single branch.
        constexpr double tail = 1.0 / 8;
        const double cut = roulette ? end.roulette * tail : end.cut;
        while (inside) {
            const std::uint32_t group = same_way(world_.orbs()[orb], entry, inside);
            inside &= ~group;
            const std::uint64_t key =
                roulette ? static_cast<std::uint64_t>(path.sampler->next() * 0x1p53) | (1ull << 60) : 0;
            if (trace_packet(world_.orbs()[orb], rays, entry, group, cut, key, p)) {
                for (std::uint32_t bits = group; bits; bits &= bits - 1)
                    path.dropped += p.dropped[std::countr_zero(bits)];
                if (world_.is_plain()) {
                    Seen seen;
                    leaving_for_rectangles(group, scratch, seen);
                    sum += seen.sum();
                } else {
                    sum += leaving(orb, group, pixel, first, scratch);
                }
                continue;
            }
            for (std::uint32_t bits = group; bits; bits &= bits - 1) {
                const int l = std::countr_zero(bits);
                path.lights = &lights_of(pixel, first + static_cast<std::uint32_t>(l));
                sum += world_.glass(orb, {rays.origin.at(l), rays.direction.at(l)},
                                    {entry.distance[l], entry.impact[l], entry.depth[l], entry.foot.at(l)}, end, 1, 0,
                                    path);
            }
        }
        return sum;
    }

    /// Faint light differs little from sample to sample: with roulette one of them stands for all, `factor` times.
    std::uint32_t asked_of(const ExitPacket &out, std::uint32_t group, double &factor,
                           PixelScratch<double> &scratch) const {
        factor = 1;
        const int n = std::popcount(group);
        if (!(world_.end().roulette > 0 && out.greatest < world_.end().roulette && n > 1)) return group;
        int skip = static_cast<int>(scratch.path.sampler->next() * n);
        while (skip-- > 0) group &= group - 1;
        factor = n;
        return group & (~group + 1);
    }

    /// The light of all ways out of an orb, in a plain world: found one way ahead of what is seen there.
    void leaving_for_rectangles(std::uint32_t group, PixelScratch<double> &scratch, Seen &seen) const {
        const PacketScratch &p = scratch.packet;
        Glance glances[2];
        for (std::size_t i = 0; i < p.count; ++i) {
            const ExitPacket &out = p.exits[i];
            double factor = 1;
            const std::uint32_t asked = asked_of(out, group, factor, scratch);
            RectangleHits hits;
            meet_rectangles(world_.surfaces().rectangles(), out.origin, out.direction, hits);
            glance(world_.sights(), hits, out.weight, factor, asked, glances[i % 2], seen);
            if (i > 0) read(glances[(i - 1) % 2], seen);
        }
        if (p.count > 0) read(glances[(p.count - 1) % 2], seen);
    }

    /// Rays of several pixels into the only orb of a plain world, by the full tree.
    void trace(const GatheredRays::Packet &gathered, PixelScratch<double> &scratch, std::vector<Rgb> &pixels,
               std::vector<double> &missing) const {
        const Orb<double> &orb = world_.orbs()[0];
        auto &path = scratch.path;
        const double dropped_by_others = path.dropped;
        for (std::uint32_t waiting = gathered.entry.hits; waiting;) {
            const std::uint32_t group = same_way(orb, gathered.entry, waiting);
            waiting &= ~group;
            const bool together =
                trace_packet(orb, gathered.rays, gathered.entry, group, world_.end().cut, 0, scratch.packet);
            Seen seen;
            if (together) leaving_for_rectangles(group, scratch, seen);
            for (std::uint32_t bits = group; bits; bits &= bits - 1) {
                const int l = std::countr_zero(bits);
                const EntryPacket &e = gathered.entry;
                path.dropped = together ? scratch.packet.dropped[l] : 0;
                path.lights = &world_.lights().share(0, 0);
                const Rgb light = together
                                      ? seen.at(l)
                                      : world_.glass(0, {gathered.rays.origin.at(l), gathered.rays.direction.at(l)},
                                                     {e.distance[l], e.impact[l], e.depth[l], e.foot.at(l)},
                                                     world_.end(), 1, 0, path);
                pixels[gathered.pixel[l]] += gathered.share[l] * light;
                missing[gathered.pixel[l]] += gathered.share[l] * path.dropped;
            }
        }
        path.dropped = dropped_by_others;
    }

    /// The light of all ways out of an orb.
    Rgb leaving(std::size_t orb, std::uint32_t group, const Pixel &pixel, std::uint32_t first,
                PixelScratch<double> &scratch) const {
        auto &path = scratch.path;
        Rgb sum(0);
        for (std::size_t i = 0; i < scratch.packet.count; ++i) {
            const ExitPacket &out = scratch.packet.exits[i];
            double factor = 1;
            std::uint32_t asked = asked_of(out, group, factor, scratch);
            for (std::uint32_t bits = asked; bits; bits &= bits - 1)
                if (const int l = std::countr_zero(bits); !(out.weight[l] > 0)) asked &= ~(1u << l);
            const RayPacket rays{out.origin, out.direction};
            // Light that meets one more orb has a tree of its own.
            for (std::size_t k = 0; k < world_.orbs().size(); ++k) {
                if (k == orb) continue;
                EntryPacket entry;
                intersect(world_.orbs()[k], rays, entry);
                for (std::uint32_t bits = entry.hits & asked; bits; bits &= bits - 1) {
                    const int l = std::countr_zero(bits);
                    const double weight = factor * out.weight[l];
                    path.lights = &lights_of(pixel, first + static_cast<std::uint32_t>(l));
                    sum += weight * world_.radiance({rays.origin.at(l), rays.direction.at(l)}, weight, orb, 1, path);
                }
                asked &= ~entry.hits;
            }
            if (!asked) continue;
            Lanes all_the_way;
            for (double &limit : all_the_way.v) limit = std::numeric_limits<double>::infinity();
            const std::uint32_t met = meet_surfaces(rays, asked, all_the_way, scratch);
            for (; asked; asked &= asked - 1) {
                const int l = std::countr_zero(asked);
                const double weight = factor * out.weight[l];
                sum += met >> l & 1u
                           ? arriving(scratch.hits[l], weight, pixel, first + static_cast<std::uint32_t>(l), scratch)
                           : weight * world_.environment();
            }
        }
        return sum;
    }

    const World<Real> &world_;
    Film film_;
    const Camera &camera_;
    const Replicate &replicate_;
    Sampler sampler_;
    int samples_;
    bool box_;
    std::vector<Surroundings> surroundings_;
};

/// A square of the picture's pixels: tiles are the same for any number of threads, and so is what shadow rays are cast
/// together.
inline constexpr int tile_px = 8;

template <class Real>
void render_tile(const PixelRenderer<Real> &pixel, const Camera &camera, int tile, PixelScratch<Real> &scratch,
                 std::vector<Rgb> &pixels, std::vector<double> &missing) {
    const int width = camera.image_width_px(), height = camera.image_height_px(),
              across = (width + tile_px - 1) / tile_px;
    const int left = tile % across * tile_px, top = tile / across * tile_px;
    for (int row = top; row < std::min(top + tile_px, height); ++row)
        for (int column = left; column < std::min(left + tile_px, width); ++column)
            pixel(column, row, scratch, pixels, missing);
    pixel.finish(scratch, pixels, missing);
}

inline int tiles_of(const Camera &camera) {
    return ((camera.image_width_px() + tile_px - 1) / tile_px) * ((camera.image_height_px() + tile_px - 1) / tile_px);
}

} // namespace threefold::tracer
