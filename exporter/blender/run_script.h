// SPDX-License-Identifier: MIT
// A script in the installed Blender, for exports that only Blender itself can write.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "exporter/run.h"

namespace threefold {

struct BlenderScript {
    std::filesystem::path folder;              ///< holds the script, and becomes the working directory
    std::string name;                          ///< of the script's file
    std::optional<std::filesystem::path> file; ///< a .blend to open first
    std::string last_words;                    ///< a line that the script prints when all went well; empty: none
    std::chrono::milliseconds time_limit{std::chrono::minutes(10)};
};

/// No settings of the user's, no scripts in files. Throws Error(timed_out), or Error(input_output) with Blender's own
/// reason.
void run_in_blender(const InstalledRenderer &blender, const BlenderScript &script);

/// The installed Blender; Error(renderer_missing) without one.
InstalledRenderer require_blender();

} // namespace threefold
