// SPDX-License-Identifier: MIT
// How much of an experiment one renderer is to render at once: some of its replicates, with how many samples.
#pragma once

#include <optional>
#include <vector>

#include "verifier/claims/claim.h"
#include "verifier/tolerance/tile_noise.h"
#include "verifier/tolerance/tolerance.h"
#include "verifier/witness/witness.h"

namespace threefold {

struct Look {
    const Experiment *experiment;
    int first = 0, replicates = 0; ///< from number `first` up to, not including, `replicates`
    std::uint64_t seed = 1;
    const InjectedFault *fault = nullptr;
    std::optional<int> samples_per_pixel{}; ///< empty: the experiment's own

    RenderJob job() const;
    /// Seconds or so, for the progress: to start a program, and the rays of its picture.
    double work() const;
};

/// How many replicates a first look takes. Most numbers lie so far from the edge of their tolerance that a few
/// replicates decide them; the rest get a second look. A pair of pictures gets none, and where noise decides whether
/// tiles agree, few replicates would take more samples in all: these begin with the experiment's own number, and so do
/// pictures whose replicates are compared in pairs. `all`: the experiments of its claim.
int first_replicates(const Witness &w, const Experiment &e, const std::vector<Experiment> &all);

/// What noise the first look's mean may have, under a tolerance that the user named; empty where that has no say.
std::optional<NoiseWanted> noise_wanted(const Witness &w, const Experiment &e, std::optional<double> tolerance);
/// Where a share of the tiles decides, their noise differs too much for a number of samples fixed beforehand.
std::optional<TilesWanted> tiles_wanted(const Witness &w, const Experiment &e);

} // namespace threefold
