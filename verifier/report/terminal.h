// SPDX-License-Identifier: MIT
// What `check` prints on stdout.
#pragma once

#include <string>

#include "verifier/agreement/result.h"

namespace threefold {

/// The verdict in plain words, a line a claim with its verdict per renderer, and every row that does not hold with its
/// numbers; a claim judged under both presets is told once, with what was found under each; verbosity 1 adds the rows
/// that hold, verbosity -1 leaves the verdict and a line a claim. A verdict is a word and a symbol, never colour alone;
/// without `colour` there is no escape code, whatever names hold.
std::string to_text(const RunResult &result, bool colour, int verbosity);

/// One claim's verdict as a line without its end, for while the run goes on. `with_preset` names the preset.
std::string to_line(const ClaimResult &claim, bool colour, bool with_preset);

} // namespace threefold
