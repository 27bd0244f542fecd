// SPDX-License-Identifier: MIT
// The scope study for the terminal, as JSON (docs/RESULT_SCHEMA.md) and as a page of Markdown (docs/SCOPE.md).
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "verifier/studies/scope.h"

namespace threefold {

nlohmann::ordered_json to_json(const ScopeResult &result);
std::string to_markdown(const ScopeResult &result);
/// A table a claim: each effect by the number that it moves most; with `every_number`, by every number.
std::string to_text(const ScopeResult &result, bool every_number);

} // namespace threefold
