// SPDX-License-Identifier: MIT
#include "verifier/claims/orb_light.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "scenes/texture.h"
#include "verifier/measure/optical_map.h"

namespace threefold {

namespace {

double radiance_of(const Quad &quad, Vec3 point_mm) {
    const Vec2 uv = coordinates_on(quad, point_mm);
    return std::visit(overloaded{
                          [](const Diffuse &) { return 0.0; },
                          [uv](const Emissive &e) { return grey(sample(e.radiance, uv)); },
                          [uv](const CoordinateCard &) { return (uv.x + uv.y + 1) / 3; },
                      },
                      quad.surface);
}

} // namespace

Ray turned_about_orb(const OrbInScene &orb, const Ray &ray, double turn_rad) {
    const Vec3 from_centre = ray.origin_mm - orb.centre_mm;
    const Vec3 foot = from_centre - glm::dot(from_centre, ray.direction) * ray.direction;
    const double b = glm::length(foot);
    const Vec3 outwards = b > 0 ? foot / b : Vec3(0);
    const double cosine = std::cos(turn_rad), sine = std::sin(turn_rad);
    const Vec3 direction = cosine * ray.direction - sine * outwards;
    const Vec3 new_foot = b * (cosine * outwards + sine * ray.direction);
    const auto impact = optics::impact_at(orb.optics, b);
    return {orb.centre_mm + new_foot + optics::outer_chords(orb.optics, impact).air_mm * direction, direction};
}

std::vector<ExitRay> exit_rays(const OrbInScene &orb, const Ray &ray, double remaining_weight,
                               const LightModel &model) {
    const double b = impact_parameter(ray, orb.centre_mm);
    if (b >= orb.optics.outer_mm) return {{ray, 1, 0, 0}};
    const auto impact = optics::impact_at(orb.optics, b);
    const auto sum = optics::transmitted_orders(orb.optics, impact, remaining_weight, model.polarisation,
                                                orb.glass.interface_transmittance, 100'000);
    const double leg_loss = model.absorption_per_mm * optics::glass_leg_mm(orb.optics, impact);
    std::vector<ExitRay> exits;
    exits.reserve(sum.orders.size());
    for (const optics::Order &o : sum.orders)
        exits.push_back({turned_about_orb(orb, ray, o.deflection_rad), o.weight * std::exp(-leg_loss * o.glass_legs),
                         o.glass_legs, o.hollow_chords});
    return exits;
}

double radiance_outside(const Scene &scene, const Ray &ray) {
    double nearest = std::numeric_limits<double>::infinity();
    double radiance = scene.environment ? grey(scene.environment->radiance) : 0;
    for (const Object &object : scene.objects) {
        const Quad *quad = std::get_if<Quad>(&object.shape);
        if (!quad) continue;
        const auto met = optics::landing_on_plane(ray, quad->centre_mm, glm::cross(quad->half_u_mm, quad->half_v_mm));
        if (!met || !on_card(*quad, *met)) continue;
        const double distance = glm::length(*met - ray.origin_mm);
        if (distance >= nearest) continue;
        nearest = distance;
        radiance = radiance_of(*quad, *met);
    }
    return radiance;
}

double predicted_radiance(const Scene &scene, const OrbInScene &orb, const Ray &ray, const LightModel &model) {
    double sum = 0;
    for (const ExitRay &exit : exit_rays(orb, ray, 1e-7, model)) sum += exit.weight * radiance_outside(scene, exit.ray);
    return sum;
}

} // namespace threefold
