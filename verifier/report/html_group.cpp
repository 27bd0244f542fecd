// SPDX-License-Identifier: MIT
// One claim: what is claimed, what was found under each preset, where it flips, what it looks like, and the numbers.
#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "verifier/report/html_parts.h"
#include "verifier/report/numbers.h"
#include "verifier/report/text.h"
#include "verifier/report/words.h"

namespace threefold::report {

namespace {

std::string heading_text(const ClaimResult &claim) {
    return plain(claim.statement.empty() ? claim.name : claim.statement);
}

void add_summary(Out &out, const std::string &summary) {
    if (!summary.empty()) fmt::format_to(std::back_inserter(out), "<p class=\"summary\">{}</p>\n", html_text(summary));
}

void add_blamed(Out &out, const RunResult &result, const ClaimResult &claim) {
    if (claim.blamed.empty()) return;
    std::string names;
    for (const std::string &name : claim.blamed) names += (names.empty() ? "" : ", ") + plain(title_of(result, name));
    fmt::format_to(std::back_inserter(out), "<p class=\"blamed\">Out of line: <b>{}</b></p>\n", names);
}

void add_notes(Out &out, const std::vector<std::string> &notes) {
    if (notes.empty()) return;
    out += "<ul class=\"notes\">";
    for (const std::string &note : notes) fmt::format_to(std::back_inserter(out), "<li>{}</li>", html_text(note));
    out += "</ul>\n";
}

void add_scope(Out &out, const std::vector<ScopeFinding> &findings) {
    if (findings.empty()) return;
    out += "<div class=\"scope\"><p><b>Within its model only.</b> What the model leaves out (<code>threefold "
           "scope</code>):</p><ul class=\"notes\">";
    for (const ScopeFinding &finding : findings)
        fmt::format_to(std::back_inserter(out), "<li>{}</li>", html_text(one_line(finding.sentence)));
    out += "</ul></div>\n";
}

/// "The numbers: 24 rows and 3 comparisons of pictures, all hold".
std::string what_is_folded(const ClaimResult &claim) {
    std::string text;
    if (!claim.rows.empty()) text = count(std::ssize(claim.rows), "row");
    if (!claim.tiles.empty())
        text += (text.empty() ? "" : " and ") + count(std::ssize(claim.tiles), "comparison") + " tile by tile";
    if (of_all_rows(claim) == Verdict::holds) text += ", all hold";
    return text;
}

/// Pictures and numbers of one part.
void add_evidence(Out &out, const RunResult &result, const ClaimResult &claim, const Layout &layout) {
    add_pictures(out, claim, layout);
    const bool numbers = !claim.rows.empty() || !claim.tiles.empty();
    const bool fold = layout.folds && numbers;
    if (fold)
        fmt::format_to(std::back_inserter(out),
                       "<details class=\"fold\"{1}><summary><h{0}>The numbers</h{0}> <span "
                       "class=\"quiet\">{2}</span></summary>\n",
                       layout.heading, claim.verdict == Verdict::holds ? "" : " open", what_is_folded(claim));
    else if (!claim.rows.empty())
        fmt::format_to(std::back_inserter(out), "<h{0}>The numbers</h{0}>\n", layout.heading);
    add_rows(out, result, claim);
    add_tiles(out, result, claim, layout);
    if (fold) out += "</details>\n";
    add_experiments(out, claim);
}

void add_single(Out &out, const RunResult &result, const ClaimResult &claim, bool folds) {
    add_summary(out, claim.summary);
    add_blamed(out, result, claim);
    add_flips(out, claim);
    add_scope(out, claim.scope);
    add_notes(out, claim.notes);
    out += "</header>\n";
    add_evidence(out, result, claim, {3, folds, true});
}

/// What all parts say alike is said once, above them.
void add_parts(Out &out, const RunResult &result, const ClaimGroup &group, bool folds) {
    const bool one_summary =
        std::ranges::all_of(group.parts, [&](const ClaimResult *p) { return p->summary == group.first().summary; });
    std::vector<std::string> common;
    for (const std::string &note : group.first().notes)
        if (std::ranges::all_of(group.parts,
                                [&](const ClaimResult *p) { return std::ranges::count(p->notes, note) > 0; }))
            common.push_back(note);
    if (one_summary) add_summary(out, group.first().summary);
    add_notes(out, common);
    out += "</header>\n";
    for (const ClaimResult *part : group.parts) {
        const std::string_view meaning = meaning_of_preset(part->preset);
        fmt::format_to(
            std::back_inserter(out), "<section class=\"part\" id=\"{}\">\n<h3 class=\"preset\">Under {}{} {}</h3>\n",
            anchor_of(group, *part), plain(part->preset),
            meaning.empty() ? "" : fmt::format(" <span class=\"quiet\">{}</span>", meaning), badge(part->verdict));
        if (!one_summary) add_summary(out, part->summary);
        add_blamed(out, result, *part);
        add_flips(out, *part);
        add_scope(out, part->scope);
        std::vector<std::string> own;
        for (const std::string &note : part->notes)
            if (std::ranges::count(common, note) == 0) own.push_back(note);
        add_notes(out, own);
        add_evidence(out, result, *part, {4, folds, part == group.parts.front()});
        out += "</section>\n";
    }
}

} // namespace

std::string anchor_of(const ClaimGroup &group, const ClaimResult &part) {
    const std::string claim = "claim-" + slug(part.name);
    return group.parts.size() > 1 ? claim + "-" + slug(part.preset) : claim;
}

void add_group(Out &out, const RunResult &result, const ClaimGroup &group, bool folds) {
    const ClaimResult &first = group.first();
    fmt::format_to(std::back_inserter(out),
                   "<article class=\"claim {}\" id=\"claim-{}\">\n<header><p class=\"name\">{} {}</p>\n<h2>{}</h2>\n",
                   threefold::to_string(group.verdict()), slug(first.name), badge(group.verdict()), plain(first.name),
                   heading_text(first));
    if (group.parts.size() == 1)
        add_single(out, result, first, folds);
    else
        add_parts(out, result, group, folds);
    out += "</article>\n";
}

} // namespace threefold::report
