// SPDX-License-Identifier: MIT
#include "exporter/trapped_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/geometric.hpp>

#include "scenes/camera.h"

namespace threefold {
namespace {

struct Orb {
    Vec3 centre_mm;
    double outer_mm, inner_mm; ///< inner 0: solid
    Glass glass;
};

std::optional<Orb> orb_of(const Shape &shape) {
    using Result = std::optional<Orb>;
    return std::visit(overloaded{[](const GlassBall &b) { return Result({b.centre_mm, b.radius_mm, 0, b.glass}); },
                                 [](const GlassShell &s) {
                                     return Result({s.centre_mm, s.outer_radius_mm, s.inner_radius_mm(), s.glass});
                                 },
                                 [](const Quad &) { return Result(); }, [](const Mesh &) { return Result(); }},
                      shape);
}

/// Reflected share at a sphere, from the sines on both sides; all beyond the critical angle.
double reflected(double index, double sine_air, double sine_glass) {
    if (sine_air >= 1) return 1;
    const double air = std::sqrt((1 - sine_air) * (1 + sine_air));
    const double glass = std::sqrt((1 - sine_glass) * (1 + sine_glass));
    const double s = (air - index * glass) / (air + index * glass), p = (index * air - glass) / (index * air + glass);
    return (s * s + p * p) / 2;
}

double left_inside(const Orb &orb, double impact_mm, int most_interfaces) {
    const double n = orb.glass.index, tau = orb.glass.interface_transmittance;
    const double outer = reflected(n, impact_mm / orb.outer_mm, impact_mm / orb.outer_mm / n);
    double inward = (1 - outer) * tau, outward = 0, hollow = 0; // what has left each surface, and where to
    const double inner_sine = orb.inner_mm > 0 ? impact_mm / n / orb.inner_mm : 2;
    if (inner_sine >= 1) return inward * std::pow(outer, std::max(most_interfaces - 2, 0));
    const double inner = reflected(n, inner_sine * n, inner_sine);
    for (int met = 1; met < most_interfaces - 1; ++met) { // what leaves at the last one is lost too
        const double next_outward = inward * inner + hollow * (1 - inner) * tau;
        const double next_hollow = inward * (1 - inner) * tau + hollow * inner;
        inward = outward * outer;
        outward = next_outward;
        hollow = next_hollow;
    }
    return inward + outward + hollow;
}

} // namespace

double trapped_light(const Scene &scene, int most_interfaces) {
    constexpr int most_a_side = 48;
    const Camera &camera = scene.camera;
    const int columns = std::min(camera.image_width_px(), most_a_side),
              rows = std::min(camera.image_height_px(), most_a_side);
    const Film film(camera);
    double sum = 0;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const Ray ray = film.ray(Vec2((column + 0.5) * camera.image_width_px() / columns,
                                          (row + 0.5) * camera.image_height_px() / rows));
            double nearest = std::numeric_limits<double>::infinity(), left = 0;
            for (const Object &object : scene.objects) {
                const auto orb = orb_of(object.shape);
                if (!orb || orb->glass.coating == Coating::antireflective) continue;
                const Vec3 to_centre = orb->centre_mm - ray.origin_mm;
                const double along = glm::dot(to_centre, ray.direction);
                const double impact_mm = glm::length(along * ray.direction - to_centre);
                if (along <= 0 || along >= nearest || impact_mm >= orb->outer_mm) continue;
                nearest = along;
                left = left_inside(*orb, impact_mm, most_interfaces);
            }
            sum += left;
        }
    return sum / (columns * rows);
}

} // namespace threefold
