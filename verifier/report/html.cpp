// SPDX-License-Identifier: MIT
#include "verifier/report/html.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "verifier/report/html_parts.h"
#include "verifier/report/numbers.h"
#include "verifier/report/text.h"
#include "verifier/report/words.h"

namespace threefold {

namespace {

using namespace report;

std::string plain(std::string_view text) { return html_text(one_line(text)); }

void add_head(Out &out, const RunResult &result) {
    fmt::format_to(
        std::back_inserter(out),
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src "
        "'unsafe-inline'; script-src 'unsafe-inline'; base-uri 'none'; form-action 'none'\">\n"
        "<meta name=\"color-scheme\" content=\"light dark\">\n<title>Threefold: {}</title>\n<style>\n{}</style>\n"
        "</head>\n<body>\n",
        headline(result), page_style);
}

void add_verdict(Out &out, const RunResult &result) {
    std::string origin = "Threefold " + plain(result.threefold_version);
    if (!result.started.empty()) origin += " · " + plain(result.started);
    if (!result.preset.empty()) origin += " · preset " + plain(result.preset);
    if (result.quick) origin += " · quick run";
    fmt::format_to(std::back_inserter(out),
                   "<header class=\"top {0}\">\n<p class=\"origin\">{1}</p>\n<h1><span class=\"symbol\" "
                   "aria-hidden=\"true\">{2}</span> {3}.</h1>\n",
                   to_string(result.verdict), origin, symbol(result.verdict), headline(result));
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
            "with 90 % confidence, and the tick is its mean: a number holds when the whole bar lies in the band. ";
    if (any([](const ClaimResult &c) { return !c.pictures.empty(); }))
        guide += "Press a picture to lay the renderers' pictures over one another and flip between them.";
    if (!guide.empty()) fmt::format_to(std::back_inserter(out), "<p class=\"quiet guide\">{}</p>\n", guide);
}

/// Claims down, renderers across: where to look. A renderer without a number has no column.
void add_overview(Out &out, const RunResult &result) {
    if (result.claims.empty()) return;
    std::vector<const WitnessRecord *> witnesses;
    for (const WitnessRecord &w : result.witnesses)
        if (std::ranges::any_of(result.claims,
                                [&](const ClaimResult &c) { return against_closed_form(c, w.name).has_value(); }))
            witnesses.push_back(&w);
    const bool pairs =
        std::ranges::any_of(result.claims, [](const ClaimResult &c) { return between_renderers(c).has_value(); });
    out += "<section class=\"overview\">\n<h2>At a glance</h2>\n<div class=\"scroll\"><table "
           "class=\"matrix\"><thead><tr><th "
           "scope=\"col\">Claim</th>";
    for (const WitnessRecord *w : witnesses)
        fmt::format_to(std::back_inserter(out), "<th scope=\"col\">{}</th>", plain(title_of(result, w->name)));
    if (pairs) out += "<th scope=\"col\">Renderers agree</th>";
    out += "<th scope=\"col\">Verdict</th></tr></thead><tbody>\n";
    const auto cell = [&](std::string_view label, std::optional<Verdict> verdict) {
        fmt::format_to(std::back_inserter(out), "<td data-label=\"{}\">{}</td>", label,
                       verdict ? badge(*verdict)
                               : std::string("<span class=\"quiet\" title=\"nothing was measured\">–</span>"));
    };
    for (const ClaimResult &claim : result.claims) {
        fmt::format_to(std::back_inserter(out), "<tr><th scope=\"row\"><a href=\"#claim-{}\">{}</a></th>",
                       slug(claim.name), plain(claim.statement.empty() ? claim.name : claim.statement));
        for (const WitnessRecord *w : witnesses)
            cell(plain(title_of(result, w->name)), against_closed_form(claim, w->name));
        if (pairs) cell("Renderers agree", between_renderers(claim));
        cell("Verdict", claim.verdict);
        out += "</tr>\n";
    }
    out += "</tbody></table></div>\n";
    add_guide(out, result);
    out += "</section>\n";
}

constexpr std::string_view viewer = R"(<dialog id="viewer" aria-label="Pictures, enlarged">
<div class="bar"><div class="tabs" role="group" aria-label="Picture"></div>
<div class="modes"><button type="button" data-mode="split" aria-pressed="false">Split <kbd>S</kbd></button><button type="button" data-mode="blink" aria-pressed="false">Blink <kbd>B</kbd></button><button type="button" data-mode="close">Close <kbd>Esc</kbd></button></div></div>
<div class="stage"><img class="under" alt=""><img class="over" alt=""><div class="divider"></div></div>
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
    add_overview(out, result);
    for (const ClaimResult &claim : result.claims) add_claim(out, result, claim);
    add_record(out, result);
    out += "</main>\n";
    const bool pictures = std::ranges::any_of(result.claims, [](const ClaimResult &c) { return !c.pictures.empty(); });
    if (pictures) out += viewer;
    fmt::format_to(std::back_inserter(out), "<script>\n{}</script>\n</body>\n</html>\n", page_script);
    return out;
}

} // namespace threefold
