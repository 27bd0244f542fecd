// SPDX-License-Identifier: MIT
// Shadow rays of many hits, cast eight at once. They are gathered first and sorted by light, so that the rays of a
// packet run side by side from places near each other.
#pragma once

#include <bit>
#include <vector>

#include "verifier/tracer/lights.h"
#include "verifier/tracer/packet.h"
#include "verifier/tracer/surfaces.h"

namespace threefold::tracer {

/// Rays as they were cast, for those who measure.
struct CastRays {
    RayPacket rays;
    std::uint32_t active;
    bool shadow;
};

class ShadowRays {
public:
    /// A hit on a diffuse surface of a sample of `pixel`, that looks at `lights`. `factor`: what one unit of irradiance
    /// adds to the pixel.
    void add(const SurfaceHit &hit, Rgb factor, const std::vector<Light> &lights, std::uint32_t pixel) {
        if (factor == Rgb(0)) return;
        const std::size_t before = rays_.size();
        const auto number = static_cast<std::uint32_t>(hits_.size());
        for (const Light &light : lights) {
            const double cosine = glm::dot(light.towards, hit.normal);
            if (cosine > 0) rays_.push_back({light.number, number, cosine});
        }
        if (rays_.size() > before) hits_.push_back({hit.position, factor, hit.left(), pixel});
    }

    std::size_t size() const { return rays_.size(); }

    /// Adds the light that gets through to the pixels, and forgets all rays. The order of what a pixel is given depends
    /// on what was added since the last time alone.
    void cast(const Surfaces &surfaces, const std::vector<Orb<double>> &orbs, const GlassShadow &glass,
              const std::vector<Light> &lights, std::vector<Rgb> &pixels, std::vector<CastRays> *log) {
        sort_by_light(lights.size());
        for (std::size_t first = 0; first < sorted_.size(); first += lanes)
            cast_packet(surfaces, orbs, glass, lights, first, pixels, log);
        rays_.clear();
        hits_.clear();
        sorted_.clear();
    }

private:
    struct Hit {
        Vec3 position;
        Rgb factor;
        Left left;
        std::uint32_t pixel;
    };
    struct ShadowRay {
        std::uint32_t light, hit;
        double cosine;
    };

    void sort_by_light(std::size_t lights) {
        starts_.assign(lights + 1, 0);
        for (const ShadowRay &ray : rays_) ++starts_[ray.light + 1];
        for (std::size_t i = 0; i < lights; ++i) starts_[i + 1] += starts_[i];
        sorted_.resize(rays_.size());
        for (const ShadowRay &ray : rays_) sorted_[starts_[ray.light]++] = ray;
    }

    void cast_packet(const Surfaces &surfaces, const std::vector<Orb<double>> &orbs, const GlassShadow &glass,
                     const std::vector<Light> &lights, std::size_t first, std::vector<Rgb> &pixels,
                     std::vector<CastRays> *log) const {
        const std::size_t n = std::min<std::size_t>(lanes, sorted_.size() - first);
        RayPacket rays;
        Left left[lanes];
        for (std::size_t l = 0; l < lanes; ++l) {
            const ShadowRay &ray = sorted_[first + std::min(l, n - 1)];
            const Hit &hit = hits_[ray.hit];
            rays.origin.put(static_cast<int>(l), hit.position);
            rays.direction.put(static_cast<int>(l), lights[ray.light].towards);
            left[l] = hit.left;
        }
        std::uint32_t open = all_lanes >> (lanes - n);
        Lanes share;
        for (double &s : share.v) s = 1;
        if (glass.rule != GlassShadow::Rule::none) {
            const double through = glass.rule == GlassShadow::Rule::constant ? glass.transmittance : 0;
            EntryPacket entry;
            for (const Orb<double> &orb : orbs) {
                intersect(orb, rays, entry);
                for (std::uint32_t bits = entry.hits; bits; bits &= bits - 1) share[std::countr_zero(bits)] *= through;
                if (through == 0) open &= ~entry.hits;
            }
        }
        if (!open) return;
        if (log) log->push_back({rays, open, true});
        open &= ~surfaces.blocks(rays, open, left);
        for (; open; open &= open - 1) {
            const int l = std::countr_zero(open);
            const ShadowRay &ray = sorted_[first + static_cast<std::size_t>(l)];
            const Hit &hit = hits_[ray.hit];
            pixels[hit.pixel] += hit.factor * lights[ray.light].irradiance * (ray.cosine * share[l]);
        }
    }

    std::vector<Hit> hits_;
    std::vector<ShadowRay> rays_, sorted_;
    std::vector<std::uint32_t> starts_;
};

} // namespace threefold::tracer
