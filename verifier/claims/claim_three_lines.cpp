// SPDX-License-Identifier: MIT
// "A line whose plane holds the eye and the orb's centre crosses the boundary unbroken" (figure 4 of the study).
// The jump of a line is read between two circles about the orb: on the outer one, a little beside the orb, the line is
// seen directly; on the inner one, at a stated share of the radius within which rays go through, it is seen through the
// glass. On a circle every ray has the same impact parameter, so that an orb turns them all by the same angle: the jump
// is finite, smooth in everything, and exactly proportional to the line's distance from the axis. Nearer to the
// boundary it would not be so: a shell bends rays without bound there.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/catalogue/three_lines.h"
#include "scenes/error.h"
#include "verifier/claims/claim.h"
#include "verifier/claims/flip.h"
#include "verifier/claims/lines_asked.h"
#include "verifier/claims/scope_three_lines.h"

namespace threefold {

namespace {

constexpr double lines_orb_share = 0.8; ///< of the film's width that the orb fills
constexpr double pixels_per_half_width = 6;
constexpr int lines_margin_px = 6, most_px = 640;
constexpr double reading_px = 0.01;      ///< cubic convolution errs by a tenth of it, see tests/dark_line_test.cpp
constexpr double lines_surface = 1.2e-5; ///< of the radius: finer spheres cost seconds and move no verdict

/// Looks straight at the axis, the orb at a stated share of the film, whose pixels resolve the lines where they look
/// narrowest; of it only the crossing.
Camera measuring_camera(const LinesAsked &asked, Camera camera) {
    const OrbInScene &orb = asked.view.orb;
    const double eye = std::abs(camera.eye_mm.z - orb.centre_mm.z), radius = orb.optics.outer_mm;
    camera.eye_mm = {0, 0, camera.eye_mm.z};
    camera.target_mm = Vec3(0);
    const double reach = (radius + glm::length(Vec2(orb.centre_mm))) / lines_orb_share;
    camera.orthographic_width_mm = 2 * reach;
    camera.horizontal_fov_deg = 360 / std::numbers::pi * std::atan(reach / std::sqrt((eye - radius) * (eye + radius)));

    constexpr double coarse_px = 1 << 20; // positions on this film are rounded to a part of a pixel of the final one
    camera.width_px = camera.height_px = static_cast<int>(coarse_px);
    Vec2 low(std::numeric_limits<double>::infinity()), high(-low);
    const double away = camera.projection == Projection::orthographic ? 1 : asked.view.plane_distance_mm(camera);
    const double film_mm = 2 * film_half_width(camera) * away;
    double narrowest = 1;
    for (const NamedLine &named : asked.lines)
        for (const double impact : {asked.view.circles.inside_mm, asked.view.circles.outside_mm}) {
            const double width = soft_reach * named.line.half_width_mm;
            std::array<std::optional<double>, 2> places{};
            for (const int side : {0, 1}) {
                const auto azimuth = azimuth_of(asked.view, camera, named.line, impact, (2 * side - 1) * width);
                if (!azimuth) continue;
                const Ray ray = *ray_past(camera, orb.centre_mm, impact, *azimuth);
                places[static_cast<std::size_t>(side)] = straight_place(asked.view.scale, ray);
                const Vec2 at = image_position(camera, ray);
                low = glm::min(low, at);
                high = glm::max(high, at);
            }
            if (const auto steepness = mm_over_a_pixel(asked.view, camera, named.line, impact))
                narrowest = std::min(narrowest, film_mm / coarse_px / *steepness);
            if (places[0] && places[1])
                narrowest = std::min(narrowest, std::abs(*places[1] - *places[0]) / (2 * width));
        }
    double film_px = film_mm / asked.lines.front().line.half_width_mm * pixels_per_half_width / narrowest;
    if (!(low.x < high.x) || !(low.y < high.y)) { // no line is seen: there is nothing to be read
        camera.width_px = camera.height_px = 64;
        return camera;
    }
    film_px = std::min(film_px, (most_px - 2 * lines_margin_px) * coarse_px / std::max(high.x - low.x, high.y - low.y));
    const int side = 2 * static_cast<int>(std::ceil(std::clamp(film_px, 32.0, 1e8) / 2));
    const double scale = side / coarse_px;
    const auto clamped = [side](double px) { return std::clamp(static_cast<int>(px), 0, side); };
    camera.width_px = camera.height_px = side;
    Crop crop{clamped(low.x * scale - lines_margin_px), clamped(low.y * scale - lines_margin_px), 0, 0};
    crop.width_px = std::max(1, clamped(std::ceil(high.x * scale) + lines_margin_px) - crop.x_px);
    crop.height_px = std::max(1, clamped(std::ceil(high.y * scale) + lines_margin_px) - crop.y_px);
    camera.crop = crop;
    return camera;
}

/// How far errors of a renderer move a jump (mm), itemised.
std::vector<BudgetItem> jump_budget(const LinesAsked &asked, const Camera &camera, const SoftLine &line,
                                    const Accuracy &a) {
    const auto changed = [&](double radius_share, double wall_share) {
        LinesAsked other = asked;
        optics::Orb<double> &orb = other.view.orb.optics;
        orb = orb.is_solid() ? optics::solid_ball(orb.outer_mm * radius_share, orb.index)
                             : optics::shell(orb.outer_mm * radius_share, orb.wall_mm * wall_share, orb.index);
        return predicted_jump(other.view, camera, line);
    };
    constexpr double step = 1e-4;
    const optics::Orb<double> &orb = asked.view.orb.optics;
    const double here = changed(1, 1), by_radius = std::abs(changed(1 + step, 1) - here) / (step * orb.outer_mm),
                 by_wall = orb.is_solid() ? 0 : std::abs(changed(1, 1 + step) - here) / (step * orb.wall_mm);
    const double sensitivity = 2 * (1 + by_radius) + 2 * by_wall;
    const double away = camera.projection == Projection::orthographic ? 1 : asked.view.plane_distance_mm(camera);
    const double px_mm = 2 * film_half_width(camera) / camera.width_px * away;
    return {
        {"tessellation", sensitivity * a.surface_mm,
         fmt::format("both surfaces lie beside the true ones; they move the jump {:.3g} times as far", sensitivity)},
        {"arithmetic", 2 * sensitivity * a.rounding_mm, "rounding of positions at the scale of the scene"},
        {"quantisation", 8 * (a.radiance_step + 1.0 / 65535) * line.half_width_mm,
         "stored radiances and the 16-bit profile of the line, over its width"},
        {"filter", a.filter_px * px_mm, "spread of the sample position"},
        {"reading", reading_px * px_mm,
         fmt::format("a centre between pixels: {:g} px of the measured picture", reading_px)},
    };
}

std::vector<Expected> predict(const LinesAsked &asked, const Camera &camera, const Accuracy &a) {
    std::vector<Expected> expected;
    for (const NamedLine &named : asked.lines) {
        const double jump = predicted_jump(asked.view, camera, named.line);
        std::vector<BudgetItem> budget = jump_budget(asked, camera, named.line, a);
        expected.push_back({"jump of the " + named.name, "mm", Relation::equal, jump, budget, true});
        for (BudgetItem &item : budget) item.value /= asked.picture_px_mm;
        expected.push_back({"jump of the " + named.name + " in the picture", "px", Relation::equal,
                            jump / asked.picture_px_mm, budget, false});
    }
    for (const NamedLine &named : asked.lines) {
        const bool unbroken = named.name == "middle line";
        expected.push_back({fmt::format("break of the {}, as the eye sees it, is {}", named.name,
                                        unbroken ? "too small to notice" : "noticeable"),
                            "arcmin",
                            unbroken ? Relation::below : Relation::above,
                            asked.acuity_arcmin,
                            {}});
    }
    return expected;
}

struct ReadLine {
    std::optional<DarkCentre> inside, outside;

