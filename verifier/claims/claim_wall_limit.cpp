// SPDX-License-Identifier: MIT
// "With a wall of 1.3 mm no noticeable break" (figures 5C and 6A of the study), with "noticeable" made a number: the
// least angle that the eye resolves. Two things give a wall away: the break of a fold that is not aimed at the orb's
// centre, and the dark rim, which is as wide as the wall (claim rim-reads-wall: light is counted by crossings).
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "verifier/claims/claim.h"
#include "verifier/claims/flip.h"
#include "verifier/claims/fold_experiment.h"
#include "verifier/claims/fold_numbers.h"
#include "verifier/claims/fold_scope.h"
#include "verifier/claims/orb_marks.h"
#include "verifier/claims/scope_bounds.h"
#include "verifier/measure/edges.h"

namespace threefold {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double study_wall_mm = 1.3;
constexpr double least_wall_share = 1e-6;          ///< of the radius: where the search for limits begins
constexpr double rim_px = 8, limit_margin_px = 12; ///< the rim in the picture, and what lies beside it
constexpr int limit_rows_px = 32;
constexpr double limit_orb_share = 0.8; ///< of the film's width
constexpr double wall_error = 3e-3,
                 limit_finest_surface = 2.5e-6; ///< of the wall, of the radius: how far spheres may stray
const std::vector<std::size_t> all_folds{0, 1, 2, 3, 4};
const std::string rim_quantity = "width of the dark rim, seen from the eye";

double arcmin(double radians) { return radians * 180 * 60 / std::numbers::pi; }

/// What lies between two impact parameters, as an angle at the eye.
double angle_arcmin(double from_mm, double to_mm, double eye_mm) {
    return arcmin(std::asin(to_mm / eye_mm) - std::asin(from_mm / eye_mm));
}

double rim_arcmin(const optics::Orb<double> &orb, double eye_mm) {
    return angle_arcmin(orb.outer_mm - optics::rim_width(orb), orb.outer_mm, eye_mm);
}

struct Limits {
    FoldNumbers here;
    FoldSearch search;
    std::optional<double> by_break_mm, by_rim_mm;

