// SPDX-License-Identifier: MIT
// The numbers behind a claim: rows, tiles, scenes.
#include <algorithm>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "verifier/report/html_parts.h"
#include "verifier/report/interval_svg.h"
#include "verifier/report/numbers.h"
#include "verifier/report/text.h"
#include "verifier/report/words.h"

namespace threefold::report {

namespace {

std::string cell(std::string_view label, std::string_view kind, const std::string &content, int rows = 1) {
    return fmt::format(R"(<td data-label="{}" class="{}"{}>{}</td>)", label, kind,
                       rows > 1 ? fmt::format(" rowspan=\"{}\"", rows) : "", content);
}

/// "0.004 = 0.002 sampling + 0.001 tessellation + ..." and, opened, the reason of each.
void add_budget(Out &out, double tolerance, const std::vector<BudgetItem> &budget, const std::string &unit,
                const std::string &advice, int columns) {
    if (budget.empty() && advice.empty()) return;
    fmt::format_to(std::back_inserter(out), R"(<tr class="why"><td colspan="{}">)", columns);
    if (!advice.empty()) fmt::format_to(std::back_inserter(out), R"(<p class="advice">{}</p>)", plain(advice));
    if (!budget.empty()) {
        std::string sum;
        for (const BudgetItem &item : budget)
            if (item.value != 0 || total(budget) == 0)
                sum +=
                    fmt::format("{}{} {}", sum.empty() ? "" : " + ", plain(item.name), typeset(number(item.value, 2)));
        fmt::format_to(
            std::back_inserter(out),
            R"(<details><summary><span class="label">Tolerance {}{}</span> = {}</summary><dl class="budget">)",
            typeset(number(tolerance)), unit, sum);
        for (const BudgetItem &item : budget)
            fmt::format_to(std::back_inserter(out), "<dt>{} <b>{}{}</b></dt><dd>{}</dd>", plain(item.name),
                           typeset(number(item.value)), unit, html_text(item.reason));
        out += "</dl></details>";
    }
    out += "</td></tr>\n";
}

std::string expected_text(const Row &row) {
    const std::string value = typeset(bound_at(row.expected, resolution(row)));
    switch (row.relation) {
    case Relation::equal:
        return value;
    case Relation::below:
        return "below " + value;
    case Relation::above:
        return "above " + value;
    }
    return value;
}

std::string interval_text(const Row &row) {
    const auto &[low, high] = row.interval;
    if (row.measured.replicates == 0 && row.measured.standard_error == 0) return "exact";
    if (low == high)
        return row.measured.replicates > 1 ? fmt::format("no spread in {}", row.measured.replicates) : "one render";
    const double step = resolution(row);
    const std::string ends = fmt::format("{} to {}", number_at(low, step), number_at(high, step));
    return typeset(row.level == first_look ? ends : fmt::format("{} ({} replicates)", ends, row.measured.replicates));
}

void add_row(Out &out, const RunResult &result, const Row &row, const Scale &scale) {
    const bool two_sided = row.relation == Relation::equal;
    const std::string advice = what_would_decide(row.verdict, row.replicates_to_decide);
    const int lines = row.budget.empty() && advice.empty() ? 1 : 2; // the drawing stands beside the tolerance's items
    fmt::format_to(std::back_inserter(out),
                   R"(<tbody class="row {0}"><tr><th scope="row">{1}</th>{2}{3}{4}{5}{6}{7}</tr>)"
                   "\n",
                   threefold::to_string(row.verdict), plain(title_of(result, row)),
                   cell("measured", "number", typeset(number_at(row.measured.mean, resolution(row)))),
                   cell("interval", "number", interval_text(row)),
                   cell(row.versus.empty() ? "closed form" : "expected", "number", expected_text(row)),
                   cell("tolerance", "number", two_sided ? "±" + typeset(number(row.tolerance)) : "none"),
                   cell("interval in the band", "drawing", interval_svg(row, scale), lines),
                   cell("verdict", "verdict", badge(row.verdict), lines));
    const std::string unit = row.unit.empty() ? "" : " " + plain(row.unit);
    add_budget(out, row.tolerance, row.budget, unit, advice, 5);
    out += "</tbody>\n";
}

bool same_group(const Row &a, const Row &b) {
    return a.experiment == b.experiment && a.quantity == b.quantity && a.unit == b.unit;
}

std::string share_of_mean(const TileComparison &t, double radiance) {
    return typeset(t.mean_radiance > 0 ? percent(radiance / t.mean_radiance) : number(radiance));
}

/// How many tiles hold, are undecided and fail, as one bar of three lengths.
std::string tile_counts(const TileComparison &t) {
    const double all = t.holding + t.failing + t.open;
    std::string text = count(t.holding, "tile") + (t.holding == 1 ? " holds" : " hold");
    if (t.open) text += fmt::format(", {} undecided", t.open);
    if (t.failing) text += fmt::format(", {} {}", t.failing, t.failing == 1 ? "fails" : "fail");
    if (!(all > 0)) return text;
    std::string bar = R"(<svg class="counts" viewBox="0 0 200 8" preserveAspectRatio="none" aria-hidden="true">)";
    double x = 0;
    for (const auto &[kind, n] : {std::pair{"holds", t.holding}, {"undecided", t.open}, {"fails", t.failing}}) {
        const double length = n > 0 ? std::max(2.0, 200 * n / all) : 0;
        x = std::min(x, 200 - length);
        if (n > 0)
            fmt::format_to(std::back_inserter(bar), R"(<rect class="{}" x="{:.1f}" width="{:.1f}" height="8"/>)", kind,
                           x, length);
        x += length;
    }
    return text + bar + "</svg>";
}

} // namespace

std::string badge(Verdict verdict) {
    return fmt::format(R"(<span class="badge {0}"><span class="symbol" aria-hidden="true">{1}</span> {0}</span>)",
                       threefold::to_string(verdict), symbol(verdict));
}

void add_rows(Out &out, const RunResult &result, const ClaimResult &claim) {
    if (claim.rows.empty()) return;
    out += "<div class=\"scroll\"><table class=\"numbers intervals\"><thead><tr><th scope=\"col\">Renderer</th><th "
           "scope=\"col\">Measured</th>"
           "<th scope=\"col\">Interval</th><th scope=\"col\">Closed form</th><th scope=\"col\">Tolerance</th>"
           "<th scope=\"col\">Interval in the tolerance band</th><th scope=\"col\">Verdict</th></tr></thead>\n";
    std::vector<char> done(claim.rows.size(), 0);
    for (std::size_t first = 0; first < claim.rows.size(); ++first) {
        if (done[first]) continue;
        std::vector<const Row *> group;
        for (std::size_t i = first; i < claim.rows.size(); ++i)
            if (!done[i] && same_group(claim.rows[first], claim.rows[i])) {
                done[i] = 1;
                group.push_back(&claim.rows[i]);
            }
        const Row &row = *group.front();
        fmt::format_to(
            std::back_inserter(out),
            R"(<tbody class="quantity"><tr><th colspan="7" scope="rowgroup">{}{} <span>{}</span></th></tr></tbody>)"
            "\n",
            plain(row.quantity), row.unit.empty() ? "" : ", " + plain(row.unit),
            plain(experiment_title(claim, row.experiment)));
        const Scale scale = common_scale(group);
        for (const Row *member : group) add_row(out, result, *member, scale);
    }
    out += "</table></div>\n";
}

void add_tiles(Out &out, const RunResult &result, const ClaimResult &claim, const Layout &layout) {
    if (claim.tiles.empty()) return;
    fmt::format_to(std::back_inserter(out), "<h{0}>The pictures, tile by tile</h{0}>\n", layout.heading);
    out += "<p class=\"quiet\">Two renderers' pictures of one scene, cut into square "
           "tiles; differences in per cent of the picture's mean radiance.</p>\n"
           "<div class=\"scroll\"><table class=\"numbers tiles\"><thead><tr><th scope=\"col\">Renderers</th><th "
           "scope=\"col\">Worst tile</th>"
           "<th scope=\"col\">Where</th><th scope=\"col\">Tolerance</th><th scope=\"col\">Tiles</th>"
           "<th scope=\"col\">Verdict</th></tr></thead>\n";
    for (const TileComparison &t : claim.tiles) {
        const int x = t.worst_column * t.tile_px, y = t.worst_row * t.tile_px;
        const std::string where = fmt::format("column {}, row {} <span class=\"quiet\">pixels {}–{}, {}–{}</span>",
                                              t.worst_column, t.worst_row, x, x + t.tile_px - 1, y, y + t.tile_px - 1);
        const std::string who = fmt::format("{} minus {} <span class=\"quiet\">{}, {} × {} tiles of {} px</span>",
                                            plain(title_of(result, t.witness)), plain(title_of(result, t.versus)),
                                            plain(experiment_title(claim, t.experiment)), t.columns, t.rows, t.tile_px);
        fmt::format_to(
            std::back_inserter(out), "<tbody class=\"row {}\"><tr><th scope=\"row\">{}</th>{}{}{}{}{}</tr>\n",
            threefold::to_string(t.verdict), who, cell("worst tile", "number", share_of_mean(t, t.worst_difference)),
            cell("where", "place", where), cell("tolerance", "number", "±" + share_of_mean(t, t.tolerance)),
            cell("tiles", "tiles", tile_counts(t)), cell("verdict", "verdict", badge(t.verdict)));
        const std::string advice = t.problem.empty() ? what_would_decide(t.verdict, t.replicates_to_decide)
                                                     : plain("not judged: " + t.problem);
        add_budget(out, t.tolerance, t.budget, " in radiance", advice, 6);
        out += "</tbody>\n";
    }
    out += "</table></div>\n";
}

void add_experiments(Out &out, const ClaimResult &claim) {
    if (claim.experiments.empty()) return;
    out += "<details class=\"scenes\"><summary>Scenes and their parameters</summary>\n";
    for (const ExperimentRecord &e : claim.experiments) {
        fmt::format_to(std::back_inserter(out), "<h4>{}</h4><p class=\"quiet\">Scene <code>{}</code>{}</p>",
                       plain(e.title.empty() ? e.name : e.title), plain(e.scene),
                       e.scene_hash.empty() ? "" : ", hash <code class=\"hash\">" + plain(e.scene_hash) + "</code>");
        if (e.parameters.empty()) continue;
        out += "<dl class=\"parameters\">";
        for (const auto &[name, value] : e.parameters)
            fmt::format_to(std::back_inserter(out), "<div><dt>{}</dt><dd>{}</dd></div>", plain(name), plain(value));
        out += "</dl>\n";
    }
    out += "</details>\n";
}

} // namespace threefold::report
