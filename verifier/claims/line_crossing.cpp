// SPDX-License-Identifier: MIT
#include "verifier/claims/line_crossing.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

#include "scenes/catalogue/three_lines.h"
#include "verifier/claims/flip.h"
#include "verifier/measure/dark_line.h"

namespace threefold {

namespace {

constexpr double line_search_rad =
    1.4;                         ///< to either side: on a circle a straight line is met once within a right angle
constexpr int line_strips = 192; ///< of a soft line's width, for its centre of darkness

std::optional<Vec3> landing_of(const LinesView &view, const Ray &ray) {
    if (impact_parameter(ray, view.orb.centre_mm) >= view.orb.optics.outer_mm)
        return optics::landing_on_plane(ray, view.scale.origin_mm, view.scale.normal);
    const auto out = optics::transmitted_ray(view.orb.optics, view.orb.centre_mm, ray);
    if (!out) return std::nullopt;
    return optics::landing_on_plane(*out, view.scale.origin_mm, view.scale.normal);
}

bool is_beyond_bend(const LinesView &view, const SoftLine &line, Vec3 point_mm) {
    if (!line.bend_mm) return false;
    const Vec3 onwards(1, 0, 0), from_bend = point_mm - view.scale.origin_mm - *line.bend_mm * view.along;
    return glm::dot(from_bend, view.along + onwards) > 0;
}

} // namespace

double LinesView::plane_distance_mm(const Camera &camera) const {
    return std::abs(glm::dot(scale.origin_mm - camera.eye_mm, scale.normal));
}

double distance_from(const LinesView &view, const SoftLine &line, Vec3 point_mm) {
    const Vec3 from_middle = point_mm - view.scale.origin_mm;
    if (is_beyond_bend(view, line, point_mm)) return (from_middle - *line.bend_mm * view.along).y;
    return glm::dot(from_middle, view.scale.across) - line.apart_mm;
}

std::optional<double> mm_over_a_pixel(const LinesView &view, const Camera &camera, const SoftLine &line,
                                      double impact_mm) {
    const auto azimuth = azimuth_of(view, camera, line, impact_mm, 0);
    if (!azimuth) return std::nullopt;
    constexpr double step = 1e-5;
    double squares = 0;
    // Along the radius and along the circle, which cross at right angles.
    for (const bool radial : {true, false}) {
        std::array<double, 2> distances{};
        std::array<Vec2, 2> places{};
        for (const std::size_t k : {0u, 1u}) {
            const double off = (k == 0 ? -step : step), impact = radial ? impact_mm * (1 + off) : impact_mm;
            const auto ray = ray_past(camera, view.orb.centre_mm, impact, radial ? *azimuth : *azimuth + off);
            const auto landing = ray ? landing_of(view, *ray) : std::nullopt;
            if (!landing) return std::nullopt;
            distances.at(k) = distance_from(view, line, *landing);
            places.at(k) = image_position(camera, *ray);
        }
        const double slope = (distances[1] - distances[0]) / glm::length(places[1] - places[0]);
        squares += slope * slope;
    }
    return std::sqrt(squares);
}

Arm arm_on(const LinesView &view, const Camera &camera, const SoftLine &line, double impact_mm) {
    const double reach = soft_reach * line.half_width_mm;
    int beyond = 0, before = 0;
    for (const double off : {-reach, 0.0, reach})
        if (const auto azimuth = azimuth_of(view, camera, line, impact_mm, off)) {
            const auto landing = landing_of(view, *ray_past(camera, view.orb.centre_mm, impact_mm, *azimuth));
            (is_beyond_bend(view, line, *landing) ? beyond : before) += 1;
        }
    if (beyond > 0) return before > 0 ? Arm::both : Arm::beyond_bend;
    return before > 0 ? Arm::before_bend : Arm::none;
}

std::optional<double> azimuth_of(const LinesView &view, const Camera &camera, const SoftLine &line, double impact_mm,
                                 double off_centre_mm) {
    return root_between(
        [&](double azimuth) {
            const auto ray = ray_past(camera, view.orb.centre_mm, impact_mm, azimuth);
            const auto landing = ray ? landing_of(view, *ray) : std::nullopt;
            if (!landing) return std::numeric_limits<double>::quiet_NaN();
            return distance_from(view, line, *landing) - off_centre_mm;
        },
        view.circles.azimuth_rad - line_search_rad, view.circles.azimuth_rad + line_search_rad);
}

std::optional<double> predicted_place(const LinesView &view, const Camera &camera, const SoftLine &line,
                                      double impact_mm) {
    std::array<double, line_strips + 1> places{};
    // As far as a dip is measured to reach.
    const double reach = soft_reach * line.half_width_mm * 2 / std::numbers::pi * std::acos(std::sqrt(dip_ends));
    for (int k = 0; k <= line_strips; ++k) {
        const auto azimuth = azimuth_of(view, camera, line, impact_mm, reach * (2.0 * k / line_strips - 1));
        if (!azimuth) return std::nullopt;
        places[static_cast<std::size_t>(k)] =
            straight_place(view.scale, *ray_past(camera, view.orb.centre_mm, impact_mm, *azimuth));
    }
    double sum = 0, first_moment = 0;
    for (int k = 0; k < line_strips; ++k) {
        const double from = places[static_cast<std::size_t>(k)], to = places[static_cast<std::size_t>(k) + 1];
        const double weight =
            (to - from) * soft_darkness(reach * ((2.0 * k + 1) / line_strips - 1), line.half_width_mm);
        sum += weight;
        first_moment += weight * (from + to) / 2;
    }
    return first_moment / sum;
}

double predicted_jump(const LinesView &view, const Camera &camera, const SoftLine &line) {
    const auto inside = predicted_place(view, camera, line, view.circles.inside_mm),
               outside = predicted_place(view, camera, line, view.circles.outside_mm);
    return inside && outside ? *inside - *outside : std::numeric_limits<double>::quiet_NaN();
}

} // namespace threefold
