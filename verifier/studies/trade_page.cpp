// SPDX-License-Identifier: MIT
// The trade study's page: the diagrams, the answers, the tables; one file, no script, nothing loaded.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "verifier/report/html_parts.h"
#include "verifier/report/numbers.h"
#include "verifier/report/text.h"
#include "verifier/studies/trade_report.h"

namespace threefold {

namespace {

using report::html_text;

constexpr double width = 900, height = 520, left = 74, right = 20, top = 18, bottom = 56;

/// Told apart by shape as well as by colour.
struct Look {
    std::string_view colour, shape;
};
constexpr std::array looks{Look{"var(--holds)", "circle"}, Look{"var(--fails)", "square"},
                           Look{"var(--link)", "triangle"}, Look{"var(--undecided)", "diamond"}};

std::string symbol(const Look &look, double x, double y, double r, bool hollow, const std::string &title) {
    const std::string style = hollow
                                  ? fmt::format(R"x(fill="var(--paper)" stroke="{}" stroke-width="1.6")x", look.colour)
                                  : fmt::format(R"(fill="{}")", look.colour);
    std::string shape;
    if (look.shape == "circle")
        shape = fmt::format(R"(<circle cx="{:.1f}" cy="{:.1f}" r="{}" {}>)", x, y, r, style);
    else if (look.shape == "square")
        shape = fmt::format(R"(<path d="M{:.1f} {:.1f}h{}v{}h-{}z" {}>)", x - r, y - r, 2 * r, 2 * r, 2 * r, style);
    else if (look.shape == "triangle")
        shape =
            fmt::format(R"(<path d="M{:.1f} {:.1f}l{} {}h-{}z" {}>)", x, y - 1.2 * r, 1.2 * r, 2.1 * r, 2.4 * r, style);
    else
        shape = fmt::format(R"(<path d="M{:.1f} {:.1f}l{} {}l-{} {}l-{} -{}z" {}>)", x, y - 1.3 * r, 1.3 * r, 1.3 * r,
                            1.3 * r, 1.3 * r, 1.3 * r, 1.3 * r, style);
    return fmt::format("{}<title>{}</title></{}>", shape, html_text(title), look.shape == "circle" ? "circle" : "path");
}

struct Axis {
    double low, high, from, to; ///< decades, and where they lie

    double at(double value) const { return from + (std::log10(value) - low) / (high - low) * (to - from); }
};

Axis axis_of(std::vector<double> values, double from, double to) {
    std::erase_if(values, [](double v) { return !(v > 0) || !std::isfinite(v); });
    if (values.empty()) values = {1};
    const double low = std::log10(*std::ranges::min_element(values)),
                 high = std::log10(*std::ranges::max_element(values));
    return {low - 0.15 * std::max(1.0, high - low) / 2, high + 0.15 * std::max(1.0, high - low) / 2, from, to};
}

/// Powers of ten; where there are few of them in reach, their doubles and fivefolds too.
std::vector<double> ticks_of(const Axis &axis) {
    std::vector<double> ticks;
    for (int k = static_cast<int>(std::floor(axis.low)); k <= axis.high; ++k)
        for (const double factor : axis.high - axis.low < 2 ? std::vector{1.0, 2.0, 5.0} : std::vector{1.0})
            if (const double t = std::log10(factor) + k; t >= axis.low && t <= axis.high)
                ticks.push_back(factor * std::pow(10, k));
    return ticks;
}

std::string tick_text(double value) {
    return value >= 1e-3 && value < 1e4 ? fmt::format("{:g}", std::round(value * 1e4) / 1e4)
                                        : report::typeset(fmt::format("{:.0e}", value));
}

void add_table(std::string &out, const std::vector<std::vector<std::string>> &table) {
    out += R"(<div class="scroll"><table class="plain"><thead><tr>)";
    for (const std::string &cell : table.front()) out += "<th>" + html_text(cell) + "</th>";
    out += "</tr></thead><tbody>";
    for (std::size_t i = 1; i < table.size(); ++i) {
        out += "<tr>";
        for (const std::string &cell : table[i]) out += "<td>" + html_text(cell) + "</td>";
        out += "</tr>\n";
    }
    out += "</tbody></table></div>\n";
}

constexpr std::string_view own_style = R"css(
.plain { font-size: .86rem; } .plain td { padding: .28rem .8rem .28rem 0; } .plain tbody tr + tr { border-top: 1px solid var(--line); }
.diagram { width: 100%; height: auto; font: 13px var(--sans); } .diagram text { fill: var(--quiet); }
.diagram .grid { stroke: var(--line); stroke-width: 1; } .diagram .tolerance { stroke: var(--ink); stroke-dasharray: 5 4; }
.diagram .front { fill: none; stroke-width: 1.8; } .answers li { margin-bottom: .45rem; max-width: 52rem; }
)css";

} // namespace

