// SPDX-License-Identifier: MIT
// A picture within a tolerance, by a pilot on the very scene: nothing is learnt beforehand, so there is no scene that
// it was not learnt on. A few samples, twice over, give the law of the noise (variance = factor / samples^rate, with
// the rate of this renderer's own sampler on this scene); the systematic error is bounded by the weight that our tracer
// dropped, and measured for other renderers against a picture of our tracer. Samples are chosen, the picture is made
// from independent parts, and its error is stated by what was measured on itself, not by the law: an estimate, and a
// bound that holds with a confidence of 95 % however many attempts it took (error_bound.h). The bound decides.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <string>

#include "verifier/agreement/error_split.h"
#include "verifier/tolerance/setting.h"

namespace threefold {

struct ToleranceRequest {
    double tolerance = 1e-2; ///< RMS over pixels and channels, over the mean radiance
    std::uint64_t seed = 1;
    int threads = 0;
    std::filesystem::path folder;
    std::string label;
    std::chrono::milliseconds time_limit{std::chrono::hours(1)};
    std::function<void(double share, const std::string &now)> on_progress; ///< may be empty
};

struct WithinTolerance {
    Rendered rendered; ///< one picture, the mean of the parts; the record is that of the last render
    Setting setting;   ///< of one part
    std::string description;
    double error = 0;       ///< relative RMS, estimated on this very picture
    double error_upper = 0; ///< not exceeded, with a confidence of 95 %
    double noise = 0, systematic = 0;
    bool systematic_is_bound = false; ///< else measured against the reference
    std::string reference;            ///< empty where none was needed
    bool met = false;
    double cpu_seconds = 0; ///< pilots, reference and picture
};

WithinTolerance render_within(const Witness &witness, const Scene &scene, const ToleranceRequest &request);

/// How the noise of a job's picture falls with its samples, from four pictures with few.
struct NoisePilot {
    NoiseLaw law; ///< of the relative variance of one picture, by RenderJob's samples
    double mean_radiance = 0;
    double cpu_seconds = 0;
};
NoisePilot pilot_noise(const Witness &witness, RenderJob job, int few_samples, const RenderOptions &options);

/// What noise the mean picture of a job may have.
struct NoiseWanted {
    double relative = 1e-2;                                    ///< RMS over the mean radiance
    double absolute = std::numeric_limits<double>::infinity(); ///< RMS, in radiance: the lesser of both counts
    int least_samples = 1;
};
/// RenderJob's samples for it, by a pilot.
int samples_for_noise(const Witness &witness, const RenderJob &job, const NoiseWanted &wanted,
                      const RenderOptions &options);

/// Few samples for a pilot: fewer where each costs more.
int pilot_samples(const Witness &witness);

} // namespace threefold
