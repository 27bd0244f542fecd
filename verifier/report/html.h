// SPDX-License-Identifier: MIT
// report.html: one page that opens without a network and without us.
#pragma once

#include <string>

#include "verifier/agreement/result.h"

namespace threefold {

/// Style, script and pictures are inside; nothing is loaded from elsewhere, and the page forbids itself to. All text of
/// the result is escaped. Without JavaScript everything can be read; with it, pictures can be flipped.
std::string to_html(const RunResult &result);

} // namespace threefold
