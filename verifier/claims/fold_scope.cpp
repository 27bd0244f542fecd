// SPDX-License-Identifier: MIT
#include "verifier/claims/fold_scope.h"

#include <cmath>
#include <limits>

#include "verifier/claims/scope_bounds.h"

namespace threefold {

namespace {

double jump_or_nan(const FoldNumbers &n, std::size_t fold) {
    return n.jump_mm[fold].value_or(std::numeric_limits<double>::quiet_NaN());
}

/// The greater of two bounds; what could not be told is the greatest.
void keep_greater(Bound &bound, const Bound &other) {
    if (!(other.value <= bound.value)) bound = other;
}

} // namespace

ScopeNumber break_scope(const ClaimContext &context, const ScopeSettings &settings, const std::string &quantity,
                        const std::vector<Assignment> &fixed, const std::vector<std::size_t> &folds) {
    const FoldNumbers here = fold_numbers(context, fixed);
    const double greatest = greatest_jump_mm(here, folds);
    Bound dispersion(0, ""), birefringence(0, ""), pupil(0, "");
    for (const std::size_t fold : folds) { // signed, so that a mean over the pupil is that of the fold's places
        const IndexBounds index = by_index(here.orb.index, settings, [&](double n) {
            return jump_or_nan(fold_numbers(context, joined(fixed, {assign("glass.index", n)})), fold);
        });
        const Bound aside =
            by_pupil(settings, [&](Vec2 beside) { return jump_or_nan(fold_numbers(context, fixed, beside), fold); });
        const bool first = fold == folds.front();
        if (first) dispersion = index.dispersion, birefringence = index.birefringence, pupil = aside;
        keep_greater(dispersion, index.dispersion);
        keep_greater(birefringence, index.birefringence);
        keep_greater(pupil, aside);
    }
    return {quantity,
            "mm",
            greatest,
            margin_to(greatest, {here.criterion_mm}),
            margin_words({here.criterion_mm}, "mm"),
            of_directions(fold_setup(context, "", "", {}, fixed).scene, {dispersion, birefringence}, pupil)};
}

} // namespace threefold
