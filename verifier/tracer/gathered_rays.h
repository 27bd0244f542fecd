// SPDX-License-Identifier: MIT
// Rays into an orb, gathered from several pixels and sorted by how far from the centre they pass. Eight that pass
// alike have trees alike: a packet takes as long as the longest of its trees, and near the rim they differ much within
// one pixel of a small picture.
#pragma once

#include <algorithm>
#include <vector>

#include "verifier/tracer/packet.h"

namespace threefold::tracer {

class GatheredRays {
public:
    struct Packet {
        RayPacket rays;
        EntryPacket entry; ///< hits: the lanes that hold a ray
        std::uint32_t pixel[lanes];
        double share[lanes]; ///< of the ray in its pixel
    };

    /// Do the trees of these rays differ so much that it is worth gathering them?
    static bool pays(const Orb<double> &orb, const EntryPacket &entry, std::uint32_t active, std::uint32_t inside) {
        if (inside != active) return true;
        double least = orb.outer, most = 0;
        for (int l = 0; l < lanes; ++l) {
            if (!(inside >> l & 1u)) continue;
            least = std::min(least, entry.impact[l]);
            most = std::max(most, entry.impact[l]);
        }
        // By a tenth of the way to where trees grow without bound: the rim, and the line at which the hollow is met.
        const double hollow = orb.inner * orb.index;
        const double away = std::min(orb.outer - most, hollow < orb.outer ? std::abs(hollow - most) : orb.outer);
        return most - least > 0.1 * away || same_way(orb, entry, inside) != inside;
    }

    void add(const RayPacket &rays, const EntryPacket &entry, std::uint32_t inside, std::uint32_t pixel, double share) {
        for (int l = 0; l < lanes; ++l)
            if (inside >> l & 1u)
                rays_.push_back({rays.origin.at(l), rays.direction.at(l), entry.foot.at(l), entry.distance[l],
                                 entry.impact[l], entry.depth[l], share, pixel});
    }

    std::size_t size() const { return rays_.size(); }

    /// Hands all rays on in packets, and forgets them.
    template <class Take>
    void take(Take &&take) {
        sort();
        Packet packet;
        for (std::size_t first = 0; first < order_.size(); first += lanes) {
            const std::size_t n = std::min<std::size_t>(lanes, order_.size() - first);
            for (std::size_t k = 0; k < lanes; ++k) {
                const int l = static_cast<int>(k);
                const Ray &ray = rays_[order_[first + std::min(k, n - 1)]];
                packet.rays.origin.put(l, ray.origin);
                packet.rays.direction.put(l, ray.direction);
                packet.entry.foot.put(l, ray.foot);
                packet.entry.distance[l] = ray.distance;
                packet.entry.impact[l] = ray.impact;
                packet.entry.depth[l] = ray.depth;
                packet.pixel[l] = ray.pixel;
                packet.share[l] = ray.share;
            }
            packet.entry.hits = all_lanes >> (lanes - n);
            take(packet);
        }
        rays_.clear();
        order_.clear();
    }

private:
    struct Ray {
        Vec3 origin, direction, foot;
        double distance, impact, depth, share;
        std::uint32_t pixel;
    };

    /// Roughly, by 512 classes.
    void sort() {
        constexpr std::size_t classes = 512;
        const auto [least, most] = std::ranges::minmax_element(rays_, {}, &Ray::impact);
        const double from = least->impact, scale = classes / std::max(most->impact - from, 1e-300);
        const auto class_of = [&](const Ray &ray) {
            return std::min(classes - 1, static_cast<std::size_t>(std::min((ray.impact - from) * scale, 1e6)));
        };
        starts_.assign(classes + 1, 0);
        for (const Ray &ray : rays_) ++starts_[class_of(ray) + 1];
        for (std::size_t i = 0; i < classes; ++i) starts_[i + 1] += starts_[i];
        order_.resize(rays_.size());
        for (std::size_t i = 0; i < rays_.size(); ++i)
            order_[starts_[class_of(rays_[i])]++] = static_cast<std::uint32_t>(i);
    }

    std::vector<Ray> rays_;
    std::vector<std::uint32_t> starts_, order_;
};

} // namespace threefold::tracer