std::string work_precision_svg(const TradeResult &result, bool whole) {
    const auto seconds = [&](const RunCost &c) { return whole ? c.process_cpu_s : c.own_cpu_s; };
    std::vector<double> costs, errors(result.tolerances);
    for (const TradeRow &r : result.rows) {
        costs.push_back(seconds(r.cost));
        errors.push_back(r.error.mse.root());
    }
    for (const TradeChoice &c : result.choices)
        if (!c.setting.empty()) costs.push_back(seconds(c.cost));
    const Axis x = axis_of(costs, left, width - right), y = axis_of(errors, height - bottom, top);
    const std::string what = whole ? "whole processes" : "rendering alone";
    std::string out = fmt::format(
        R"(<svg class="diagram" xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {} {}" role="img" aria-label="relative RMS error over CPU seconds, {}">)",
        width, height, what);
    for (const double tick : ticks_of(x)) {
        const double at = x.at(tick);
        out += fmt::format(
            R"(<path class="grid" d="M{0:.1f} {1}V{2}"/><text x="{0:.1f}" y="{3}" text-anchor="middle">{4}</text>)", at,
            top, height - bottom, height - bottom + 20, tick_text(tick));
    }
    for (const double tick : ticks_of(y)) {
        const double at = y.at(tick);
        out += fmt::format(
            R"(<path class="grid" d="M{0} {1:.1f}H{2}"/><text x="{3}" y="{4:.1f}" text-anchor="end">{5}</text>)", left,
            at, width - right, left - 8, at + 4, tick_text(tick));
    }
    for (const double t : result.tolerances)
        out += fmt::format(
            R"(<path class="tolerance" d="M{0} {1:.1f}H{2}"/><text x="{2}" y="{3:.1f}" text-anchor="end">tolerance {4:g}</text>)",
            left, y.at(t), width - right, y.at(t) - 5, t);
    out += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">CPU seconds, {}</text>)", (left + width - right) / 2,
                       height - 12, what);
    out += fmt::format(
        R"x(<text transform="translate(16 {}) rotate(-90)" text-anchor="middle">relative RMS error</text>)x",
        (top + height - bottom) / 2);
    for (std::size_t i = 0; i < result.titles.size(); ++i) {
        const Look &look = looks[i % looks.size()];
        const auto &[name, title] = result.titles[i];
        std::vector<std::pair<double, double>> front;
        std::string points;
        for (const TradeRow &r : result.rows) {
            if (r.witness != name || !(seconds(r.cost) > 0) || !(r.error.mse.root() > 0)) continue;
            const double px = x.at(seconds(r.cost)), py = y.at(r.error.mse.root());
            const bool on_front = whole ? r.on_process_front : r.on_front;
            if (on_front) front.emplace_back(px, py);
            points += symbol(
                look, px, py, on_front ? 5 : 4, !on_front,
                fmt::format("{}: {} - {:.3g} s, error {:.3g}", title, r.setting, seconds(r.cost), r.error.mse.root()));
        }
        for (const TradeChoice &c : result.choices)
            if (c.witness == name && c.met && seconds(c.cost) > 0)
                points += fmt::format(
                    R"(<circle cx="{:.1f}" cy="{:.1f}" r="9" fill="none" stroke="{}" stroke-width="2"><title>{}</title></circle>)",
                    x.at(seconds(c.cost)), y.at(c.measured.root()), look.colour,
                    html_text(fmt::format("chosen for {:g}: {}", c.tolerance, c.setting)));
        std::ranges::sort(front);
        if (front.size() > 1) {
            std::string d = "M";
            for (const auto &[px, py] : front) d += fmt::format("{}{:.1f} {:.1f}", d == "M" ? "" : "L", px, py);
            out += fmt::format(R"(<path class="front" d="{}" stroke="{}"/>)", d, look.colour);
        }
        out += points;
        const double ly = height - bottom - 14 - 20 * static_cast<double>(result.titles.size() - 1 - i);
        out += symbol(look, left + 16, ly - 4, 5, false, title) +
               fmt::format(R"(<text x="{}" y="{:.1f}">{}</text>)", left + 28, ly, html_text(title));
    }
    return out + "</svg>\n";
}

