// SPDX-License-Identifier: MIT
// result.json: everything a run found, for scripts. docs/RESULT_SCHEMA.md describes it field by field.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "verifier/agreement/result.h"

namespace threefold {

/// Keys are in a fixed order and the same result gives the same text. Numbers that are not finite are null; text is
/// valid UTF-8. Pictures are named, not embedded.
nlohmann::ordered_json to_json(const RunResult &result);

} // namespace threefold