    double jump_mm() const {
        return inside && outside ? inside->place - outside->place : std::numeric_limits<double>::quiet_NaN();
    }
};

ReadLine read_line(const LinesAsked &asked, const Image &image, const Camera &camera, int channel) {
    const auto on = [&](double impact) {
        const double azimuth = asked.view.circles.azimuth_rad, reach = std::numbers::pi / 2;
        return dark_centre(
            image, camera,
            circle_path(camera, asked.view.orb.centre_mm, impact, asked.view.scale, azimuth - reach, azimuth + reach),
            channel);
    };
    return {on(asked.view.circles.inside_mm), on(asked.view.circles.outside_mm)};
}

std::vector<Reading> measure(const LinesAsked &asked, const Image &image, const Camera &camera) {
    std::vector<Reading> readings;
    for (const NamedLine &named : asked.lines) {
        const double jump = read_line(asked, image, camera, named.channel).jump_mm();
        const double seen = asked.arcmin(camera, jump);
        readings.push_back({"jump of the " + named.name, jump});
        readings.push_back({"jump of the " + named.name + " in the picture", jump / asked.picture_px_mm});
        for (const char *word : {"too small to notice", "noticeable"})
            readings.push_back({fmt::format("break of the {}, as the eye sees it, is {}", named.name, word), seen});
    }
    return readings;
}

std::vector<Mark> draw(const LinesAsked &asked, const Image &image, const Camera &camera) {
    std::vector<Mark> marks;
    const auto add = [&](Vec2 at, Mark::Meaning meaning, const char *label) {
        Mark mark;
        mark.kind = Mark::Kind::cross;
        mark.from_px = mark.to_px = at;
        mark.meaning = meaning;
        const bool is_first = std::ranges::none_of(marks, [&](const Mark &m) { return m.meaning == meaning; });
        if (is_first) mark.label = label;
        marks.push_back(mark);
    };
    for (const NamedLine &named : asked.lines) {
        for (const double impact : {asked.view.circles.inside_mm, asked.view.circles.outside_mm})
            if (const auto azimuth = azimuth_of(asked.view, camera, named.line, impact, 0))
                add(image_position(camera, *ray_past(camera, asked.view.orb.centre_mm, impact, *azimuth)),
                    Mark::Meaning::expected, "line's centre, expected");
        const ReadLine line = read_line(asked, image, camera, named.channel);
        for (const auto &centre : {line.inside, line.outside})
            if (centre) add(centre->image_px, Mark::Meaning::measured, "measured");
    }
    return marks;
}

/// A probe with everything but its predictions.
Experiment measured_probe(const ClaimContext &context, std::string name, std::string title, std::string_view scene,
                          const std::vector<Assignment> &fixed, LinesAsked &asked) {
    Experiment e = lines_probe(context, std::move(name), std::move(title), scene, fixed);
    asked = asked_of(e);
    e.scene.camera = measuring_camera(asked, e.scene.camera);
    e.sampling = Sampling::pixel_centres;
    e.samples_per_pixel = 1;
    e.shift_replicates = true;
    const optics::Orb<double> &orb = asked.view.orb.optics;
    e.surface_tolerance_mm =
        std::max(orb.is_solid() ? 2.5e-5 * orb.outer_mm : 1.5e-3 * orb.wall_mm, lines_surface * orb.outer_mm);
    const LinesAsked copy = asked;
    e.measure = [copy](const Image &image, const Camera &camera) { return measure(copy, image, camera); };
    e.draw = [copy](const Image &image, const Camera &camera) { return draw(copy, image, camera); };
    return e;
}

Experiment crossing_experiment(const ClaimContext &context, const std::string &kind) {
    LinesAsked asked;
    Experiment e =
        measured_probe(context, kind + "-lines",
                       kind == "bent" ? "the bent line where it crosses the boundary of the hollow orb"
                                      : fmt::format("three lines where they cross the boundary of the {} orb", kind),
                       "three-lines-" + kind, {}, asked);
    const Camera camera = e.scene.camera;
    for (const NamedLine &named : asked.lines)
        for (const double impact : {asked.view.circles.inside_mm, asked.view.circles.outside_mm})
            if (arm_on(asked.view, camera, named.line, impact) == Arm::both)
                throw Error(
                    Exit::bad_data,
                    fmt::format("the {} bends where its place is read, on the circle of {:.4g} mm", named.name, impact),
                    "lines.bend_beyond_mm must be greater, or lines.half_width_mm smaller");
    e.predict = [asked, camera](const Accuracy &a) { return predict(asked, camera, a); };
    return e;
}

// ---------------------------------------------------------------------------------------------------------------------
// Flip points

constexpr const char *shift_name = "lines.shift_mm", *wall_name = "orb.wall_mm";
constexpr const char *conclusion = "break of the upper line, as the eye sees it, is noticeable";

/// Break of the upper line over the criterion, minus 1, with one parameter set.
double beyond_acuity(const ClaimContext &context, std::string_view scene, std::string_view name, double value) {
    const Experiment e = lines_probe(context, "", "", scene, {assign(name, value)});
    const LinesAsked asked = asked_of(e);
    Camera camera = e.scene.camera;
    const double jump = predicted_jump(asked.view, camera, asked.lines.front().line);
    return asked.arcmin(camera, jump) / asked.acuity_arcmin - 1;
}

/// From the greatest value downwards, the first octave in which the break passes the criterion.
std::optional<double> line_flip_of(const ClaimContext &context, std::string_view scene, std::string_view name,
                                   double greatest) {
    const auto f = [&](double value) { return beyond_acuity(context, scene, name, value); };
    constexpr int octaves = 30;
    for (double high = greatest; high > greatest * std::exp2(-octaves); high /= 2)
        if (const auto root = root_between(f, high / 2, high)) return root;
    return std::nullopt;
}

struct LineFlip {
    std::string scene, parameter, label, meaning;
    std::optional<double> value;
    double here = 0;
};

std::vector<LineFlip> line_flips_of(const ClaimContext &context) {
    std::vector<LineFlip> flips;
    for (const std::string kind : {"hollow", "solid"}) {
        const std::string scene = "three-lines-" + kind;
        const Experiment e = lines_probe(context, "", "", scene, {});
        const OrbInScene orb = orb_of(e.scene);
        flips.push_back({scene, shift_name, kind + "-shift",
                         fmt::format("beside the {} orb's middle line, a line breaks noticeably only when it is "
                                     "shifted by more than this",
                                     kind),
                         line_flip_of(context, scene, shift_name, orb.optics.outer_mm), number_of(e, shift_name)});
        if (kind == "hollow")
            flips.push_back({scene, wall_name, "wall",
                             "through a wall thinner than this even the lines beside the middle one seem unbroken",
                             line_flip_of(context, scene, wall_name, 0.5 * orb.optics.outer_mm),
                             number_of(e, wall_name)});
    }
    return flips;
}

std::string bracket_name(const LineFlip &flip, std::string_view side) {
    return fmt::format("three-lines-flip-{}-{}", flip.label, side);
}

std::vector<Experiment> bracket_experiments(const ClaimContext &context) {
    std::vector<Experiment> experiments;
    for (const LineFlip &flip : line_flips_of(context)) {
        if (!flip.value) continue;
        for (const BracketSide &side : bracket_of(*flip.value)) {
            LinesAsked asked;
            Experiment e = measured_probe(
                context, bracket_name(flip, side.label),
                fmt::format("{} = {:.5g}, just {} the flip point", flip.parameter, side.value, side.label), flip.scene,
                {assign(flip.parameter, side.value)}, asked);
            if (context.quick) e.replicates = 4; // they lie fifty standard errors from the criterion
            const Relation relation = side.label == "below" ? Relation::below : Relation::above;
            e.predict = [=](const Accuracy &) {
                return std::vector<Expected>{{conclusion, "arcmin", relation, asked.acuity_arcmin, {}}};
            };
            experiments.push_back(std::move(e));
        }
    }
    return experiments;
}

/// What optics itself says of the conclusion at these parameters: the lines that do not do as stated.
std::vector<std::string> contradictions(const ClaimContext &context) {
    std::vector<std::string> found;
    for (const char *kind : {"hollow", "solid", "bent"}) {
        const Experiment e = lines_probe(context, "", "", std::string("three-lines-") + kind, {});
        const LinesAsked asked = asked_of(e);
        Camera camera = e.scene.camera;
        for (const NamedLine &named : asked.lines) {
            const double seen = asked.arcmin(camera, predicted_jump(asked.view, camera, named.line));
            const bool unbroken = named.name == "middle line";
            if (std::isfinite(seen) && (seen < asked.acuity_arcmin) != unbroken)
                found.push_back(fmt::format("the {} behind the {} orb {} ({:.3g} minutes of arc)", named.name,
                                            kind == std::string("bent") ? "hollow" : kind,
                                            unbroken ? "breaks" : "does not break noticeably", seen));
        }
    }
    return found;
}

std::string summary(const ClaimContext &context, Verdict verdict) {
    switch (verdict) {
    case Verdict::holds:
        return "The line that points at the orb's centre, as the eye sees it, runs on through the orb without a break, "
               "in every renderer and by exact optics. Its neighbours break at the boundary, and so does the line "
               "itself once it is bent outside.";
    case Verdict::fails: {
        const std::vector<std::string> found = contradictions(context);
        return found.empty() ? "Some renderer does not put a line where exact optics has it."
                             : fmt::format("Exact optics itself contradicts the statement for this scene: {}.",
                                           fmt::join(found, "; "));
    }
    case Verdict::undecided:
        return "The renders do not settle whether the lines break.";
    }
    return "";
}

std::vector<std::string> notes(const ClaimContext &context) {
    std::vector<std::string> notes;
    for (const char *kind : {"hollow", "solid"}) {
        const Experiment e = lines_probe(context, "", "", std::string("three-lines-") + kind, {});
        const LinesAsked asked = asked_of(e);
        Camera camera = e.scene.camera;
        const double jump = predicted_jump(asked.view, camera, asked.lines.front().line);
        if (!std::isfinite(jump)) {
            notes.push_back(fmt::format("The lines beside are not seen on the inner circle of the {} orb.", kind));
            continue;
        }
        notes.push_back(fmt::format("Through the {} orb a line beside the middle one jumps by {:.4g} times its "
                                    "distance from it: here {:.4g} mm on its plane, {:.3g} minutes of arc, {:.3g} "
                                    "pixels of the scene's picture.",
                                    kind, std::abs(jump / asked.lines.front().line.apart_mm), std::abs(jump),
                                    asked.arcmin(camera, jump), std::abs(jump) / asked.picture_px_mm));
    }
    const LinesAsked bent = asked_of(lines_probe(context, "", "", "three-lines-bent", {}));
    notes.push_back(fmt::format(
        "A jump is read between the circle at {:g} of the radius within which rays go through ({:g} for the bent line, "
        "which only so near to the boundary is seen beyond its bend) and the circle at {:g} of the orb's radius. "
        "Nearer to the boundary it changes ever more steeply.",
        inside_share, bent.view.circles.inside_mm / bent.view.orb.clear_radius_mm(), outside_share));
    for (const LineFlip &flip : line_flips_of(context))
        if (!flip.value)
            notes.push_back(fmt::format("{} ({}) has no flip point at these parameters.", flip.parameter, flip.scene));
    return notes;
}

} // namespace

Claim claim_three_lines() {
    Claim claim;
    claim.name = "three-lines";
    claim.statement = "A straight line whose plane holds the eye and the orb's centre crosses the orb's boundary "
                      "unbroken, behind a hollow and behind a solid orb, whatever the wall and the index; the lines "
                      "beside it break, and so does the line itself when it is bent outside the orb.";
    claim.experiments = [](const ClaimContext &context) {
        std::vector<Experiment> all{crossing_experiment(context, "hollow"), crossing_experiment(context, "solid"),
                                    crossing_experiment(context, "bent")};
        for (Experiment &e : bracket_experiments(context)) all.push_back(std::move(e));
        return all;
    };
    claim.summary = summary;
    claim.notes = notes;
    claim.flips = [](const ClaimContext &context) {
        std::vector<FlipPoint> points;
        for (const LineFlip &flip : line_flips_of(context))
            if (flip.value)
                points.push_back({flip.parameter,
                                  "mm",
                                  *flip.value,
                                  flip.here,
                                  flip.meaning,
                                  {bracket_name(flip, "below"), bracket_name(flip, "above")}});
        return points;
    };
    claim.scope = scope_three_lines;
    claim.mutant = Fault::index_one_percent;
    return claim;
}

} // namespace threefold