    bool break_binds() const { return by_break_mm && (!by_rim_mm || *by_break_mm <= *by_rim_mm); }
    std::optional<double> binding_mm() const { return break_binds() ? by_break_mm : by_rim_mm; }
};

Limits find_limits(const ClaimContext &context) {
    Limits l{fold_numbers(context, {}), {}, {}, {}};
    const double radius = l.here.orb.outer_mm;
    l.search.parameter = "orb.wall_mm";
    l.search.folds = all_folds;
    l.search.low = least_wall_share * radius;
    l.search.high = (1 - l.here.circle_share) * radius * 0.9999;
    l.search.steps = 40;
    l.search.by_factors = true;
    l.by_break_mm = fold_flip(context, l.search);
    l.by_rim_mm = first_root(
        [&](double wall) {
            return rim_arcmin(optics::shell(radius, wall, l.here.orb.index), l.here.eye_mm) - l.here.acuity_arcmin;
        },
        l.search.low, 0.999 * radius, 80, true);
    return l;
}

enum class Side { study, below, above };

Experiment rim_experiment(const ClaimContext &context, const Limits &limits, const std::string &name, Side side,
                          std::vector<Assignment> fixed) {
    Experiment e =
        context.experiment(name, "the right edge of a hollow orb, magnified", "furnace", {},
                           joined({assign("orb.kind", "hollow"), assign("glass.coating", "antireflective"),
                                   assign("glass.interface_transmittance", "0.5"), assign("environment.radiance", "1"),
                                   assign("orb.shift_mm", "0"), assign("image.orb_share", limit_orb_share)},
                                  fixed));
    const OrbInScene orb = orb_of(e.scene);
    const double radius = orb.optics.outer_mm, wall = orb.optics.wall_mm, eye = e.scene.camera.eye_mm.z;
    const double rim_share = 0.5 * limit_orb_share * wall / radius; // of the film's width
    Camera &camera = e.scene.camera;
    camera.width_px = camera.height_px = 2 * static_cast<int>(std::clamp(rim_px / rim_share, 160.0, 1e8) / 2);
    const double middle = column_of(camera, orb, radius - wall / 2, camera.height_px / 2.0);
    const int width =
        std::min(2 * static_cast<int>(std::ceil(camera.width_px * rim_share / 2) + limit_margin_px), camera.width_px);
    camera.crop = Crop{std::clamp(static_cast<int>(middle) - width / 2, 0, camera.width_px - width),
                       (camera.height_px - limit_rows_px) / 2, width, limit_rows_px};
    const double left = column_of(camera, orb, orb.optics.inner_mm, limit_rows_px / 2.0),
                 right = column_of(camera, orb, radius, limit_rows_px / 2.0);
    const bool readable = optics::rim_width(orb.optics) > wall * (1 - 1e-9) && left > 2 && right < width - 2;
    e.samples_per_pixel = 64; // coated glass does not split rays: they are cheap
    e.surface_tolerance_mm = std::max(wall_error * wall, limit_finest_surface * radius);

    const double expected = rim_arcmin(orb.optics, eye), per_mm = expected / optics::rim_width(orb.optics);
    e.predict = [=, acuity = limits.here.acuity_arcmin](const Accuracy &a) {
        switch (side) {
        case Side::below:
            return std::vector<Expected>{
                {"dark rim is narrower than the eye resolves", "arcmin", Relation::below, acuity, {}}};
        case Side::above:
            return std::vector<Expected>{
                {"dark rim is wider than the eye resolves", "arcmin", Relation::above, acuity, {}}};
        case Side::study:
            break;
        }
        return std::vector<Expected>{
            {rim_quantity,
             "arcmin",
             Relation::equal,
             expected,
             {{"tessellation", 4 * a.surface_mm * per_mm, "both borders lie on tessellated spheres"},
              {"quantisation", 8 * a.radiance_step * expected, "shares of known brightness"},
              {"arithmetic", 4 * a.rounding_mm * per_mm, "rounding of positions"},
              {"edge", 0.002 * expected, "a border that curves through a pixel, and its finite samples"}},
             true},
            {"dark rim is wider than the eye resolves", "arcmin", Relation::above, acuity, {}}};
    };
    e.measure = [=](const Image &image, const Camera &at) {
        double mean = readable ? 0 : nan;
        const int split = static_cast<int>(std::round(column_of(at, orb, radius - wall / 2, limit_rows_px / 2.0)));
        for (int row = 0; readable && row < image.height; ++row) {
            const Borders b = plateau_borders(image, row, split, {1.0 / 16, 1.0 / 4, 1});
            const auto impact = [&](double x) {
                return impact_parameter(camera_ray(at, {x, row + 0.5}), orb.centre_mm);
            };
            mean += angle_arcmin(impact(b.left_px), impact(b.right_px), eye) / image.height;
        }
        return std::vector<Reading>{{rim_quantity, mean},
                                    {"dark rim is wider than the eye resolves", mean},
                                    {"dark rim is narrower than the eye resolves", mean}};
    };
    e.draw = [=](const Image &image, const Camera &at) {
        std::vector<Mark> marks;
        for (const double b : {orb.optics.inner_mm, radius}) {
            const double x = column_of(at, orb, b, limit_rows_px / 2.0);
            marks.push_back(
                {Mark::Kind::line, {x, 0}, {x, static_cast<double>(image.height)}, 0, Mark::Meaning::expected, ""});
        }
        if (!readable) return marks;
        const int row = image.height / 2;
        const Borders b =
            plateau_borders(image, row, static_cast<int>(std::round((left + right) / 2)), {1.0 / 16, 0.25, 1});
        for (const double x : {b.left_px, b.right_px})
            marks.push_back({Mark::Kind::cross, {x, row + 0.5}, Vec2(0), 0, Mark::Meaning::measured, ""});
        return marks;
    };
    return e;
}

Experiment own_wall(const ClaimContext &context, const Limits &limits) {
    FoldPlan plan;
    const std::size_t fold = most_broken_fold(limits.here, all_folds);
    plan.name = "wall-folds";
    plan.title = fmt::format("{} at the orb's boundary, at the scene's own wall", name_of_fold(fold));
    plan.folds = {fold};
    plan.radius_px = context.quick ? 200 : 280;
    plan.conclusions = {
        {"break of a fold is more than the eye resolves", {fold}, Relation::above, limits.here.criterion_mm}};
    return fold_experiment(context, plan);
}

/// What the study said of its wall, held against the closed form at that wall.
std::string study_note(const ClaimContext &context, const FoldNumbers &here) {
    const std::string said = fmt::format("The study saw no noticeable break at {:g} mm.", study_wall_mm);
    if (!(study_wall_mm < here.orb.outer_mm)) return said;
    const FoldNumbers n = fold_numbers(context, {assign("orb.wall_mm", study_wall_mm)});
    const double rim = rim_arcmin(n.orb, n.eye_mm),
                 jump = greatest_jump_mm(n, all_folds) / n.criterion_mm * n.acuity_arcmin;
    const bool seen = jump > n.acuity_arcmin;
    if (std::isnan(jump)) return said + " At that wall the folds cannot be read.";
    return fmt::format(
        "{} {} for an eye of {:g} minute(s) of arc: at that wall the leftmost fold breaks by {:.3g}', seen "
        "from {:g} mm; the dark rim is {:.3g}' wide.",
        said, seen ? "That is not so" : "That is so", n.acuity_arcmin, jump, n.eye_mm, rim);
}

std::vector<ScopeNumber> limit_scope(const ClaimContext &context, const ScopeSettings &settings) {
    const FoldNumbers n = fold_numbers(context, {});
    ScopeNumber of_break =
        break_scope(context, settings, "break of the fold that breaks most", {}, {most_broken_fold(n, all_folds)});
    const double rim = rim_arcmin(n.orb, n.eye_mm);
    const IndexBounds index = by_index(n.orb.index, settings, [&](double i) {
        return rim_arcmin(optics::shell(n.orb.outer_mm, n.orb.wall_mm, i), n.eye_mm);
    });
    EffectBounds of_rim = of_break.bounds; // also nothing that is lit
    of_rim.dispersion = index.dispersion;
    of_rim.birefringence = index.birefringence;
    of_rim.pupil = by_pupil(settings, [&](Vec2 aside) {
        return rim_arcmin(n.orb, std::sqrt(n.eye_mm * n.eye_mm + aside.x * aside.x + aside.y * aside.y));
    });
    return {of_break,
            ScopeNumber{"width of the dark rim as the eye sees it", "arcmin", rim, margin_to(rim, {n.acuity_arcmin}),
                        margin_words({n.acuity_arcmin}, "arcmin"), of_rim}};
}

} // namespace

