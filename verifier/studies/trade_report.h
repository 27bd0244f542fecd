// SPDX-License-Identifier: MIT
// The trade study as JSON (docs/RESULT_SCHEMA.md), CSV, a page of Markdown that reads as tables in a terminal too, and
// one HTML file that opens offline.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "verifier/studies/trade.h"

namespace threefold {

nlohmann::ordered_json to_json(const TradeResult &result);
/// One line a setting; numbers with all digits that mean something.
std::string to_csv(const TradeResult &result);
std::string to_markdown(const TradeResult &result);
std::string to_text(const TradeResult &result);
std::string to_html(const TradeResult &result);

/// The work-precision diagram, log-log: relative RMS error over CPU seconds, of rendering alone or of whole processes.
std::string work_precision_svg(const TradeResult &result, bool whole_processes);

/// One sentence a renderer and tolerance, and the ratios of the times to our tracer's.
std::vector<std::string> answers(const TradeResult &result);
/// What is written of a row's knob: "truncation 3.1e-4 from cut 1e-06, ...".
std::vector<std::vector<std::string>> settings_table(const TradeResult &result);
std::vector<std::vector<std::string>> parts_table(const TradeResult &result);

} // namespace threefold
