// SPDX-License-Identifier: MIT
// The power study: which known faults does our check catch, which do others' image comparisons, how small a fault is
// still caught, and how often is an honest renderer accused? The fault is put into one renderer (our tracer: it takes
// every fault); the others stay honest, and their pictures come from the cache in the study's folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "verifier/claims/claim.h"
#include "verifier/studies/image_judges.h"
#include "verifier/studies/smallest_fault.h"
#include "verifier/witness/witness.h"

namespace threefold {

struct PowerRequest {
    std::vector<Claim> claims; ///< our check: the same claims for every fault
    std::vector<SceneRecipe> scenes;
    std::vector<Witness> witnesses; ///< the faulty one among them
    std::string faulty = "tracer";
    std::vector<Fault> faults; ///< rows of the table
    bool quick = false;        ///< a coarser search for the smallest fault, and no renders at flip points
    int runs = 40;             ///< without a fault
    std::uint64_t seed = 1;
    int threads = 0;
    /// In single precision, as other renderers compute: in double its tolerances are so narrow that no fault is too
    /// small.
    TracerSettings tracer{Precision::single_precision};
    std::chrono::milliseconds time_limit{std::chrono::minutes(10)};
    std::filesystem::path folder;
    std::function<void(double share, const std::string &now)> on_progress; ///< may be empty
};

/// What the image judges said of one picture scene.
struct PictureJudgement {
    std::string scene;
    ImageJudgement idiff, rms, z_test;
};

struct PowerRow {
    InjectedFault fault;
    Verdict verdict = Verdict::undecided; ///< of the whole check
    std::vector<std::string> caught_by;   ///< claims that fail with the fault and not without it
    std::vector<PictureJudgement> pictures;
    std::optional<SmallestFault> smallest; ///< once for faults that differ in their size alone

    bool caught() const { return !caught_by.empty(); }
};

/// Of runs without a fault.
struct FalseAlarms {
    /// What the rate of false alarms is under, with 95 % confidence (Clopper and Pearson 1934, one-sided), when
    /// `alarms` of `runs` were such; 1 where there was no run.
    static double upper_bound(int alarms, int runs);

    int runs = 0;
    int ours = 0, undecided = 0, idiff = 0, rms = 0, z_test = 0;
    std::vector<std::string> failing_claims; ///< one entry an alarm and claim
};

struct PowerResult {
    static constexpr int schema_version = 1;
    std::string threefold_version, command, started;
    std::string faulty;                                        ///< title of the renderer with the fault
    std::string precision;                                     ///< of the tracer: "float" or "double"
    std::vector<std::pair<std::string, std::string>> versions; ///< libraries and renderers
    std::vector<std::string> witnesses, claims, picture_scenes;
    bool quick = false;
    double resolution = 1; ///< of the smallest sizes, a factor
    Verdict honest = Verdict::undecided;
    std::vector<std::string> honest_failures; ///< claims that fail without a fault: they catch nothing
    std::vector<PowerRow> rows;
    FalseAlarms false_alarms;
    int evaluations = 0; ///< checks made in all
    double seconds = 0;

    static constexpr double most_false_alarms = 0.05;
    /// `holds`: every fault is caught, and at most 5 % of the honest runs fail.
    Verdict verdict() const;
};

/// Throws Error like `check` does.
PowerResult study_power(const PowerRequest &request);

} // namespace threefold
