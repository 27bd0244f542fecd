// SPDX-License-Identifier: MIT
// One wrapper for other programs: own process group, time limit, log, progress lines, and no orphan whatever happens.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace threefold {

/// Set by the command line's signal handler: every running child is then killed and `run_child` throws
/// Error(Exit::interrupted).
extern std::atomic<bool> interrupt_requested;

struct ChildRequest {
    std::filesystem::path program;      ///< absolute
    std::vector<std::string> arguments; ///< never goes through a shell
    std::filesystem::path folder;       ///< working directory; empty: ours
    int input = -1;                     ///< descriptor that is the child's stdin, above 2; -1: it has none
    std::filesystem::path log;          ///< stdout and stderr together; empty: no log
    std::chrono::milliseconds time_limit{std::chrono::minutes(10)};
    /// Called from the waiting thread with each line of output ('\n' and '\r' both end one; empty lines are left out,
    /// and one of more than 64 KiB comes in pieces).
    std::function<void(std::string_view)> on_line;
    /// Lines for which this is true mark a moment: the first one gives `ChildResult::cpu_seconds_at_mark`. May be
    /// empty.
    std::function<bool(std::string_view)> marks;
    /// Called at each such line, before `on_line`, with what the child itself used so far. May be empty.
    std::function<void(double cpu_seconds, double peak_memory_mb)> on_mark;
    /// Once this is true the child is told to end, as when its time is over. May be empty.
    std::function<bool()> should_end;
};

struct ChildResult {
    enum class End { exited, signalled, timed_out } end = End::exited;
    int exit_code = 0;  ///< when exited
    int signal = 0;     ///< when signalled
    double seconds = 0; ///< until it ended; when timed out, until it was told to end
    double cpu_seconds = 0;
    std::optional<double> cpu_seconds_at_mark; ///< used by the child itself so far; in steps of a clock tick (10 ms)
    double peak_memory_mb = 0;

    /// "exit code 1", "killed by signal 11 (Segmentation fault)", "ran out of time after 600 s".
    std::string describe() const;
};

/// Runs and waits. Nothing that the child started in its process group outlives the call, and the child dies with us,
/// even on SIGKILL. Throws Error(input_output) when it cannot be started or its log cannot be written.
ChildResult run_child(const ChildRequest &request);

/// The absolute path of an executable file: `name` itself when it has a slash, else the first one in PATH.
std::optional<std::filesystem::path> find_program(std::string_view name);

} // namespace threefold
