// SPDX-License-Identifier: MIT
// The parts that html.cpp puts together; each appends HTML to a string.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "verifier/agreement/result.h"

namespace threefold::report {

using Out = std::string;

extern const std::string_view page_style;  ///< CSS
extern const std::string_view page_script; ///< JavaScript

/// Symbol and word, coloured: "✓ holds".
std::string badge(Verdict verdict);
/// A picture's width and height from the head of its PNG; empty for bytes that are no PNG.
struct PictureSize {
    std::size_t width = 0, height = 0;
};
PictureSize png_size(std::string_view png);

void add_claim(Out &out, const RunResult &result, const ClaimResult &claim);
void add_pictures(Out &out, const ClaimResult &claim);
void add_rows(Out &out, const RunResult &result, const ClaimResult &claim);
void add_tiles(Out &out, const RunResult &result, const ClaimResult &claim);
/// What anyone needs to repeat the run: commands, versions, scenes, renders, time.
void add_record(Out &out, const RunResult &result);

} // namespace threefold::report
