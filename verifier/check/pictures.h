// SPDX-License-Identifier: MIT
// The pictures of one experiment: shown beside each other, and compared tile by tile where the claim says so.
#pragma once

#include <vector>

#include "verifier/agreement/result.h"
#include "verifier/check/rows.h"
#include "verifier/claims/claim.h"

namespace threefold {

/// Every two renderers' replicates; empty without `e.tile_budget`. `level`: of each tile's test.
std::vector<TileComparison> compared_pictures(const Experiment &e, const std::vector<Testimony> &testimonies,
                                              double level);

/// Each renderer's mean picture, then the differences of those that were compared.
std::vector<ReportPicture> report_pictures(const Experiment &e, const std::vector<Testimony> &testimonies,
                                           const std::vector<TileComparison> &compared);

} // namespace threefold
