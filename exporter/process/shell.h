// SPDX-License-Identifier: MIT
// Words for a shell: commands that people copy. No command of ours is ever run through one.
#pragma once

#include <string>

namespace threefold {

/// As one word of a shell command.
std::string shell_quoted(const std::string &word);

} // namespace threefold
