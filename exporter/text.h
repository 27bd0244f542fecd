// SPDX-License-Identifier: MIT
// Other people's text, made fit for a message.
#pragma once

#include <string>

namespace threefold {

/// On one line, without control characters; "unknown reason" where nothing is left.
std::string one_line(std::string text);
/// A to Z become a to z.
std::string lower_case(std::string text);

} // namespace threefold
