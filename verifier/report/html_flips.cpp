// SPDX-License-Identifier: MIT
// Where conclusions flip: in each claim, and all of them in one table.
#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "verifier/report/flip_words.h"
#include "verifier/report/html_parts.h"
#include "verifier/report/numbers.h"
#include "verifier/report/text.h"

namespace threefold::report {

namespace {

/// "at 1.2006 and 1.2200 ✓ holds"; empty where nothing was rendered beside it.
std::string bracket_html(const ClaimResult &claim, const FlipPoint &flip) {
    const auto verdict = bracket_verdict(claim, flip);
    return verdict ? typeset(plain(bracket_text(claim, flip))) + " " + badge(*verdict) : "";
}

/// One flip point of one claim, under each preset that has it.
struct FlipGroup {
    std::vector<std::pair<const ClaimResult *, const FlipPoint *>> values;
};

std::vector<FlipGroup> flip_groups(const ClaimGroup &group) {
    std::vector<FlipGroup> all;
    for (const ClaimResult *part : group.parts)
        for (const FlipPoint &flip : part->flips) {
            const auto same = std::ranges::find_if(all, [&](const FlipGroup &g) {
                const auto &[claim, first] = g.values.front();
                return g.values.back().first != part && first->parameter == flip.parameter &&
                       first->meaning == flip.meaning;
            });
            if (same == all.end())
                all.push_back({{{part, &flip}}});
            else
                same->values.emplace_back(part, &flip);
        }
    return all;
}

void add_table_rows(Out &out, const ClaimGroup &group, const FlipGroup &flips, bool with_preset) {
    const auto cell = [&](std::string_view label, const std::string &content) {
        fmt::format_to(std::back_inserter(out), R"(<td data-label="{}">{}</td>)", label, content);
    };
    const FlipPoint &first = *flips.values.front().second;
    fmt::format_to(std::back_inserter(out),
                   "<tbody class=\"row\"><tr><th scope=\"row\" rowspan=\"{}\"><a href=\"#claim-{}\">{}</a> "
                   "<code>{}</code> <span class=\"quiet\">{}</span></th>",
                   flips.values.size(), slug(group.first().name), plain(group.first().name), plain(first.parameter),
                   plain(first.meaning));
    for (const auto &[claim, flip] : flips.values) {
        if (flip != &first) out += "<tr>";
        if (with_preset)
            cell("under", fmt::format("<a class=\"to-part\" href=\"#{}\">{}</a>", anchor_of(group, *claim),
                                      plain(claim->preset)));
        cell("flips at", "<b>" + typeset(plain(flip_value(*flip))) + "</b>");
        cell("here", typeset(plain(here_text(*flip))));
        const std::string bracket = bracket_html(*claim, *flip);
        cell("rendered beside it", bracket.empty() ? "<span class=\"quiet\">–</span>" : bracket);
        out += "</tr>\n";
    }
    out += "</tbody>\n";
}

} // namespace

void add_flips(Out &out, const ClaimResult &claim) {
    for (const FlipPoint &flip : claim.flips) {
        fmt::format_to(std::back_inserter(out),
                       "<div class=\"flip\"><p>It flips at <b><code>{}</code> = {}</b> (here {}){}{}</p>",
                       plain(flip.parameter), typeset(plain(flip_value(flip))), typeset(plain(here_text(flip))),
                       flip.meaning.empty() ? "." : ": ", plain(flip.meaning));
        if (const std::string bracket = bracket_html(claim, flip); !bracket.empty())
            fmt::format_to(std::back_inserter(out), "<p class=\"quiet\">Bracketed by renders {}</p>", bracket);
        out += "</div>\n";
    }
}

void add_flip_table(Out &out, const std::vector<ClaimGroup> &groups) {
    std::string rows;
    const bool with_preset = std::ranges::any_of(groups, [](const ClaimGroup &g) { return g.parts.size() > 1; });
    for (const ClaimGroup &group : groups)
        for (const FlipGroup &flips : flip_groups(group)) add_table_rows(rows, group, flips, with_preset);
    if (rows.empty()) return;
    fmt::format_to(
        std::back_inserter(out),
        "<section class=\"flips\" id=\"flips\">\n<h2>Where each conclusion flips</h2>\n<p class=\"quiet\">By "
        "the closed form, at this run's other parameters, and held against renders just below and just "
        "above.</p>\n<div class=\"scroll\"><table class=\"numbers flip-table\"><thead><tr><th "
        "scope=\"col\">Conclusion</th>{}<th scope=\"col\">Flips at</th><th scope=\"col\">Here</th><th "
        "scope=\"col\">Rendered beside it</th></tr></thead>\n",
        with_preset ? "<th scope=\"col\">Under</th>" : "");
    out += rows;
    out += "</table></div>\n</section>\n";
}

} // namespace threefold::report
