// SPDX-License-Identifier: MIT
// The radiance of a pixel: its samples, eight at once where they enter glass by double precision.
#pragma once

#include <bit>

#include "verifier/tracer/world.h"

namespace threefold::tracer {

template <class Real>
struct PixelScratch {
    typename World<Real>::Path path;
    PacketScratch packet;
};

template <class Real>
class PixelRenderer {
public:
    PixelRenderer(const World<Real> &world, const RenderJob &job, const Replicate &replicate)
        : world_(world), film_(job.scene.camera), camera_(job.scene.camera), replicate_(replicate),
          samples_(job.sampling == Sampling::box ? job.samples_per_pixel : 1), box_(job.sampling == Sampling::box) {}

    /// `missing`: weight of the branches that were dropped, mean over the samples.
    Rgb operator()(int column, int row, PixelScratch<Real> &scratch, double &missing) const {
        auto &path = scratch.path;
        PixelSampler sampler(replicate_.seed, column, row);
        path.sampler = &sampler;
        path.dropped = 0;
        const auto turn = static_cast<std::size_t>(sampler.next() * 65536);
        Rgb sum(0);
        int samples = samples_;
        if constexpr (std::is_same_v<Real, double>) {
            if (box_) {
                // Where no glass is seen samples cost little: there are more of them.
                if (world_.is_plain() && sees_no_glass(column, row)) samples *= more_beside_glass;
                for (int k = 0; k < samples; k += lanes)
                    sum += packet(column, row, k, std::min(lanes, samples - k), turn, scratch);
                missing = path.dropped / samples;
                return sum / static_cast<double>(samples);
            }
        }
        for (int k = 0; k < samples; ++k) {
            path.lights = &world_.lights().share(static_cast<std::size_t>(k), turn);
            const Ray ray = film_.ray(position(sampler, column, row, k));
            sum += world_.radiance({Vector<Real>(ray.origin_mm), Vector<Real>(ray.direction)}, 1, none, 0, path);
        }
        missing = path.dropped / samples;
        return sum / static_cast<double>(samples);
    }

private:
    static constexpr int more_beside_glass = 4;

    Vec2 position(const PixelSampler &sampler, int column, int row, int k) const {
        const Vec2 at =
            box_ ? Vec2(column, row) + sampler.position(static_cast<std::uint32_t>(k)) + camera_.film_offset_px
                 : pixel_sample(camera_, column, row);
        return at + replicate_.film_offset_px;
    }

    /// By the angle between the pixel's middle and the orb: for every sample of the pixel, so that the choice does not
    /// depend on where the samples lie.
    bool sees_no_glass(int column, int row) const {
        const Ray middle = film_.ray(pixel_sample(camera_, column, row) + replicate_.film_offset_px);
        const double reach = film_.pixel() * std::numbers::sqrt2 / 2; // angle or mm
        for (const Orb<Real> &orb : world_.orbs()) {
            const Vec3 to_centre = Vec3(orb.centre) - middle.origin_mm;
            const double across = glm::length(glm::cross(to_centre, middle.direction));
            if (camera_.projection == Projection::orthographic) {
                if (across <= static_cast<double>(orb.outer) + reach) return false;
            } else {
                const double angle = std::atan2(across, glm::dot(to_centre, middle.direction));
                const double sine = std::min(1.0, static_cast<double>(orb.outer) / glm::length(to_centre));
                if (angle <= std::asin(sine) + reach) return false;
            }
        }
        return true;
    }

