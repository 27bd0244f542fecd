// SPDX-License-Identifier: MIT
#include "verifier/claims/lines_asked.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace threefold {

namespace {

constexpr double line_length_mm = 1000; ///< half of it: no line ends in sight
constexpr double arcmin_per_rad = 60 * 180 / std::numbers::pi;

} // namespace

double number_of(const Experiment &e, const std::string &name) { return std::stod(e.record.parameters.at(name)); }

double LinesAsked::arcmin(const Camera &camera, double jump_mm) const {
    return std::atan(std::abs(jump_mm) / view.plane_distance_mm(camera)) * arcmin_per_rad;
}

LinesAsked asked_of(const Experiment &e) {
    LinesAsked asked;
    const bool bent = e.record.parameters.contains("lines.bend_beyond_mm");
    const OrbInScene orb = orb_of(e.scene);
    const double angle = number_of(e, "lines.angle_deg") * std::numbers::pi / 180;
    const double depth = number_of(e, "lines.ahead_mm") - number_of(e, "card.distance_mm");
    const double half_width = number_of(e, "lines.half_width_mm");
    asked.view = {orb,
                  {{0, 0, depth}, {-std::sin(angle), std::cos(angle), 0}, {0, 0, 1}},
                  {std::cos(angle), std::sin(angle), 0},
                  {inside_share * orb.clear_radius_mm(), outside_share * orb.optics.outer_mm, angle}};
    if (bent) {
        const double bend = orb.optics.outer_mm + number_of(e, "lines.bend_beyond_mm");
        // Before its bend, where the line is straight.
        asked.view.circles.outside_mm =
            std::clamp((orb.optics.outer_mm + bend) / 2, orb.optics.outer_mm, asked.view.circles.outside_mm);
        asked.lines = {{"bent line", 1, {0, half_width, bend}}};
        const auto found = std::ranges::find_if(inside_shares_bent, [&](double share) {
            const Arm arm = arm_on(asked.view, e.scene.camera, asked.lines.front().line, share * orb.clear_radius_mm());
            return arm == Arm::beyond_bend;
        });
        asked.view.circles.inside_mm =
            (found == inside_shares_bent.end() ? inside_shares_bent.front() : *found) * orb.clear_radius_mm();
    } else {
        const double apart = number_of(e, "lines.shift_mm") * std::cos(angle);
        asked.lines = {{"upper line", 0, {apart, half_width, {}}},
                       {"middle line", 1, {0, half_width, {}}},
                       {"lower line", 2, {-apart, half_width, {}}}};
    }
    asked.acuity_arcmin = number_of(e, "criterion.acuity_arcmin");
    const Camera &camera = e.scene.camera;
    const double away = camera.projection == Projection::orthographic ? 1 : asked.view.plane_distance_mm(camera);
    asked.picture_px_mm = 2 * film_half_width(camera) / camera.width_px * away;
    return asked;
}

Experiment lines_probe(const ClaimContext &context, std::string name, std::string title, std::string_view scene,
                       std::vector<Assignment> fixed) {
    for (const auto &[parameter, value] : {std::pair("lines.paint", "probe"),
                                           {"glass.coating", "antireflective"},
                                           {"glass.interface_transmittance", "1"},
                                           {"environment.radiance", "1"}})
        fixed.push_back(assign(parameter, std::string_view(value)));
    return context.experiment(std::move(name), std::move(title), scene,
                              {assign("lines.half_length_mm", line_length_mm)}, fixed);
}

} // namespace threefold
