// SPDX-License-Identifier: MIT
// What a run has to do, known before anything is rendered: the experiments of every claim under every preset, and the
// job that each makes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "verifier/check/check.h"

namespace threefold {

inline constexpr std::string_view calibration_name = "calibration";

struct PlannedClaim {
    const Claim *claim;
    ClaimContext context;
    std::vector<Experiment> experiments;
    std::string problem{}; ///< why these values leave it no scene; then it has no experiments
};

/// Calibration first. A claim that has no scene with these values is left out, with its problem; where that is every
/// claim, or a value is wrong in itself, it throws as `check` does.
std::vector<PlannedClaim> plan_of(const CheckRequest &request);

/// Names of the request's values that some of the claim's scenes have as a parameter, and none has as asked.
std::vector<std::string> unused_values(const PlannedClaim &planned);

std::vector<Replicate> replicates_of(const Experiment &e, std::uint64_t seed);
Camera camera_of(const Experiment &e, const Replicate &replicate);
RenderJob job_of(const Experiment &e, std::uint64_t seed, int threads);

/// What each renderer is asked, in the run's order: the label of an experiment and its job.
struct PlannedJob {
    std::string claim, label;
    RenderJob job;
};
/// Of all experiments that need a picture, `request.injected` and `witnesses` left out. Throws as `check` does.
std::vector<PlannedJob> planned_jobs(const CheckRequest &request);

} // namespace threefold