    /// The sum of the samples first to first + n - 1.
    Rgb packet(int column, int row, int first, int n, std::size_t turn, PixelScratch<double> &scratch) const {
        auto &path = scratch.path;
        RayPacket rays;
        camera_rays(film_, *path.sampler, static_cast<std::uint32_t>(first),
                    Vec2(column, row) + camera_.film_offset_px + replicate_.film_offset_px, rays);
        std::uint32_t waiting = (1u << n) - 1;
        const auto light_of = [&](int l) { return &world_.lights().share(static_cast<std::size_t>(first + l), turn); };
        Rgb sum(0);
        if (world_.is_plain()) {
            RectangleHits hits;
            meet_rectangles(world_.surfaces().rectangles(), rays.origin, rays.direction, hits);
            EntryPacket entry;
            std::uint32_t inside = 0;
            if (!world_.orbs().empty()) {
                intersect(world_.orbs()[0], rays, entry);
                for (std::uint32_t bits = entry.hits & waiting; bits; bits &= bits - 1) {
                    const int l = std::countr_zero(bits);
                    if (entry.distance[l] < hits.distance[l]) inside |= 1u << l;
                }
            }
            for (std::uint32_t bits = waiting & ~inside; bits; bits &= bits - 1)
                sum += arriving(hits, std::countr_zero(bits));
            if (inside) sum += glass(0, rays, entry, inside, light_of, scratch);
            return sum;
        }
        // Several orbs, meshes or diffuse surfaces: each ray finds what it meets; rays into the same orb stay together.
        for (std::size_t i = 0; i < world_.orbs().size() && waiting; ++i) {
            EntryPacket entry;
            intersect(world_.orbs()[i], rays, entry);
            std::uint32_t inside = 0;
            for (std::uint32_t bits = entry.hits & waiting; bits; bits &= bits - 1) {
                const int l = std::countr_zero(bits);
                if (world_.meets_first(i, {rays.origin.at(l), rays.direction.at(l)}, entry.distance[l]))
                    inside |= 1u << l;
            }
            if (inside) sum += glass(i, rays, entry, inside, light_of, scratch);
            waiting &= ~inside;
        }
        for (; waiting; waiting &= waiting - 1) {
            const int l = std::countr_zero(waiting);
            path.lights = light_of(l);
            sum += world_.radiance({rays.origin.at(l), rays.direction.at(l)}, 1, none, 0, path);
        }
        return sum;
    }

    Rgb arriving(const RectangleHits &hits, int l) const {
        const auto which = static_cast<int>(hits.which[l]);
        if (which < 0) return world_.scene().environment ? world_.scene().environment->radiance : Rgb(0);
        return world_.emitters().radiance(world_.surfaces().rectangles()[static_cast<std::size_t>(which)].object,
                                          hits.u[l], hits.v[l]);
    }

    Rgb glass(std::size_t orb, const RayPacket &rays, const EntryPacket &entry, std::uint32_t inside, auto light_of,
              PixelScratch<double> &scratch) const {
        auto &path = scratch.path;
        const TreeEnd<double> &end = world_.end();
        const bool roulette = end.roulette > 0;
        PacketScratch &p = scratch.packet;
        Rgb sum(0);
        // The tail goes on as a whole or not at all, so it is asked later than a single branch.
        constexpr double tail = 1.0 / 8;
        const double cut = roulette ? end.roulette * tail : end.cut;
        const std::uint64_t key =
            roulette ? static_cast<std::uint64_t>(path.sampler->next() * 0x1p53) | (1ull << 60) : 0;
        if (!trace_packet(world_.orbs()[orb], rays, entry, inside, cut, key, p)) {
            for (; inside; inside &= inside - 1) {
                const int l = std::countr_zero(inside);
                path.lights = light_of(l);
                sum += world_.glass(orb, {rays.origin.at(l), rays.direction.at(l)},
                                    {entry.distance[l], entry.impact[l], entry.depth[l], entry.foot.at(l)}, end, 1, 0,
                                    path);
            }
            return sum;
        }
        const int n = std::popcount(inside);
        for (std::uint32_t bits = inside; bits; bits &= bits - 1) path.dropped += p.dropped[std::countr_zero(bits)];
        for (std::size_t i = 0; i < p.count; ++i) {
            const ExitPacket &out = p.exits[i];
            // Faint light differs little from sample to sample: with roulette one of them stands for all.
            std::uint32_t asked = inside;
            double factor = 1;
            if (roulette && out.greatest < end.roulette && n > 1) {
                int skip = static_cast<int>(path.sampler->next() * n);
                while (skip-- > 0) asked &= asked - 1;
                asked &= ~(asked - 1);
                factor = n;
            }
            if (world_.is_plain()) {
                RectangleHits hits;
                meet_rectangles(world_.surfaces().rectangles(), out.origin, out.direction, hits);
                for (; asked; asked &= asked - 1) {
                    const int l = std::countr_zero(asked);
                    sum += factor * out.weight[l] * arriving(hits, l);
                }
                continue;
            }
            for (; asked; asked &= asked - 1) {
                const int l = std::countr_zero(asked);
                const double weight = factor * out.weight[l];
                if (!(weight > 0)) continue;
                path.lights = light_of(l);
                sum += weight * world_.radiance({out.origin.at(l), out.direction.at(l)}, weight, orb, 1, path);
            }
        }
        return sum;
    }

    const World<Real> &world_;
    Film film_;
    const Camera &camera_;
    const Replicate &replicate_;
    int samples_;
    bool box_;
};

} // namespace threefold::tracer
