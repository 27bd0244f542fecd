// SPDX-License-Identifier: MIT
// The same plain words in the terminal, in JUnit and on the page.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "verifier/agreement/result.h"

namespace threefold::report {

/// Some claims are not judged yet.
bool is_running(const RunResult &result);
/// "All 4 claims hold under both presets", "1 of 4 claims fails, 1 is undecided". A claim counts once.
/// "Running: 5 of 17 claims judged".
std::string headline(const RunResult &result);
/// A mark that goes with the word and never stands for it: a tick, a cross, a question mark.
std::string_view symbol(Verdict verdict);
/// A renderer's title for its name; the name itself where the run knows no such renderer.
std::string title_of(const RunResult &result, std::string_view witness);
/// "POV-Ray", or "POV-Ray minus Cycles".
std::string title_of(const RunResult &result, const Row &row);
/// The title of an experiment of this claim; its name where it has none.
std::string experiment_title(const ClaimResult &claim, std::string_view experiment);

/// What one renderer's numbers say against the closed form; empty where it has none.
std::optional<Verdict> against_closed_form(const ClaimResult &claim, std::string_view witness);
/// What the comparisons of renderers with each other say; empty where there are none.
std::optional<Verdict> between_renderers(const ClaimResult &claim);
/// What all rows and tile comparisons say; empty where there are none.
std::optional<Verdict> of_all_rows(const ClaimResult &claim);

/// "92 %": how often a row's interval covers the true value.
std::string coverage(const Row &row);
/// "measured 1.0402 (92 % interval 1.0398 to 1.0406), expected 1.0400 within 0.004".
std::string sentence(const Row &row);
/// "worst tile (column 3, row 5) differs by 0.8 % of the mean radiance, tolerance 1 %; 1,020 tiles hold, 4 fail".
std::string sentence(const TileComparison &tiles);
/// "24 replicates would decide"; empty for a row that is decided.
std::string what_would_decide(Verdict verdict, std::optional<int> replicates);

} // namespace threefold::report
