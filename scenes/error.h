// SPDX-License-Identifier: MIT
// One exception type for a broken world (bad input, a missing program, a full disk). Verdicts are values, not errors.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace threefold {

/// Exit codes of the command line; scripts rely on them.
enum class Exit : int {
    holds = 0,
    fails = 1,
    undecided = 2,
    usage = 64,
    bad_data = 65,
    renderer_missing = 69,
    internal = 70,
    input_output = 74,
    timed_out = 124,
    interrupted = 130,
};

/// `what()` is one line that says what is wrong and where; `hint` says what to try (may be empty).
class Error : public std::runtime_error {
public:
    Error(Exit code, const std::string &what, std::string hint = {})
        : std::runtime_error(what), code_(code), hint_(std::move(hint)) {}

    Exit code() const noexcept { return code_; }
    const std::string &hint() const noexcept { return hint_; }

private:
    Exit code_;
    std::string hint_;
};

} // namespace threefold