std::string to_html(const TradeResult &result) {
    std::string out = fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width, initial-scale=1\">\n<title>Threefold trade: {}</title>\n<style>{}{}</style></head>\n"
        "<body><header class=\"top\"><p class=\"origin\">Threefold {} · {} · {}</p>\n<h1>What accuracy costs</h1>\n"
        "<p class=\"lead\">Scene <em>{}</em>, {} × {} pixels; {} runs of each setting, all renderers in turn. Reference: {}, "
        "itself good to {:.1e}.</p></header>\n<main>\n",
        html_text(report::one_line(result.scene)), report::page_style, own_style, html_text(result.threefold_version),
        html_text(result.started), html_text(report::one_line(result.command)),
        html_text(report::one_line(result.scene)), result.width_px, result.height_px, result.runs,
        html_text(result.reference), result.reference_error);
    out += "<section><h2>Answers</h2><ul class=\"answers\">";
    for (const std::string &line : answers(result)) out += "<li>" + html_text(line) + "</li>\n";
    out += "</ul></section>\n<section><h2>Work and precision</h2>\n";
    for (const bool whole : {false, true})
        out += fmt::format("<h3>{}</h3>\n", whole ? "Whole processes" : "Rendering alone") +
               work_precision_svg(result, whole);
    out +=
        "<p class=\"quiet\">Filled: no other setting of this renderer beats it in both (the Pareto front, joined by the "
        "line). Ringed: chosen for a tolerance, as it was measured with fresh seeds. Rest the pointer on a point to "
        "read its setting.</p></section>\n<section><h2>Settings</h2>\n";
    add_table(out, settings_table(result));
    out += fmt::format(
        "<p class=\"quiet\">RMS errors over pixels and channels, relative to the mean radiance {:.4g}: of one run; noise is "
        "what another seed changes, bias what none does (bias² = MSE − variance, unbiased for {} runs and with the "
        "reference's own variance taken off; &lt;: not told from zero). CPU seconds of all threads.</p></section>\n",
        result.mean_radiance, result.runs);
    if (const auto parts = parts_table(result); parts.size() > 1) {
        out += "<section><h2>What each knob does</h2>\n";
        add_table(out, parts);
        out +=
            "<p class=\"quiet\">The same seeds with another value of one knob; what noise adds to the difference is taken "
            "off. Quantisation is that of the picture's number format, by computation.</p></section>\n";
    }
    out += "<section><h2>Noise and systematic offsets</h2><ul>";
    for (const TradeLaw &l : result.laws)
        out += fmt::format(
            "<li>{}: the square of the noise falls as samples<sup>−{:.2f}</sup>; systematic offset: {}</li>\n",
            html_text(result.title(l.witness)), l.noise.rate, html_text(l.bias));
    out += "</ul>";
    for (const std::string &note : result.notes) out += "<p>" + html_text(note) + "</p>";
    out += "</section>\n<section><h2>Record</h2><p class=\"quiet\">";
    for (const auto &[name, version] : result.versions) out += html_text(name + " " + version) + " · ";
    out += "scene " + html_text(result.scene_hash) + "</p>\n<pre>";
    for (const auto &[name, value] : result.parameters) out += html_text(name + "=" + value) + "\n";
    return out + "</pre></section></main></body></html>\n";
}

} // namespace threefold
