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
};

/// Calibration first. Throws as `check` does.
std::vector<PlannedClaim> plan_of(const CheckRequest &request);

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