Claim claim_wall_limit() {
    Claim claim;
    claim.name = "wall-limit";
    claim.statement =
        "To an eye of a stated acuity, only a wall thinner than a limit shows neither a dark rim nor a break in a fold "
        "that is not aimed at the orb's centre; the wall of the scene (the study's: 1.3 mm) is above that limit and "
        "shows both.";
    claim.experiments = [](const ClaimContext &context) {
        const Limits limits = find_limits(context);
        std::vector<Experiment> all{own_wall(context, limits),
                                    rim_experiment(context, limits, "wall-rim", Side::study, {})};
        if (limits.by_break_mm)
            for (Experiment &e : fold_brackets(context, limits.search, "wall-limit-break-flip", *limits.by_break_mm))
                all.push_back(std::move(e));
        if (limits.by_rim_mm)
            for (const BracketSide &side : bracket_of(*limits.by_rim_mm))
                all.push_back(rim_experiment(context, limits, fmt::format("wall-limit-rim-flip-{}", side.label),
                                             side.label == "below" ? Side::below : Side::above,
                                             {assign("orb.wall_mm", side.value)}));
        return all;
    };
    claim.summary = [](const ClaimContext &context, Verdict verdict) -> std::string {
        const Limits l = find_limits(context);
        const double acuity = l.here.acuity_arcmin, wall = l.here.orb.wall_mm;
        switch (verdict) {
        case Verdict::holds:
            return l.binding_mm()
                       ? fmt::format("The largest wall that an eye of {:g} minute(s) of arc cannot notice is "
                                     "{:.3g} mm; the wall of {:g} mm is {:.2g} times as thick, and both its dark "
                                     "rim and the break of a fold are seen in every renderer.",
                                     acuity, *l.binding_mm(), wall, wall / *l.binding_mm())
                       : "";
        case Verdict::fails:
            return fmt::format("At this wall of {:g} mm and an acuity of {:g} minute(s) of arc, the dark rim or the "
                               "break of the folds is not noticeable, or some renderer disagrees with the closed form.",
                               wall, acuity);
        case Verdict::undecided:
            return "It is not settled whether this wall can be noticed.";
        }
        return "";
    };
    claim.notes = [](const ClaimContext &context) {
        const Limits l = find_limits(context);
        const FoldNumbers &n = l.here;
        std::vector<std::string> notes{
            study_note(context, n),
            "The folds that are aimed at the orb's centre do not break at any wall: that they look whole says nothing "
            "of the wall's thickness. What cuts them is the dark rim."};
        if (l.by_rim_mm)
            notes.push_back(
                fmt::format("The dark rim falls under {:g}' for walls under {:.4g} mm (the study: {:g} mm).",
                            n.acuity_arcmin, *l.by_rim_mm, study_wall_mm));
        else
            notes.push_back("No wall makes the rim as wide as the criterion: there is no flip by the rim.");
        if (l.by_break_mm)
            notes.push_back(
                fmt::format("The break of the folds falls under {:g}' for walls under {:.4g} mm, read on the "
                            "ring from {:.3g} to {:.3g} of the radius, the leftmost fold passing the centre "
                            "by {} mm.",
                            n.acuity_arcmin, *l.by_break_mm, n.circle_share - ring_share, n.circle_share,
                            n.parameters.at("folds.miss_mm")));
        else
            notes.push_back(
                "No wall that leaves the ring open takes the break of the folds across the criterion: there "
                "is no flip by the break.");
        if (l.binding_mm())
            notes.push_back(fmt::format("The {} binds: the largest wall that goes unnoticed is {:.4g} mm.",
                                        l.break_binds() ? "break of the folds" : "dark rim", *l.binding_mm()));
        return notes;
    };
    claim.flips = [](const ClaimContext &context) {
        const Limits l = find_limits(context);
        std::vector<FlipPoint> flips;
        const auto add = [&](const std::optional<double> &wall, bool binds, const std::string &what,
                             const std::string &stem) {
            if (wall)
                flips.push_back({"orb.wall_mm", "mm", *wall, l.here.orb.wall_mm,
                                 fmt::format("{} is noticed only above it{}", what,
                                             binds ? ": this is the largest wall that goes unnoticed" : ""),
                                 bracket_names(stem)});
        };
        add(l.by_break_mm, l.break_binds(), "the break of a fold", "wall-limit-break-flip");
        add(l.by_rim_mm, !l.break_binds(), "the dark rim", "wall-limit-rim-flip");
        return flips;
    };
    claim.scope = limit_scope;
    claim.mutant = Fault::wall_doubled;
    return claim;
}

} // namespace threefold
