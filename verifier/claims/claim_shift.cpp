// SPDX-License-Identifier: MIT
// "Move the orb 1 cm against the robe, and the folds break" (figure 6B of the study). Its text moves the orb to the
// left, its published files move the robe to the right: each preset moves what the study moved.
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "verifier/claims/claim.h"
#include "verifier/claims/fold_experiment.h"
#include "verifier/claims/fold_numbers.h"
#include "verifier/claims/fold_scope.h"

namespace threefold {

namespace {

constexpr double study_shift_mm = 10, greatest_shift_mm = 20;
constexpr double search_share = 0.5; ///< of the radius: as far as a flip is looked for

struct Axis {
    std::string parameter;
    double sign;
    std::string what;
};

Axis axis_of(const ClaimContext &context) {
    return context.preset == Preset::text ? Axis{"orb.shift_mm", -1, "the orb moved to the left"}
                                          : Axis{"robe.shift_mm", 1, "the robe moved to the right"};
}

std::vector<Assignment> shifted(const ClaimContext &context, double shift_mm) {
    const Axis axis = axis_of(context);
    return {assign(axis.parameter, axis.sign * shift_mm + 0.0)};
}

FoldNumbers numbers_at(const ClaimContext &context, double shift_mm) {
    return fold_numbers(context, shifted(context, shift_mm));
}

/// The aimed fold that a shift breaks most.
std::size_t watched_fold(const ClaimContext &context) {
    return most_broken_fold(numbers_at(context, study_shift_mm), aimed_folds);
}

std::vector<double> shifts_mm(bool quick) {
    if (quick) return {0, 10, 20};
    return {0, 2.5, 5, 10, 15, greatest_shift_mm};
}

FoldSearch shift_search(const ClaimContext &context) {
    const Axis axis = axis_of(context);
    FoldSearch search;
    search.parameter = axis.parameter;
    search.folds = aimed_folds;
    search.high = axis.sign * search_share * numbers_at(context, 0).orb.outer_mm;
    search.steps = 32;
    return search;
}

/// In the study's direction, or else in the other.
std::optional<double> shift_flip(const ClaimContext &context) {
    FoldSearch search = shift_search(context);
    if (const auto flip = fold_flip(context, search)) return flip;
    search.high = -search.high;
    return fold_flip(context, search);
}

Experiment at_shift(const ClaimContext &context, double shift_mm, std::size_t fold) {
    FoldPlan plan;
    plan.name = fmt::format("shift-{:g}", shift_mm);
    plan.title =
        fmt::format("{} of the aimed folds, {} by {:g} mm", name_of_fold(fold), axis_of(context).what, shift_mm);
    plan.fixed = shifted(context, shift_mm);
    plan.folds = {fold};
    plan.radius_px = context.quick ? 200 : 280;
    const double criterion = numbers_at(context, shift_mm).criterion_mm;
    if (shift_mm == 0)
        plan.conclusions = {{"break in line is less than the eye resolves", {fold}, Relation::below, criterion}};
    if (shift_mm == study_shift_mm)
        plan.conclusions = {{"break at 10 mm is more than the eye resolves", {fold}, Relation::above, criterion}};
    return fold_experiment(context, plan);
}

} // namespace

Claim claim_shift() {
    Claim claim;
    claim.name = "shift";
    claim.statement = "The folds cross the orb's boundary unbroken only while orb and robe are in line with the eye: "
                      "moved 10 mm against each other, they break so far that the eye sees it.";
    claim.experiments = [](const ClaimContext &context) {
        std::vector<Experiment> all;
        const std::size_t fold = watched_fold(context);
        for (const double shift : shifts_mm(context.quick)) all.push_back(at_shift(context, shift, fold));
        const FoldSearch search = shift_search(context);
        if (const auto flip = shift_flip(context))
            for (Experiment &e : fold_brackets(context, search, "shift-flip", *flip)) all.push_back(std::move(e));
        return all;
    };
    claim.summary = [](const ClaimContext &context, Verdict verdict) -> std::string {
        switch (verdict) {
        case Verdict::holds: {
            const FoldNumbers n = numbers_at(context, study_shift_mm);
            return fmt::format("In line, the aimed folds run through the boundary without a break; with {} by 10 mm "
                               "they break by {:.3g} mm, {:.3g} times what the eye resolves.",
                               axis_of(context).what, greatest_jump_mm(n, aimed_folds),
                               greatest_jump_mm(n, aimed_folds) / n.criterion_mm);
        }
        case Verdict::fails:
            return "In this scene, or in some renderer, the folds break when in line or stay whole when 10 mm out of "
                   "line.";
        case Verdict::undecided:
            return "The renders do not settle how a shift breaks the folds.";
        }
        return "";
    };
    claim.notes = [](const ClaimContext &context) {
        std::vector<std::string> breaks;
        for (const double shift : shifts_mm(false)) {
            const double jump = greatest_jump_mm(numbers_at(context, shift), aimed_folds);
            breaks.push_back(std::isnan(jump) ? fmt::format("{:g} mm: a fold is not seen on the ring", shift)
                                              : fmt::format("{:g} mm: {:.3g} mm", shift, jump < 1e-9 ? 0 : jump));
        }
        std::vector<std::string> notes{
            fmt::format("Greatest break of the aimed folds by the closed form, {} by: {}.", axis_of(context).what,
                        fmt::join(breaks, ", ")),
            "The study's text moves the orb to the left, its published files move the robe to the right; the break "
            "differs, since a shift of the orb shows enlarged on the robe behind it. Each preset moves what the study "
            "moved there."};
        if (!shift_flip(context))
            notes.push_back("No shift within half the orb's radius, to either side, takes the break across what the "
                            "eye resolves: there is no flip point.");
        return notes;
    };
    claim.flips = [](const ClaimContext &context) {
        const Axis axis = axis_of(context);
        std::vector<FlipPoint> flips;
        if (const auto flip = shift_flip(context))
            flips.push_back(
                {axis.parameter, "mm", *flip, std::stod(fold_numbers(context, {}).parameters.at(axis.parameter)),
                 fmt::format("{} by more, some aimed fold's break is seen", axis.what), bracket_names("shift-flip")});
        return flips;
    };
    claim.scope = [](const ClaimContext &context, const ScopeSettings &settings) {
        const std::vector<std::size_t> fold{watched_fold(context)};
        return std::vector{
            break_scope(context, settings, "break of an aimed fold in line", shifted(context, 0), fold),
            break_scope(context, settings, "break of an aimed fold at 10 mm", shifted(context, study_shift_mm), fold)};
    };
    claim.mutant = Fault::wall_doubled;
    return claim;
}

} // namespace threefold
