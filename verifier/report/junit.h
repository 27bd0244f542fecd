// SPDX-License-Identifier: MIT
// JUnit XML, which continuous integration systems show: a suite a claim, a case a row and a tile comparison.
#pragma once

#include <string>

#include "verifier/agreement/result.h"

namespace threefold {

/// Undecided is <skipped> with what would decide it, not <error>: systems count errors among the failures, and red is
/// kept for evidence against a claim, while a skipped case is listed apart with its message and never counts as passed.
/// Who wants an undecided run to stop a pipeline has the exit code 2. A renderer that is missing or had no vote is a
/// skipped case of the suite "renderers".
std::string to_junit(const RunResult &result);

} // namespace threefold
