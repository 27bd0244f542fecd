// SPDX-License-Identifier: MIT
// Which setting should meet a tolerance at the least cost? A model of a sweep: what is systematic is measured at each
// setting of the other knobs, the samples follow a law, and time is proportional to the samples.
#pragma once

#include <functional>
#include <vector>

#include "verifier/agreement/error_split.h"
#include "verifier/tolerance/setting.h"

namespace threefold {

/// A setting of all knobs but the samples.
struct SystemModel {
    Setting setting;
    double bias2 = 0;          ///< relative, not negative
    double variance_ratio = 1; ///< of its noise to the law's
    double own_s_per_sample = 0, start_s = 0;
};

struct RendererModel {
    NoiseLaw noise;
    std::vector<SystemModel> systems;
};

struct Candidate {
    Setting setting;
    double bias2 = 0, predicted = 0; ///< error
    double own_s = 0, process_s = 0;
};

/// All that should meet the tolerance, the cheapest first; `round_up` gives the samples that the renderer really has.
/// Of the square of the tolerance a fifth is left for what the model does not know.
std::vector<Candidate> candidates_for(const RendererModel &model, double tolerance,
                                      const std::function<int(double)> &round_up);

/// The same system with so many more samples that its noise, as it was measured, leaves the tolerance room; nothing
/// where its bias alone is too large.
///
/// A bias that is not told from zero may be chance: then the sweep's word stands, and the rest of the error is noise.
std::optional<Candidate> with_more_samples(const Candidate &candidate, const ErrorSplit &measured, double tolerance,
                                           double rate, const std::function<int(double)> &round_up);

/// The same system with as many fewer samples as a measured error well within the tolerance allows; nothing where a
/// fifth cannot be saved.
std::optional<Candidate> with_fewer_samples(const Candidate &candidate, const ErrorSplit &measured, double tolerance,
                                            double rate, const std::function<int(double)> &round_up);

/// What a candidate that was rendered says of the others of its renderer: how many times the noise that was foretold,
/// at least once. They look through the same pixels, so theirs is as much larger.
double noise_beyond_law(const Candidate &candidate, const ErrorSplit &measured);
Candidate with_noise_beyond_law(const Candidate &candidate, double times, double rate,
                                const std::function<int(double)> &round_up);

} // namespace threefold
