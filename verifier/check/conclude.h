// SPDX-License-Identifier: MIT
// From judged numbers and pictures to the verdict of a claim, and from claims to that of the run.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "verifier/agreement/result.h"
#include "verifier/check/plan.h"

namespace threefold {

/// What a claim concludes from its rows and tiles, which `result` has already. `complete`: every renderer
/// gave all its pictures. A renderer with a problem does not count, unless the claim is the calibration.
void conclude_claim(const PlannedClaim &planned, const std::vector<WitnessRecord> &renderers, bool complete,
                    ClaimResult &result);
/// Name, statement and preset.
ClaimResult result_of(const PlannedClaim &planned);
/// A claim that these values leave no scene.
ClaimResult claim_without_scene(const PlannedClaim &planned);

/// Which renderers are calibrated, from all calibrations so far; the others get a problem. `left_out`: names of those
/// that cannot be used for another reason.
void apply_calibrations(const std::vector<ClaimResult> &calibrations, const std::set<std::string> &left_out,
                        std::vector<WitnessRecord> &renderers);

/// Verdict and summary of the whole run. `refusals`: what a renderer, or a claim, could not do.
void conclude_run(RunResult &result, const std::vector<std::string> &refusals);

} // namespace threefold
