// SPDX-License-Identifier: MIT
#include "verifier/report/html.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "verifier/report/html_parts.h"
#include "verifier/report/numbers.h"
#include "verifier/report/text.h"
#include "verifier/report/words.h"

namespace threefold {

namespace {

using namespace report;

/// With more judgements than this, what holds is folded away.
constexpr std::size_t most_open = 4;

void add_head(Out &out, const RunResult &result) {
    fmt::format_to(
        std::back_inserter(out),
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
        "'unsafe-inline'; script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'\">\n"
        "<meta name=\"color-scheme\" content=\"light dark\">\n{}<title>Threefold: {}</title>\n<style>\n{}</style>\n"
        "</head>\n<body>\n",
        is_running(result) ? "<meta http-equiv=\"refresh\" content=\"15\">\n" : "", plain(headline(result)),
        page_style);
}

void add_verdict(Out &out, const RunResult &result) {
    std::string origin = "Threefold " + plain(result.threefold_version);
    if (!result.started.empty()) origin += " · " + plain(result.started);
    if (!result.preset.empty())
        origin += result.preset == "both" ? " · both presets" : " · preset " + plain(result.preset);
    if (result.quick) origin += " · quick run";
    fmt::format_to(std::back_inserter(out),
                   "<header class=\"top {0}\">\n<p class=\"origin\">{1}</p>\n<h1><span class=\"symbol\" "
                   "aria-hidden=\"true\">{2}</span> {3}.</h1>\n",
                   to_string(result.verdict), origin, symbol(result.verdict), plain(headline(result)));
    if (!result.summary.empty())
        fmt::format_to(std::back_inserter(out), "<p class=\"lead\">{}</p>\n", html_text(result.summary));
    for (const WitnessRecord &w : result.witnesses)
        if (!w.injected_fault.empty())
            fmt::format_to(std::back_inserter(out), "<p class=\"fault\">A fault was put into {} on purpose: {}</p>\n",
                           plain(title_of(result, w.name)), html_text(w.injected_fault));
    out += "</header>\n";
}

void add_witness(Out &out, const WitnessRecord &w) {
    const bool voted = w.present && w.calibrated.value_or(true) && w.problem.empty();
    const std::string_view state = !w.present      ? "missing"
                                   : !w.calibrated ? "not calibrated"
                                   : *w.calibrated ? "calibrated"
                                                   : "failed calibration, has no vote";
    fmt::format_to(std::back_inserter(out), "<li class=\"{}\"><h3>{}</h3><p class=\"quiet\">",
                   voted ? "voted" : "absent", plain(w.title.empty() ? w.name : w.title));
    if (!w.version.empty()) fmt::format_to(std::back_inserter(out), "{} · ", plain(w.version));
    fmt::format_to(std::back_inserter(out), "<b>{}</b>", state);
    if (w.present)
        fmt::format_to(std::back_inserter(out), " · {}",
                       w.seconds > 0 ? typeset(duration(w.seconds)) : "from the cache");
    out += "</p>";
    if (!w.problem.empty()) fmt::format_to(std::back_inserter(out), "<p>{}</p>", html_text(w.problem));
    out += "</li>\n";
}

void add_renderers(Out &out, const RunResult &result) {
    if (result.witnesses.empty()) return;
    out += "<section class=\"renderers\">\n<h2>Who was asked</h2>\n<ul class=\"witnesses\">\n";
    for (const WitnessRecord &witness : result.witnesses) add_witness(out, witness);
    out += "</ul>\n</section>\n";
}

/// How to read what follows; only what is there.
void add_guide(Out &out, const RunResult &result) {
    const auto any = [&](auto has) { return std::ranges::any_of(result.claims, has); };
    std::string guide;
    if (any([](const ClaimResult &c) { return !c.rows.empty(); }))
        guide +=
            "In the drawings, the shaded band is what the closed form allows, the bar is where the measured value lies "
            "with 92 % confidence (98 % where it took a second look, with more replicates, to decide), and the tick is its "
            "mean: a number holds when the whole bar lies in the band. ";
    if (any([](const ClaimResult &c) { return !c.pictures.empty(); }))
        guide +=
            any([](const ClaimResult &c) {
                return std::ranges::any_of(c.pictures, [](const ReportPicture &p) { return !p.marks.empty(); });
            })
                ? "On the pictures, solid lines are what was measured and dashed ones what the closed form expects. "
                : "";
    if (any([](const ClaimResult &c) { return !c.pictures.empty(); }))
        guide += "Press a picture to lay the renderers' pictures over one another and flip between them.";
    if (!guide.empty()) fmt::format_to(std::back_inserter(out), "<p class=\"quiet guide\">{}</p>\n", guide);
}

bool is_asked_twice(const std::vector<ClaimGroup> &groups) {
    return std::ranges::any_of(groups, [](const ClaimGroup &g) { return g.parts.size() > 1; });
}

/// One verdict of a group, part by part.
using Verdicts = std::vector<std::pair<const ClaimResult *, std::optional<Verdict>>>;

template <class Of>
Verdicts verdicts_of(const ClaimGroup &group, Of of) {
    Verdicts all;
    for (const ClaimResult *part : group.parts) all.emplace_back(part, of(*part));
    return all;
}

/// The worst, and under which preset where that is not all of them.
std::string combined(const Verdicts &verdicts) {
    std::optional<Verdict> worst;
    for (const auto &[part, verdict] : verdicts)
        if (verdict) worst = worst ? all_of(*worst, *verdict) : *verdict;
    if (!worst) return "<span class=\"quiet\" title=\"nothing was measured\">–</span>";
    std::string where;
    for (const auto &[part, verdict] : verdicts)
        if (verdict == worst) where += (where.empty() ? "" : ", ") + plain(part->preset);
    const bool same = std::ranges::all_of(verdicts, [&](const auto &v) { return v.second == worst; });
    return badge(*worst) + (same ? "" : " <span class=\"quiet\">" + where + "</span>");
}

/// Claims down, presets and renderers across: where to look. A renderer without a number has no column.
void add_overview(Out &out, const RunResult &result, const std::vector<ClaimGroup> &groups) {
    if (groups.empty()) return;
    std::vector<const WitnessRecord *> witnesses;
    for (const WitnessRecord &w : result.witnesses)
        if (std::ranges::any_of(result.claims,
                                [&](const ClaimResult &c) { return against_closed_form(c, w.name).has_value(); }))
            witnesses.push_back(&w);
    const bool pairs =
        std::ranges::any_of(result.claims, [](const ClaimResult &c) { return between_renderers(c).has_value(); });
    const bool twice = is_asked_twice(groups);
    const std::vector<std::string> presets = twice ? presets_of(result) : std::vector<std::string>{};
    out += "<section class=\"overview\" id=\"overview\">\n<h2>At a glance</h2>\n<div class=\"scroll\"><table "
           "class=\"matrix\"><thead><tr><th scope=\"col\">Claim</th>";
    for (const std::string &preset : presets)
        fmt::format_to(std::back_inserter(out), "<th scope=\"col\">Under {}</th>", plain(preset));
    for (const WitnessRecord *w : witnesses)
        fmt::format_to(std::back_inserter(out), "<th scope=\"col\">{}</th>", plain(title_of(result, w->name)));
    if (pairs) out += "<th scope=\"col\">Renderers agree</th>";
    out += twice ? "</tr></thead><tbody>\n" : "<th scope=\"col\">Verdict</th></tr></thead><tbody>\n";
    const auto cell = [&](std::string_view label, const std::string &content) {
        fmt::format_to(std::back_inserter(out), "<td data-label=\"{}\">{}</td>", label, content);
    };
    for (const ClaimGroup &group : groups) {
        const ClaimResult &first = group.first();
        fmt::format_to(std::back_inserter(out), "<tr><th scope=\"row\"><a href=\"#claim-{}\">{}</a></th>",
                       slug(first.name), plain(first.statement.empty() ? first.name : first.statement));
        for (const std::string &preset : presets) {
            const ClaimResult *part = group.under(preset);
            cell("Under " + plain(preset), part ? fmt::format("<a class=\"to-part\" href=\"#{}\">{}</a>",
                                                              anchor_of(group, *part), badge(part->verdict))
                                                : combined({}));
        }
        for (const WitnessRecord *w : witnesses)
            cell(plain(title_of(result, w->name)),
                 combined(verdicts_of(group, [&](const ClaimResult &c) { return against_closed_form(c, w->name); })));
        if (pairs) cell("Renderers agree", combined(verdicts_of(group, between_renderers)));
        if (!twice) cell("Verdict", badge(group.verdict()));
        out += "</tr>\n";
    }
    out += "</tbody></table></div>\n";
    add_guide(out, result);
    out += "</section>\n";
}

constexpr std::string_view viewer = R"(<dialog id="viewer" aria-label="Pictures, enlarged">
<div class="bar"><div class="tabs" role="group" aria-label="Picture"></div>
<div class="modes"><button type="button" data-mode="split" aria-pressed="false">Split <kbd>S</kbd></button><button type="button" data-mode="blink" aria-pressed="false">Blink <kbd>B</kbd></button><button type="button" data-mode="marks" aria-pressed="true">Marks <kbd>M</kbd></button><button type="button" data-mode="close">Close <kbd>Esc</kbd></button></div></div>
<div class="stage"><img class="under" alt=""><div class="marks-under"></div><img class="over" alt=""><div class="marks-over"></div><div class="divider"></div></div>
<p class="says" aria-live="polite"></p>
<input type="range" min="0" max="100" value="50" step="0.5" aria-label="Where the two pictures meet">
</dialog>
)";

} // namespace

std::string to_html(const RunResult &result) {
    Out out;
    add_head(out, result);
    add_verdict(out, result);
    out += "<main>\n";
    add_renderers(out, result);
    const std::vector<ClaimGroup> groups = groups_of(result);
    add_overview(out, result, groups);
    add_flip_table(out, groups);
    const bool folds = result.claims.size() > most_open;
    if (folds)
        out += "<p class=\"all-folds\" hidden><button type=\"button\" data-folds=\"open\">Open everything</button> "
               "<button type=\"button\" data-folds=\"close\">Close everything</button></p>\n";
    for (const ClaimGroup &group : groups) add_group(out, result, group, folds);
    add_record(out, result);
    out += "</main>\n";
    const bool pictures = std::ranges::any_of(result.claims, [](const ClaimResult &c) { return !c.pictures.empty(); });
    if (pictures) out += viewer;
    fmt::format_to(std::back_inserter(out), "<script>\n{}</script>\n</body>\n</html>\n", page_script);
    return out;
}

} // namespace threefold
