// SPDX-License-Identifier: MIT
// Our own witness: the scene as it stands, traced in this process. Knows nothing of the closed forms in optics/.
#pragma once

#include <functional>
#include <vector>

#include "exporter/image/image.h"
#include "exporter/job.h"
#include "verifier/tracer/sampler.h"

namespace threefold {

/// Arithmetic of a ray's way through glass. `single_precision` is Embree's own.
enum class Precision { single_precision, double_precision };

/// `tree`: all branches, merged, until the weight left inside an orb is below the job's cut_weight.
/// `roulette`: branches lighter than `roulette_weight` go on at random; nothing is dropped, some noise is added.
enum class Transport { tree, roulette };

struct TracerSettings {
    Precision precision = Precision::double_precision;
    Transport transport = Transport::tree;
    double roulette_weight = 1e-2;
    Sampler sampler = Sampler::sobol;
};

struct TracerOutcome {
    std::vector<Image> images;          ///< one a replicate
    double missing_weight_mean = 0;     ///< weight of the dropped branches, mean over all pixels and replicates
    double missing_weight_greatest = 0; ///< and of the worst pixel
    double seconds = 0, cpu_seconds = 0;
    double set_up_cpu_seconds = 0; ///< part of cpu_seconds: before the first ray
};

/// Throws Error(bad_data) for what this tracer cannot do (caustics, an environment that lights a diffuse surface).
/// The same picture for any number of threads.
TracerOutcome trace(const RenderJob &job, const TracerSettings &settings = {},
                    const std::function<void(double share)> &on_progress = {});

Accuracy tracer_accuracy(const RenderJob &job, const TracerSettings &settings);

} // namespace threefold
