// SPDX-License-Identifier: MIT
// What the commands share: lines on stderr, times.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "tools/commands.h"

namespace threefold {

void say(const std::string &line) {
    // A name may hold anything; a message stays one line.
    std::string clean = line;
    std::ranges::replace_if(
        clean, [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
    std::fputs((clean + "\n").c_str(), stderr);
}

std::chrono::milliseconds to_time_limit(double seconds) {
    if (!(seconds > 0))
        throw Error(Exit::bad_data, fmt::format("--timeout must be a positive number of seconds, not {}", seconds));
    constexpr double longest = 1e9; // some thirty years
    return std::chrono::milliseconds(static_cast<long>(std::ceil(1000 * std::min(seconds, longest))));
}

} // namespace threefold
