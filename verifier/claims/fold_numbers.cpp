// SPDX-License-Identifier: MIT
#include "verifier/claims/fold_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "verifier/claims/flip.h"
#include "verifier/claims/fold_experiment.h"
#include "verifier/claims/scope_bounds.h"

namespace threefold {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double robe_share = 4; ///< half width of the robe over the orb's image on it: bent rays still meet it
constexpr int circles = 16;      ///< of the ring inside; always as many, so that closed form and picture mean the same
constexpr double bracket_radius_px = 700;
// A fold beside a flip is narrow, so that its two edges fit a small picture; the mean jump of both differs from that of
// the wider fold by the cosine of half its angle: less than 0.1 % up to 5 degrees.
constexpr double narrow_deg = 1.2, wide_deg = 5;

/// How much sharper than usual a bracket must be read, so that what is between the jump and the criterion can be told.
double times_sharper(const FoldNumbers &n, double jump_mm) {
    constexpr double told_px = 0.02, most_times = 6;
    const double robe_per_orb = n.eye_to_robe_mm / n.eye_mm; // lengths on the robe and at the orb that look alike
    const double mm_per_px = n.orb.outer_mm / bracket_radius_px * robe_per_orb;
    const double gap_px = std::abs(jump_mm - n.criterion_mm) / mm_per_px;
    return gap_px > 0 ? std::clamp(told_px / gap_px, 1.0, most_times) : 1.0;
}

double number_in(const Experiment &e, const std::string &name) { return std::stod(e.record.parameters.at(name)); }

} // namespace

std::string name_of_fold(std::size_t fold) {
    return fold == leftmost_fold ? "the leftmost fold" : fmt::format("fold {}", fold + 1);
}

std::vector<Assignment> joined(std::vector<Assignment> first, const std::vector<Assignment> &then) {
    first.insert(first.end(), then.begin(), then.end());
    return first;
}

std::vector<double> even_steps(double from, double to, int count) {
    std::vector<double> values;
    for (int k = 0; k < count; ++k) values.push_back(from + (to - from) * (k + 0.5) / count);
    return values;
}

double eye_to_robe_mm(const Experiment &e) {
    return number_in(e, "eye.distance_mm") + number_in(e, "card.distance_mm");
}

/// The last circle of the ring: the one asked for, or as near to it as rays still go through the hollow, and not so
/// near the rim that they are flung far aside.
double circle_mm(const Experiment &e) {
    constexpr double clear_most = 0.97; // of the hollow's radius
    const OrbInScene orb = orb_of(e.scene);
    return std::min(number_in(e, "criterion.circle_share") * orb.optics.outer_mm, clear_most * orb.clear_radius_mm());
}

std::vector<double> fold_circles_mm(const Experiment &e) {
    const double last = circle_mm(e);
    return even_steps(last - ring_share * orb_of(e.scene).optics.outer_mm, last, circles);
}

Experiment fold_setup(const ClaimContext &context, const std::string &name, const std::string &title,
                      const std::vector<Assignment> &defaults, const std::vector<Assignment> &fixed) {
    const std::vector<Assignment> flat = joined({assign("robe.surface", "flat")}, fixed);
    const Experiment sizes = context.experiment(name, title, "folds", defaults, flat);
    const double half =
        robe_share * number_in(sizes, "orb.radius_mm") * eye_to_robe_mm(sizes) / number_in(sizes, "eye.distance_mm");
    return context.experiment(name, title, "folds", defaults, joined(flat, {assign("card.half_width_mm", half)}));
}

