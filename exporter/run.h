// SPDX-License-Identifier: MIT
// An exported job, run by the real program: files out, child, pictures in.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <vector>

#include "exporter/adapter.h"
#include "exporter/image/image.h"

namespace threefold {

class Sessions;

struct InstalledRenderer {
    std::filesystem::path program;
    std::string version;
};

/// Empty when the program is not in PATH. Asks the program for its version, so takes a second or so; throws
/// Error(input_output) when it is there but cannot tell.
std::optional<InstalledRenderer> find_renderer(const Adapter &adapter);

struct RunOptions {
    std::filesystem::path folder; ///< for inputs, log and pictures; made if needed
    std::chrono::milliseconds time_limit{std::chrono::minutes(10)};
    std::function<void(double share)> on_progress; ///< called from one thread at a time
    /// Where set, a program that can renders this job after earlier ones, without a start of its own.
    Sessions *sessions = nullptr;
};

struct RunOutcome {
    std::vector<Image> images; ///< one a replicate; averaged and unscaled: radiance
    double seconds = 0;        ///< of the whole process
    double cpu_seconds = 0;
    double own_cpu_seconds = 0; ///< of rendering alone, without start-up; of the whole process where that is not told
    double peak_memory_mb = 0;
};

/// Writes the job's files only (the `export` command).
void write_exported(const Exported &exported, const std::filesystem::path &folder);

/// Throws Error(timed_out) when the program hangs; Error(input_output) when it crashes, fails, writes nothing or writes
/// a truncated picture, or one of the wrong size. The message names renderer, reason and log.
RunOutcome run_exported(const Adapter &adapter, const InstalledRenderer &installed, const Exported &exported,
                        const RenderJob &job, const RunOptions &options);

} // namespace threefold
