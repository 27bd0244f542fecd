// SPDX-License-Identifier: MIT
// The extremes study as text, as JSON (docs/RESULT_SCHEMA.md), as a page of Markdown, and as a picture.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "verifier/studies/extremes.h"

namespace threefold {

nlohmann::ordered_json to_json(const ExtremesResult &result);
/// A table a sweep, one line a point, and what is at fault.
std::string to_text(const ExtremesResult &result);
/// The whole page; `picture` is the name of the map beside it.
std::string to_markdown(const ExtremesResult &result, const std::string &picture);
/// The map: sweeps from the ordinary to the extreme, a line a renderer, a coloured cell a point.
std::string to_svg(const ExtremesResult &result);

/// What the study says in a sentence.
std::string conclusion(const ExtremesResult &result);

} // namespace threefold
