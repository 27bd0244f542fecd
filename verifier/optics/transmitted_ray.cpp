// SPDX-License-Identifier: MIT
#include "verifier/optics/transmitted_ray.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "verifier/optics/deflection.h"

namespace threefold::optics {

namespace {

/// By `turn_of` an impact; nothing where that is.
template <class TurnOf>
std::optional<Ray> sent_on(const Orb<double> &orb, Vec3 centre_mm, const Ray &ray, TurnOf turn_of) {
    const Vec3 d = glm::normalize(ray.direction);
    const Vec3 from_centre = ray.origin_mm - centre_mm;
    const double along = glm::dot(from_centre, d);
    if (along >= 0 || glm::length(from_centre) <= orb.outer_mm) return std::nullopt;

    const Vec3 foot = from_centre - along * d;
    const double b = glm::length(foot);
    const Impact<double> impact = impact_at(orb, b);
    const std::optional<double> turn = turn_of(impact);
    if (!turn) return std::nullopt;

    // The orb turns the whole line about its centre: foot point and direction rotate together.
    const Vec3 outwards = b > 0 ? foot / b : Vec3(0);
    const double cosine = std::cos(*turn), sine = std::sin(*turn);
    const Vec3 direction = cosine * d - sine * outwards;
    const Vec3 new_foot = b * (cosine * outwards + sine * d);
    return Ray{centre_mm + new_foot + outer_chords(orb, impact).air_mm * direction, direction};
}

} // namespace

std::optional<Ray> transmitted_ray(const Orb<double> &orb, Vec3 centre_mm, const Ray &ray) {
    return sent_on(orb, centre_mm, ray, [&](const Impact<double> &impact) { return deflection(orb, impact); });
}

std::optional<Ray> coated_ray(const Orb<double> &orb, Vec3 centre_mm, const Ray &ray) {
    return sent_on(orb, centre_mm, ray, [&](const Impact<double> &impact) {
        const auto through = deflection(orb, impact);
        return through ? through : rim_deflection(orb, impact);
    });
}

std::optional<Vec3> landing_on_plane(const Ray &ray, Vec3 point_mm, Vec3 normal) {
    const double approach = glm::dot(normal, ray.direction);
    const double distance = glm::dot(normal, point_mm - ray.origin_mm) / approach;
    if (!(distance >= 0) || !std::isfinite(distance)) return std::nullopt;
    return ray.origin_mm + distance * ray.direction;
}

} // namespace threefold::optics
