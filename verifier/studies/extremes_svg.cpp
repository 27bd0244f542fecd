// SPDX-License-Identifier: MIT
// The map of the extremes. One column of sweeps beside another, each a block of cells.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "verifier/report/text.h"
#include "verifier/studies/extremes_report.h"

namespace threefold {

namespace {

using report::html_text;

constexpr int cell_width = 46, cell_height = 22, gap = 2;
constexpr int names_width = 78, block_margin = 34, title_height = 34, labels_height = 20, head_height = 120;
constexpr int margin = 28;

constexpr std::string_view style = R"(
text { font-family: system-ui, -apple-system, "Segoe UI", "DejaVu Sans", sans-serif; fill: #22313f; }
.head { font-size: 22px; font-weight: 600; }
.sub, .key { font-size: 12.5px; fill: #52616e; }
.title { font-size: 14px; font-weight: 600; }
.number { font-size: 11.5px; fill: #6b7a87; }
.name { font-size: 11.5px; text-anchor: end; }
.label { font-size: 10px; fill: #6b7a87; text-anchor: middle; }
.value { font-size: 10px; text-anchor: middle; }
.right { fill: #7cc4b0; } .right2 { fill: #a9dccd; } .right3 { fill: #d5eee6; }
.degraded { fill: #f2c14e; } .wrong { fill: #c8372d; } .refused { fill: url(#hatch); } .unresolved { fill: #eceff2; }
.on-wrong { fill: #ffffff; font-weight: 600; }
)";

/// Of what is right, the paler the larger the error.
std::string class_of(const ExtremeFinding &f) {
    if (f.standing != Standing::right) return to_string(f.standing);
    return f.worst < 1e-9 ? "right" : f.worst < 1e-6 ? "right2" : "right3";
}

/// As power of ten: "-14".
std::string magnitude(const ExtremeFinding &f) {
    switch (f.standing) {
    case Standing::refused:
        return "";
    case Standing::unresolved:
        return "?";
    case Standing::right:
    case Standing::degraded:
    case Standing::wrong:
        break;
    }
    if (!(f.worst > 0)) return f.wrong > 0 ? "lost" : "0";
    return fmt::format("1e{:.0f}", std::floor(std::log10(f.worst)));
}

std::string short_name(const ExtremeColumn &c) {
    if (c.name == "tracer-double") return "tracer";
    if (c.name == "tracer-float") return "in float";
    return c.title;
}

int height_of(const ExtremesResult &result) {
    return title_height + static_cast<int>(result.columns.size()) * (cell_height + gap) + labels_height;
}

void add_block(std::string &out, const ExtremesResult &result, const ExtremeSweepResult &sweep, int x, int y) {
    fmt::format_to(std::back_inserter(out),
                   "<text class=\"title\" x=\"{}\" y=\"{}\">{}<tspan class=\"number\" dx=\"8\">{}</tspan></text>\n",
                   x + names_width, y + 20, html_text(sweep.title), html_text(sweep.number));
    for (std::size_t k = 0; k < result.columns.size(); ++k) {
        const int top = y + title_height + static_cast<int>(k) * (cell_height + gap);
        fmt::format_to(std::back_inserter(out), "<text class=\"name\" x=\"{}\" y=\"{}\">{}</text>\n",
                       x + names_width - 8, top + 15, html_text(short_name(result.columns[k])));
        for (std::size_t i = 0; i < sweep.rows.size(); ++i) {
            const ExtremeFinding &f = sweep.rows[i].findings[k];
            const int left = x + names_width + static_cast<int>(i) * (cell_width + gap);
            std::string tip = fmt::format("{}, {} = {}: {}", result.columns[k].title, sweep.number, sweep.rows[i].label,
                                          to_string(f.standing));
            if (f.judged > 0)
                tip += fmt::format("; error {:.2g}, stated {:.2g}, {} pixels", f.worst, f.bound, f.judged);
            if (!f.reason.empty()) tip += "; " + f.reason;
            fmt::format_to(
                std::back_inserter(out),
                "<g><title>{}</title><rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"3\"/>",
                html_text(tip), class_of(f), left, top, cell_width, cell_height);
            if (const std::string text = magnitude(f); !text.empty())
                fmt::format_to(std::back_inserter(out), "<text class=\"value{}\" x=\"{}\" y=\"{}\">{}</text>",
                               f.standing == Standing::wrong ? " on-wrong" : "", left + cell_width / 2, top + 15, text);
            out += "</g>\n";
        }
    }
    const int base = y + title_height + static_cast<int>(result.columns.size()) * (cell_height + gap) + 11;
    for (std::size_t i = 0; i < sweep.rows.size(); ++i)
        fmt::format_to(std::back_inserter(out), "<text class=\"label\" x=\"{}\" y=\"{}\">{}</text>\n",
                       x + names_width + static_cast<int>(i) * (cell_width + gap) + cell_width / 2, base,
                       html_text(sweep.rows[i].label));
}

void add_key(std::string &out, int x, int y) {
    struct Entry {
        std::string_view kind, text;
        int width;
    };
    for (const Entry &e : {Entry{"right", "right, to 1e-9", 132}, Entry{"right2", "to 1e-6", 92},
                           Entry{"right3", "to 1e-3 of the radius", 166},
                           Entry{"degraded", "degraded: visible but stated, or beyond what was stated", 400},
                           Entry{"unresolved", "unresolved: nothing promised", 230},
                           Entry{"refused", "refused, with the reason", 200}, Entry{"wrong", "wrong", 60}}) {
        fmt::format_to(std::back_inserter(out),
                       "<rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"20\" height=\"14\" rx=\"3\"/>"
                       "<text class=\"key\" x=\"{}\" y=\"{}\">{}</text>\n",
                       e.kind, x, y, x + 26, y + 12, e.text);
        x += e.width;
    }
}

} // namespace

std::string to_svg(const ExtremesResult &result) {
    std::size_t longest = 1;
    for (const ExtremeSweepResult &s : result.sweeps) longest = std::max(longest, s.rows.size());
    const int block_width = names_width + static_cast<int>(longest) * (cell_width + gap);
    const int columns = result.sweeps.size() > 1 ? 2 : 1;
    const int rows = (static_cast<int>(result.sweeps.size()) + columns - 1) / columns;
    const int width = std::max(1280, 2 * margin + columns * block_width + (columns - 1) * block_margin);
    const int height = head_height + rows * (height_of(result) + 14) + margin;
    std::string out = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\">\n"
        "<title>Where each renderer breaks, and whether it says so</title>\n<desc>{2}</desc>\n<style>{3}</style>\n"
        "<defs><pattern id=\"hatch\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\" "
        "patternTransform=\"rotate(45)\"><rect width=\"6\" height=\"6\" fill=\"#f7f8fa\"/><rect width=\"2\" "
        "height=\"6\" fill=\"#b4bfc9\"/></pattern></defs>\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n",
        width, height, html_text(conclusion(result)), style);
    fmt::format_to(std::back_inserter(out),
                   "<text class=\"head\" x=\"{0}\" y=\"44\">Where each renderer breaks, and whether it says "
                   "so</text>\n<text class=\"sub\" x=\"{0}\" y=\"66\">{1}</text>\n",
                   margin, html_text(conclusion(result)));
    add_key(out, margin, 82);
    for (std::size_t i = 0; i < result.sweeps.size(); ++i) {
        const int column = static_cast<int>(i) % columns, row = static_cast<int>(i) / columns;
        add_block(out, result, result.sweeps[i], margin + column * (block_width + block_margin),
                  head_height + row * (height_of(result) + 14));
    }
    return out + "</svg>\n";
}

} // namespace threefold
