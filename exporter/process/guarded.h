// SPDX-License-Identifier: MIT
// A function run in a child process, because what it calls may abort, loop or take all memory on bad input.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

namespace threefold {

struct GuardedRequest {
    std::function<std::string()> work; ///< runs in the child; an exception's text is the failure
    std::chrono::milliseconds time_limit{std::chrono::minutes(10)}; ///< on the clock: other programs may be busy
    std::chrono::seconds work_limit{120};                           ///< of its own computing
    std::int64_t memory_bytes = std::int64_t{6} << 30; ///< beyond what this process has; never over half the machine's
};

struct GuardedResult {
    bool succeeded = false;
    std::string bytes;   ///< what `work` returned
    std::string failure; ///< one line that goes on after "because", if it did not
};

/// Runs and waits; nothing of the child outlives the call, nor us. Its stdout and stderr go nowhere. Throws
/// Error(interrupted), and Error(input_output) when no process can be made.
GuardedResult run_guarded(const GuardedRequest &request);

} // namespace threefold
