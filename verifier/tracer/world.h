// SPDX-License-Identifier: MIT
// The scene, ready to be asked for the radiance along a ray.
#pragma once

#include <deque>
#include <limits>
#include <numbers>

#include "exporter/job.h"
#include "scenes/validate.h"
#include "verifier/tracer/lights.h"
#include "verifier/tracer/orb.h"
#include "verifier/tracer/paints.h"
#include "verifier/tracer/sampler.h"
#include "verifier/tracer/sights.h"
#include "verifier/tracer/surfaces.h"

namespace threefold::tracer {

inline constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
/// Light between orbs dies out long before; a bound keeps the stack safe.
inline constexpr int greatest_depth = 64;

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

template <class Real>
class World {
public:
    World(const Scene &scene, const Slip &slip, const TreeEnd<Real> &end, int samples)
        : scene_(scene), end_(end), orbs_(orbs_of<Real>(scene, slip)), surfaces_(scene, std::is_same_v<Real, double>),
          paints_(scene), lights_(scene, samples) {
        if (!paints_.all_shine() || !surfaces_.only_rectangles() || orbs_.size() > 1) return;
        sights_.push_back({Sight::Kind::constant, environment()});
        for (const Rectangle &rectangle : surfaces_.rectangles()) {
            const auto sight = paints_.sight(rectangle.object);
            if (!sight) {
                sights_.clear();
                return;
            }
            sights_.push_back(*sight);
        }
    }

    /// What one thread and one sample carry along.
    struct Path {
        std::deque<TreeScratch<Real>> scratch;
        PixelSampler *sampler = nullptr;
        const std::vector<Light> *lights = nullptr;
        double dropped = 0;
    };

    const Scene &scene() const { return scene_; }
    const Lights &lights() const { return lights_; }
    const TreeEnd<Real> &end() const { return end_; }
    const std::vector<Orb<Real>> &orbs() const { return orbs_; }
    const Surfaces &surfaces() const { return surfaces_; }
    const Paints &paints() const { return paints_; }
    /// Do all rays that leave glass end on one of a few rectangles that shine, or in the environment? Then sights() is
    /// what they see.
    bool is_plain() const { return !sights_.empty(); }
    const std::vector<Sight> &sights() const { return sights_; }
    Rgb environment() const { return scene_.environment ? scene_.environment->radiance : Rgb(0); }

    /// `left` is the orb that the ray has just left, if any: it cannot meet it again.
    Rgb radiance(const RayOf<Real> &ray, double weight, std::size_t left, int depth, Path &path) const {
        Entry<Real> entry{};
        const std::size_t orb = nearest_orb(ray, left, entry);
        const Ray exact{Vec3(ray.origin), Vec3(ray.direction)};
        const auto hit = surfaces_.intersect(exact);
        if (hit && (orb == none || hit->distance <= static_cast<double>(entry.distance)))
            return leaving(*hit, *path.lights);
        if (orb == none) return environment();
        if (depth >= greatest_depth) {
            path.dropped += weight;
            return Rgb(0);
        }
        TreeEnd<Real> end = end_;
        end.cut = static_cast<Real>(std::min(1.0, static_cast<double>(end.cut) / weight));
        return glass(orb, ray, entry, end, weight, depth, path);
    }

    /// What comes out of an orb.
    Rgb glass(std::size_t orb, const RayOf<Real> &ray, const Entry<Real> &entry, const TreeEnd<Real> &end,
              double weight, int depth, Path &path) const {
        while (path.scratch.size() <= static_cast<std::size_t>(depth)) path.scratch.emplace_back();
        Rgb sum(0);
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
        const Rgb colour = paints_.colour(hit.object, hit.uv.x, hit.uv.y);
        if (paints_.shines(hit.object) || colour == Rgb(0)) return colour;
        Rgb irradiance(0);
        for (const Light &light : lights) {
            const double cosine = glm::dot(light.towards, hit.normal);
            if (cosine > 0) irradiance += light.irradiance * (cosine * passed(hit, light.towards));
        }
        return colour * irradiance / std::numbers::pi;
    }

    /// The share of a light that reaches a surface: opaque surfaces block, glass follows the scene's rule.
    double passed(const SurfaceHit &hit, Vec3 towards) const {
        const Ray shadow{hit.position, towards};
        if (scene_.glass_shadow.rule == GlassShadow::Rule::none) return surfaces_.blocks(shadow, hit) ? 0 : 1;
        const double through =
            scene_.glass_shadow.rule == GlassShadow::Rule::constant ? scene_.glass_shadow.transmittance : 0;
        double share = 1;
        Entry<Real> entry;
        for (const Orb<Real> &orb : orbs_)
            if (intersect(orb, RayOf<Real>{Vector<Real>(shadow.origin_mm), Vector<Real>(towards)}, entry))
                share *= through;
        return share > 0 && surfaces_.blocks(shadow, hit) ? 0 : share;
    }

    const Scene &scene_;
    TreeEnd<Real> end_;
    std::vector<Orb<Real>> orbs_;
    Surfaces surfaces_;
    Paints paints_;
    Lights lights_;
    std::vector<Sight> sights_;
};

} // namespace threefold::tracer
