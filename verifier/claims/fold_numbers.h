// SPDX-License-Identifier: MIT
// What the closed form says of the scene `folds` at a run's own parameters, and where a break reaches what the eye
// resolves. Lengths in millimetres on the robe. Shared by the claims about folds.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "verifier/claims/claim.h"
#include "verifier/claims/fold_jump.h"

namespace threefold {

/// Folds are numbered from the left, from 0. The first is not aimed at the orb's centre, the others are.
inline constexpr std::size_t leftmost_fold = 0;
inline const std::vector<std::size_t> aimed_folds{1, 2, 3, 4};
inline constexpr double ring_share = 0.05; ///< of the radius: a jump is the mean over the ring that ends at the circle

/// "the leftmost fold", "fold 2".
std::string name_of_fold(std::size_t fold);

std::vector<Assignment> joined(std::vector<Assignment> first, const std::vector<Assignment> &then);
/// The middles of `count` equal steps.
std::vector<double> even_steps(double from, double to, int count);

/// The scene `folds` with its flat robe, so wide that every bent ray of interest still meets it.
Experiment fold_setup(const ClaimContext &context, const std::string &name, const std::string &title,
                      const std::vector<Assignment> &defaults, const std::vector<Assignment> &fixed);
double eye_to_robe_mm(const Experiment &e);
/// Impact parameters of the circles on which a jump is read.
std::vector<double> fold_circles_mm(const Experiment &e);

struct FoldNumbers {
    std::vector<std::optional<double>> jump_mm; ///< signed, by fold; empty where the fold is not seen on the circles
    double criterion_mm = 0;                    ///< what the acuity covers on the robe, straight ahead
    double acuity_arcmin = 0;
    double circle_share = 0; ///< of the radius: where the ring ends, on which jumps are read
    optics::Orb<double> orb{};
    double eye_mm = 0; ///< to the orb's centre
    double eye_to_robe_mm = 0;
    std::map<std::string, std::string> parameters; ///< of the scene
};

/// `eye_aside_mm`: as a pinhole sees it that stands so far to image right and up of the eye.
FoldNumbers fold_numbers(const ClaimContext &context, const std::vector<Assignment> &fixed,
                         Vec2 eye_aside_mm = Vec2(0));

/// Greatest absolute jump among the folds; NaN when one of them is not seen.
double greatest_jump_mm(const FoldNumbers &numbers, const std::vector<std::size_t> &folds);
/// The one with the greatest absolute jump.
std::size_t most_broken_fold(const FoldNumbers &numbers, const std::vector<std::size_t> &folds);

/// Over which parameter a flip is looked for: where the greatest jump of some folds reaches the criterion.
struct FoldSearch {
    std::string parameter;
    std::vector<Assignment> fixed{};
    std::vector<std::size_t> folds{};
    double low = 0, high = 0; ///< from the side where nothing is noticed; high may lie below low
    int steps = 24;
    bool by_factors = false; ///< equal factors instead of even steps
};

std::optional<double> fold_flip(const ClaimContext &context, const FoldSearch &search);
/// The two renders beside it, named `stem`-below and `stem`-above.
std::vector<Experiment> fold_brackets(const ClaimContext &context, const FoldSearch &search, const std::string &stem,
                                      double flip);
std::vector<std::string> bracket_names(const std::string &stem);

/// The first value at which f changes its sign on a grid from `low` to `high` (which may lie below it): even, or by
/// equal factors.
std::optional<double> first_root(const std::function<double(double)> &f, double low, double high, int steps,
                                 bool by_factors);

} // namespace threefold
