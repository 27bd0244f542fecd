// SPDX-License-Identifier: MIT
#include "verifier/optics/uniaxial.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace threefold::optics {

std::optional<Ray> extraordinary_ray(double radius_mm, const Uniaxial &crystal, Vec3 centre_mm, const Ray &ray) {
    const Vec3 d = glm::normalize(ray.direction), c = glm::normalize(crystal.axis);
    const Vec3 from_centre = ray.origin_mm - centre_mm;
    const double along = glm::dot(from_centre, d);
    const Vec3 foot = from_centre - along * d;
    const double b = glm::length(foot);
    if (along >= 0 || glm::length(from_centre) <= radius_mm || b >= radius_mm) return std::nullopt;

    const double across = 1 / (crystal.extraordinary * crystal.extraordinary),
                 lengthways = 1 / (crystal.ordinary * crystal.ordinary);
    /// The matrix of the wave surface, k.M k = 1; the ray runs along M k.
    const auto times = [&](Vec3 k) { return across * k + (lengthways - across) * glm::dot(c, k) * c; };

    const Vec3 entry = foot - std::sqrt((radius_mm - b) * (radius_mm + b)) * d, in = entry / radius_mm;
    const Vec3 tangential = d - glm::dot(d, in) * in;
    // k = tangential - q in: of the two roots the one whose energy goes inwards.
    const double square = glm::dot(in, times(in)), mixed = glm::dot(in, times(tangential));
    const double under = mixed * mixed - square * (glm::dot(tangential, times(tangential)) - 1);
    if (under < 0) return std::nullopt;
    const Vec3 k = tangential - (mixed + std::sqrt(under)) / square * in;
    const Vec3 inside = glm::normalize(times(k));

    const Vec3 exit = entry - 2 * glm::dot(entry, inside) * inside, out = exit / radius_mm;
    const Vec3 leaving = k - glm::dot(k, out) * out;
    const double rest = 1 - glm::dot(leaving, leaving);
    if (!(rest > 0)) return std::nullopt;
    return Ray{centre_mm + exit, leaving + std::sqrt(rest) * out};
}

double greatest_walk_off_rad(const Uniaxial &crystal) {
    const double o = crystal.ordinary, e = crystal.extraordinary;
    return std::atan(std::abs(o * o - e * e) / (2 * o * e));
}

} // namespace threefold::optics
