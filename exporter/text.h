// SPDX-License-Identifier: MIT
// Other people's text, made fit for a message.
#pragma once

#include <string>

namespace threefold {

/// On one line, without control characters and without blanks at the end; of nothing, nothing.
std::string one_line(std::string text);
/// The same of what a program or a library says went wrong; "unknown reason" where it says nothing.
std::string reason(std::string text);
/// A to Z become a to z.
std::string lower_case(std::string text);

} // namespace threefold
