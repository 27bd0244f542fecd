// SPDX-License-Identifier: MIT
// From claims to verdicts: build the scenes, predict, render with every witness, measure, judge.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scenes/error.h"
#include "verifier/agreement/result.h"
#include "verifier/check/run_progress.h"
#include "verifier/claims/claim.h"
#include "verifier/witness/witness.h"

namespace threefold {

struct CheckRequest {
    std::vector<Claim> claims; ///< calibration is put first if it is not among them
    std::vector<Witness> witnesses;
    std::vector<SceneRecipe> scenes;
    std::vector<Preset> presets{Preset::text}; ///< every claim is judged under each
    std::vector<Assignment> assignments;
    bool quick = false;
    int least_replicates = 0; ///< of every experiment that has more than one, where its claim has fewer
    std::uint64_t seed = 1;
    std::map<std::string, std::uint64_t> seeds; ///< by witness name, in place of `seed`
    int threads = 0;                            ///< cores to use at once by all renderers together; 0: all
    /// Noise of the mean picture of every experiment that is a mean over pixels, relative RMS: each renderer's samples
    /// are chosen by it. Pictures that are compared tile by tile never get more noise than their tiles' budget allows,
    /// those that numbers are read from never fewer samples than their claim asks. Empty: the claims' own samples.
    std::optional<double> tolerance;
    TracerSettings tracer;
    std::chrono::milliseconds time_limit{std::chrono::minutes(10)};
    std::filesystem::path folder;
    std::map<std::string, InjectedFault> injected; ///< by witness name
    OnProgress on_progress;
    /// A claim is concluded: it, and the run so far. From the thread that called `check`.
    std::function<void(const ClaimResult &claim, const RunResult &so_far)> on_claim;
};

struct CheckOutcome {
    RunResult result;
    Exit exit = Exit::holds;
};

/// Throws Error(usage) for an assignment that no scene of the claims has, Error(bad_data) for a scene without meaning:
/// both before anything is rendered. What goes wrong with one renderer is told in the result and does not stop the
/// others.
CheckOutcome check(const CheckRequest &request);

} // namespace threefold
