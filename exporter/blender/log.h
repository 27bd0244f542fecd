// SPDX-License-Identifier: MIT
// What Blender prints, read line by line.
#pragma once

#include "exporter/job.h"

#include <optional>
#include <string>
#include <string_view>

namespace threefold {

/// The script counts replicates, Cycles the samples within one; `last_share` tells in which.
std::optional<double> cycles_progress(std::string_view line, double last_share, const Exported &exported);
std::string parse_blender_version(std::string_view output);
std::string explain_blender_failure(std::string_view log);

} // namespace threefold