FoldNumbers fold_numbers(const ClaimContext &context, const std::vector<Assignment> &fixed, Vec2 eye_aside_mm) {
    const Experiment e = fold_setup(context, "", "", {}, fixed);
    const FoldScene scene = fold_scene_of(seen_from_beside(e.scene, eye_aside_mm));
    FoldNumbers n;
    n.acuity_arcmin = number_in(e, "criterion.acuity_arcmin");
    n.circle_share = circle_mm(e) / orb_of(e.scene).optics.outer_mm;
    n.criterion_mm = eye_to_robe_mm(e) * std::tan(n.acuity_arcmin / 60 * std::numbers::pi / 180);
    n.orb = scene.orb.optics;
    n.eye_mm = glm::length(scene.eye_mm - scene.orb.centre_mm);
    n.eye_to_robe_mm = eye_to_robe_mm(e);
    n.parameters = e.record.parameters;
    const std::vector<double> ring = fold_circles_mm(e);
    for (const Fold &fold : scene.folds) n.jump_mm.push_back(fold_jump(scene, fold, ring));
    return n;
}

double greatest_jump_mm(const FoldNumbers &numbers, const std::vector<std::size_t> &folds) {
    double greatest = 0;
    for (const std::size_t k : folds) {
        if (!numbers.jump_mm[k]) return no_number;
        greatest = std::max(greatest, std::abs(*numbers.jump_mm[k]));
    }
    return greatest;
}

std::size_t most_broken_fold(const FoldNumbers &numbers, const std::vector<std::size_t> &folds) {
    return *std::ranges::max_element(
        folds, {}, [&](std::size_t k) { return numbers.jump_mm[k] ? std::abs(*numbers.jump_mm[k]) : -1; });
}

std::optional<double> first_root(const std::function<double(double)> &f, double low, double high, int steps,
                                 bool by_factors) {
    const auto at = [&](int k) {
        const double share = static_cast<double>(k) / steps;
        return by_factors ? low * std::pow(high / low, share) : low + (high - low) * share;
    };
    for (int k = 0; k < steps; ++k)
        if (const auto root = root_between(f, std::min(at(k), at(k + 1)), std::max(at(k), at(k + 1)))) return root;
    return std::nullopt;
}

std::optional<double> fold_flip(const ClaimContext &context, const FoldSearch &search) {
    return first_root(
        [&](double value) {
            const FoldNumbers n = fold_numbers(context, joined(search.fixed, {assign(search.parameter, value)}));
            return greatest_jump_mm(n, search.folds) - n.criterion_mm;
        },
        search.low, search.high, search.steps, search.by_factors);
}

std::vector<std::string> bracket_names(const std::string &stem) { return {stem + "-below", stem + "-above"}; }

std::vector<Experiment> fold_brackets(const ClaimContext &context, const FoldSearch &search, const std::string &stem,
                                      double flip) {
    std::vector<Experiment> experiments;
    for (const BracketSide &side : bracket_of(flip)) {
        FoldPlan plan;
        plan.name = fmt::format("{}-{}", stem, side.label);
        plan.title = fmt::format("{} {} the flip at {:.4g}", search.parameter, side.label, flip);
        plan.fixed = joined(search.fixed, {assign(search.parameter, side.value)});
        if (const double own = std::stod(fold_numbers(context, plan.fixed).parameters.at("folds.width_deg"));
            own > narrow_deg && own <= wide_deg)
            plan.fixed = joined(plan.fixed, {assign("folds.width_deg", narrow_deg)});
        const FoldNumbers n = fold_numbers(context, plan.fixed);
        const std::size_t fold = most_broken_fold(n, search.folds);
        plan.folds = {fold};
        plan.rows = false;
        const double jump = greatest_jump_mm(n, {fold});
        // By a larger picture, as far as memory goes, and by samples: an edge's noise falls with their power 3/4.
        constexpr double most_larger = 2;
        const double sharper = times_sharper(n, jump), larger = std::min(sharper, most_larger);
        plan.radius_px = bracket_radius_px * larger;
        plan.samples_per_pixel = static_cast<int>(std::ceil(16 * std::pow(sharper / larger, 4.0 / 3)));
        const bool under = jump < n.criterion_mm;
        plan.conclusions = {{fmt::format("break of {} is {} what the eye resolves", name_of_fold(fold),
                                         under ? "less than" : "more than"),
                             {fold},
                             under ? Relation::below : Relation::above,
                             n.criterion_mm}};
        experiments.push_back(fold_experiment(context, plan));
    }
    return experiments;
}

} // namespace threefold
