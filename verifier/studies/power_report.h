// SPDX-License-Identifier: MIT
// The power study as JSON (docs/RESULT_SCHEMA.md) and as a page of Markdown, which reads as a table in a terminal too.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "verifier/studies/power.h"

namespace threefold {

nlohmann::ordered_json to_json(const PowerResult &result);
/// The whole page.
std::string to_markdown(const PowerResult &result);
/// Its two tables and the verdict.
std::string to_text(const PowerResult &result);

} // namespace threefold
