// SPDX-License-Identifier: MIT
// A picture of the scene `folds` that is made to measure: where the folds' edges run on stated circles inside and
// outside the orb's boundary, their jumps, and what the closed form says of them. Shared by the claims about folds.
#pragma once

#include <string>
#include <vector>

#include "verifier/claims/claim.h"

namespace threefold {

/// Something to be asserted of the greatest jump (absolute, mm on the robe) among some folds.
struct FoldConclusion {
    std::string quantity;
    std::vector<std::size_t> folds;
    Relation relation;
    double value_mm;
};

struct FoldPlan {
    std::string name, title;
    std::vector<Assignment> defaults{}, fixed{}; ///< on top of what the measuring needs
    double radius_px = 160;                      ///< of the orb in the picture
    std::vector<std::size_t> folds{0, 1, 2, 3, 4};
    int samples_per_pixel = 25;
    bool rows = true;        ///< each fold's jump is a row; else only the conclusions are
    bool pixel_rows = false; ///< also in pixels of the picture
    std::vector<FoldConclusion> conclusions{};
};

Experiment fold_experiment(const ClaimContext &context, const FoldPlan &plan);

} // namespace threefold
