// SPDX-License-Identifier: MIT
#include "verifier/report/interval_svg.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "verifier/report/numbers.h"
#include "verifier/report/text.h"
#include "verifier/report/words.h"

namespace threefold::report {

namespace {

constexpr double width = 260, height = 46;
constexpr double margin = 9; ///< for the arrows
constexpr double band_top = 4, band_bottom = 30, bar_middle = 17, text_base = 43;

bool has_tolerance(const Row &row) { return row.relation == Relation::equal && row.tolerance > 0; }

struct Axis {
    double centre = 0, half = 1; ///< in the unit of the quantity

    double share(double value) const { return (value - centre) / half; }
    double x(double value) const { return width / 2 + std::clamp(share(value), -1.0, 1.0) * (width / 2 - margin); }
    bool left_of(double value) const { return share(value) < -1; }
    bool right_of(double value) const { return share(value) > 1; }
};

void add_band(std::string &out, const Row &row, const Axis &axis) {
    double from = margin, to = width - margin;
    if (row.relation == Relation::equal)
        from = axis.x(row.expected - row.tolerance), to = axis.x(row.expected + row.tolerance);
    if (row.relation == Relation::below) to = axis.x(row.expected);
    if (row.relation == Relation::above) from = axis.x(row.expected);
    fmt::format_to(std::back_inserter(out), R"(<rect class="band" x="{:.1f}" y="{}" width="{:.1f}" height="{}"/>)",
                   from, band_top, to - from, band_bottom - band_top);
    const auto edge = [&](double x) {
        fmt::format_to(std::back_inserter(out), R"(<path class="edge" d="M{0:.1f} {1}V{2}"/>)", x, band_top,
                       band_bottom);
    };
    if (row.relation == Relation::equal) {
        edge(from);
        edge(to);
        fmt::format_to(std::back_inserter(out), R"(<path class="expected" d="M{:.1f} {}V{}"/>)", axis.x(row.expected),
                       band_top, band_bottom);
    } else {
        edge(axis.x(row.expected));
    }
}

void add_labels(std::string &out, const Row &row, const Axis &axis) {
    const auto label = [&](double value, double x, std::string_view anchor) {
        const double step = has_tolerance(row) ? row.tolerance / 10 : resolution(row);
        fmt::format_to(std::back_inserter(out), R"(<text x="{:.1f}" y="{}" text-anchor="{}">{}</text>)", x, text_base,
                       anchor, typeset(bound_at(value, step)));
    };
    if (!has_tolerance(row)) return label(row.expected, axis.x(row.expected), "middle");
    const double low = row.expected - row.tolerance, high = row.expected + row.tolerance;
    label(low, axis.x(low) + 8, "end");
    label(high, axis.x(high) - 8, "start");
}

void add_measured(std::string &out, const Row &row, const Axis &axis) {
    const double mean = row.measured.mean;
    if (std::isnan(mean)) return;
    const double low = std::isnan(row.interval.low) ? mean : row.interval.low;
    const double high = std::isnan(row.interval.high) ? mean : row.interval.high;
    const bool beyond_left = axis.left_of(low), beyond_right = axis.right_of(high);
    double from = axis.x(low), to = axis.x(high);
    if (to - from < 3) { // a bar that can be seen, about the same middle
        const double middle = (from + to) / 2;
        from = middle - 1.5, to = middle + 1.5;
    }
    fmt::format_to(std::back_inserter(out),
                   R"(<rect class="bar" x="{:.1f}" y="{}" width="{:.1f}" height="8" rx="1.5"/>)", from, bar_middle - 4,
                   to - from);
    const auto arrow = [&](double x, double towards) {
        fmt::format_to(std::back_inserter(out), R"(<path class="arrow" d="M{:.1f} {}l{} 8l{} 8z"/>)", x, bar_middle - 8,
                       towards, -towards);
    };
    if (beyond_left) arrow(margin + 1, -9);
    if (beyond_right) arrow(width - margin - 1, 9);
    if (!axis.left_of(mean) && !axis.right_of(mean)) {
        fmt::format_to(std::back_inserter(out), R"(<path class="mean" d="M{:.1f} {}v18"/>)", axis.x(mean),
                       bar_middle - 9);
    } else if (has_tolerance(row) && std::isfinite(mean)) {
        const double tolerances = std::abs(mean - row.expected) / row.tolerance;
        const std::string text = tolerances < 9999 ? number(tolerances, 2) : "over 9999";
        const bool left = axis.left_of(mean);
        fmt::format_to(std::back_inserter(out),
                       R"(<text class="far" x="{:.1f}" y="{}" text-anchor="{}">{}× tolerance</text>)",
                       left ? margin + 4 : width - margin - 4, bar_middle - 5, left ? "start" : "end", text);
    }
}

} // namespace

Scale common_scale(std::span<const Row *const> rows) {
    constexpr double least = 1.7, greatest = 4, room = 1.08;
    double tolerances = least, reach = 0;
    for (const Row *row : rows)
        for (const double v : {row->measured.mean, row->interval.low, row->interval.high}) {
            const double distance = room * std::abs(v - row->expected);
            if (!std::isfinite(distance)) continue;
            if (has_tolerance(*row))
                tolerances = std::max(tolerances, distance / row->tolerance);
            else
                reach = std::max(reach, distance);
        }
    return {std::min(tolerances, greatest), reach > 0 ? reach : 1};
}

std::string interval_svg(const Row &row, const Scale &scale) {
    const Axis axis{row.expected, has_tolerance(row) ? scale.tolerances * row.tolerance : scale.reach};
    std::string out = fmt::format(R"(<svg class="interval {}" viewBox="0 0 {} {}" role="img" aria-label="{}: {}">)",
                                  threefold::to_string(row.verdict), width, height, threefold::to_string(row.verdict),
                                  html_text(one_line(sentence(row))));
    fmt::format_to(std::back_inserter(out), R"(<path class="axis" d="M{} {}H{}"/>)", margin, bar_middle,
                   width - margin);
    add_band(out, row, axis);
    add_measured(out, row, axis);
    add_labels(out, row, axis);
    return out + "</svg>";
}

} // namespace threefold::report
