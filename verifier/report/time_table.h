// SPDX-License-Identifier: MIT
// Where a run's time went: CPU seconds by experiment and renderer.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "verifier/agreement/result.h"

namespace threefold::report {

struct RendererTime {
    double cpu_seconds = 0; ///< whole processes, all renders of this run; 0 where the pictures were kept from before
    double own_cpu_seconds = 0; ///< of rendering alone, without start-up
    int replicates = 0;
    int samples_per_pixel = 0;
};

struct ExperimentTime {
    std::string experiment, preset;
    std::map<std::string, RendererTime> renderers; ///< by name
    double cpu_seconds() const;
};

/// In the order of the run.
std::vector<ExperimentTime> times_of(const RunResult &result);

/// Lines of text: the longest experiments first, then a line for all.
std::string time_table(const RunResult &result);

} // namespace threefold::report
