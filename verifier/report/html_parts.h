// SPDX-License-Identifier: MIT
// The parts that html.cpp puts together; each appends HTML to a string.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "verifier/agreement/result.h"
#include "verifier/report/claim_groups.h"

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

/// How much of a claim lies open. A run of many claims folds away what holds; everything stays on the page.
struct Layout {
    int heading = 3;         ///< level of the headings inside a claim
    bool folds = false;      ///< a small run folds nothing
    bool key_picture = true; ///< of a claim that holds, the first picture with marks stays open
};

/// A claim with all its parts: one under each preset it was judged under.
void add_group(Out &out, const RunResult &result, const ClaimGroup &group, bool folds);
/// "claim-palm-text": where a part starts on the page.
std::string anchor_of(const ClaimGroup &group, const ClaimResult &part);

void add_flips(Out &out, const ClaimResult &claim);
/// All flip points of the run in one table; nothing where there are none.
void add_flip_table(Out &out, const std::vector<ClaimGroup> &groups);
void add_pictures(Out &out, const ClaimResult &claim, const Layout &layout);
void add_rows(Out &out, const RunResult &result, const ClaimResult &claim);
void add_tiles(Out &out, const RunResult &result, const ClaimResult &claim, const Layout &layout);
void add_experiments(Out &out, const ClaimResult &claim);
/// What anyone needs to repeat the run: commands, versions, scenes, renders, time.
void add_record(Out &out, const RunResult &result);

} // namespace threefold::report
