// SPDX-License-Identifier: MIT
// "Four folds that converge on the orb's centre cross its boundary smoothly, the leftmost does not and breaks" (figure
// 5 of the study).
#include <cmath>

#include <fmt/format.h>

#include "verifier/claims/claim.h"
#include "verifier/claims/fold_experiment.h"
#include "verifier/claims/fold_numbers.h"
#include "verifier/claims/fold_scope.h"

namespace threefold {

namespace {

constexpr double greatest_miss_share = 0.9; ///< of the radius: as far as a flip is looked for

FoldSearch miss_search(const ClaimContext &context) {
    FoldSearch search;
    search.parameter = "folds.miss_mm";
    search.folds = {leftmost_fold};
    search.high = greatest_miss_share * fold_numbers(context, {}).orb.outer_mm;
    return search;
}

/// For the eye alone.
Experiment view(const ClaimContext &context) {
    const std::string size = context.quick ? "128" : "320";
    Experiment e = context.experiment("folds-view", "what one sees: a robe with five folds behind a hollow orb",
                                      "folds", {assign("image.width_px", size), assign("image.height_px", size)},
                                      {assign("robe.surface", "cloth")});
    e.sampling = Sampling::box;
    e.samples_per_pixel = 4;
    e.replicates = 1;
    e.cut_weight = 1e-3;
    e.surface_tolerance_mm = 1e-4 * orb_of(e.scene).optics.outer_mm;
    return e;
}

Experiment edges_experiment(const ClaimContext &context) {
    const double criterion = fold_numbers(context, {}).criterion_mm;
    FoldPlan plan;
    plan.name = "folds-edges";
    plan.title = "the folds' edges where they cross the orb's upper right boundary";
    plan.radius_px = context.quick ? 160 : 240;
    plan.pixel_rows = true;
    plan.conclusions = {
        {"break of the four aimed folds is less than the eye resolves", aimed_folds, Relation::below, criterion},
        {"break of the leftmost fold is more than the eye resolves", {leftmost_fold}, Relation::above, criterion},
    };
    return fold_experiment(context, plan);
}

} // namespace

Claim claim_folds() {
    Claim claim;
    claim.name = "folds";
    claim.statement = "A fold that lies in a plane with the eye and the orb's centre crosses the orb's boundary "
                      "unbroken; the leftmost fold, which passes the centre, breaks so far that the eye sees it.";
    claim.experiments = [](const ClaimContext &context) {
        std::vector<Experiment> all{view(context), edges_experiment(context)};
        const FoldSearch search = miss_search(context);
        if (const auto flip = fold_flip(context, search))
            for (Experiment &e : fold_brackets(context, search, "folds-flip", *flip)) all.push_back(std::move(e));
        return all;
    };
    claim.summary = [](const ClaimContext &, Verdict verdict) {
        switch (verdict) {
        case Verdict::holds:
            return "The four folds that are aimed at the orb's centre run through its boundary without a break; the "
                   "leftmost one is visibly displaced. Every renderer shows it, and each agrees with exact optics.";
        case Verdict::fails:
            return "In this scene, or in some renderer, an aimed fold breaks or the leftmost one does not.";
        case Verdict::undecided:
            return "The renders do not settle which folds break.";
        }
        return "";
    };
    claim.notes = [](const ClaimContext &context) {
        const FoldNumbers n = fold_numbers(context, {});
        std::vector<std::string> notes{fmt::format(
            "A jump is read on the ring from {:.3g} to {:.3g} of the orb's radius: the distance, on the robe, between "
            "where the fold seems to be and its straight continuation from outside. Nearer to the boundary every line "
            "is seen to run along the radius. Noticeable: {:.4g} mm on the robe, {:g} minute(s) of arc.",
            n.circle_share - ring_share, n.circle_share, n.criterion_mm, n.acuity_arcmin)};
        if (n.jump_mm[leftmost_fold])
            notes.push_back(fmt::format("The leftmost fold passes the centre by {} mm and jumps by {:.4g} mm, {:.3g} "
                                        "times what the eye resolves.",
                                        n.parameters.at("folds.miss_mm"), std::abs(*n.jump_mm[leftmost_fold]),
                                        std::abs(*n.jump_mm[leftmost_fold]) / n.criterion_mm));
        else
            notes.push_back("The leftmost fold is not seen on that ring: nothing can be measured there.");
        if (!fold_flip(context, miss_search(context)))
            notes.push_back("No miss of the leftmost fold within the orb makes its break as large as the eye "
                            "resolves: there is no flip point.");
        return notes;
    };
    claim.flips = [](const ClaimContext &context) {
        std::vector<FlipPoint> flips;
        if (const auto flip = fold_flip(context, miss_search(context)))
            flips.push_back({"folds.miss_mm", "mm", *flip,
                             std::stod(fold_numbers(context, {}).parameters.at("folds.miss_mm")),
                             "the leftmost fold's break is seen only where its line passes the centre by more",
                             bracket_names("folds-flip")});
        return flips;
    };
    claim.scope = [](const ClaimContext &context, const ScopeSettings &settings) {
        return std::vector{break_scope(context, settings, "greatest break of the four aimed folds", {}, aimed_folds),
                           break_scope(context, settings, "break of the leftmost fold", {}, {leftmost_fold})};
    };
    claim.mutant = Fault::wall_doubled;
    return claim;
}

} // namespace threefold
