// SPDX-License-Identifier: MIT
#include "verifier/report/marks_svg.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "verifier/report/numbers.h"
#include "verifier/report/text.h"

namespace threefold::report {

namespace {

constexpr Mark::Meaning meanings[]{Mark::Meaning::measured, Mark::Meaning::expected};

std::string_view meaning_word(Mark::Meaning meaning) {
    switch (meaning) {
    case Mark::Meaning::expected:
        return "expected";
    case Mark::Meaning::measured:
        return "measured";
    }
    return "";
}

bool has_ends(const Mark &mark) { return mark.kind == Mark::Kind::line || mark.kind == Mark::Kind::arrow; }

bool is_drawable(const Mark &mark) {
    // Beyond this nobody sees it, and its digits would only make the page longer.
    const auto good = [](double v) { return std::abs(v) < 1e6; };
    if (!good(mark.from_px.x) || !good(mark.from_px.y)) return false;
    if (has_ends(mark)) return good(mark.to_px.x) && good(mark.to_px.y);
    return mark.kind == Mark::Kind::cross || (good(mark.radius_px) && mark.radius_px > 0);
}

/// To a hundredth of a pixel, as short as can be.
std::string coordinate(double value) {
    std::string text = fmt::format("{:.2f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text == "-0" ? "0" : text;
}

void add_segment(std::string &path, Vec2 from, Vec2 to) {
    fmt::format_to(std::back_inserter(path), "M{} {}L{} {}", coordinate(from.x), coordinate(from.y), coordinate(to.x),
                   coordinate(to.y));
}

void add_arrow(std::string &path, const Mark &mark, double picture_px) {
    const Vec2 along = mark.to_px - mark.from_px;
    const double length = glm::length(along);
    add_segment(path, mark.from_px, mark.to_px);
    if (!(length > 0)) return;
    const double head = std::min(0.4 * length, 0.03 * picture_px);
    const Vec2 back = along * (head / length), side = Vec2(-back.y, back.x) * 0.5;
    add_segment(path, mark.to_px - back + side, mark.to_px);
    add_segment(path, mark.to_px - back - side, mark.to_px);
}

void add_circle(std::string &path, const Mark &mark) {
    const std::string r = coordinate(mark.radius_px), across = coordinate(2 * mark.radius_px);
    fmt::format_to(std::back_inserter(path), "M{} {}a{} {} 0 1 0 {} 0a{} {} 0 1 0 -{} 0",
                   coordinate(mark.from_px.x - mark.radius_px), coordinate(mark.from_px.y), r, r, across, r, r, across);
}

/// + for measured, × for expected: they are told apart where both lie on one point.
void add_cross(std::string &path, const Mark &mark, double picture_px) {
    const double arm = 0.03 * picture_px;
    const bool upright = mark.meaning == Mark::Meaning::measured;
    const Vec2 first = upright ? Vec2(arm, 0) : Vec2(arm, arm) * std::sqrt(0.5), second = Vec2(-first.y, first.x);
    add_segment(path, mark.from_px - first, mark.from_px + first);
    add_segment(path, mark.from_px - second, mark.from_px + second);
}

void add_mark(std::string &path, const Mark &mark, double picture_px) {
    switch (mark.kind) {
    case Mark::Kind::line:
        return add_segment(path, mark.from_px, mark.to_px);
    case Mark::Kind::arrow:
        return add_arrow(path, mark, picture_px);
    case Mark::Kind::circle:
        return add_circle(path, mark);
    case Mark::Kind::cross:
        return add_cross(path, mark, picture_px);
    }
}

/// Where a label hangs: the head of an arrow, the upper end of a line, a point of a circle that moves on from one
/// circle to the next, because concentric ones are the rule.
Vec2 anchor(const Mark &mark, int earlier_circles) {
    switch (mark.kind) {
    case Mark::Kind::line:
        return mark.from_px.y < mark.to_px.y ? mark.from_px : mark.to_px;
    case Mark::Kind::arrow:
        return mark.to_px;
    case Mark::Kind::circle:
        return mark.from_px +
               mark.radius_px * Vec2(std::cos(0.6 * earlier_circles - 0.8), std::sin(0.6 * earlier_circles - 0.8));
    case Mark::Kind::cross:
        return mark.from_px;
    }
    return mark.from_px;
}

/// To the side of its mark where there is more room; expected below the point and measured above it, so that the two do
/// not cover each other where they agree.
void add_label(std::string &out, const Mark &mark, Vec2 at, double width_px, double height_px) {
    const double x = std::clamp(100 * at.x / width_px, 0.0, 100.0), y = std::clamp(100 * at.y / height_px, 0.0, 100.0);
    const bool below = y < 8 || (y < 92 && mark.meaning == Mark::Meaning::expected);
    fmt::format_to(std::back_inserter(out), R"(<span class="{}{}{}" style="left:{:.2f}%;top:{:.2f}%">{}</span>)",
                   meaning_word(mark.meaning), x > 55 ? " leftwards" : "", below ? " below" : "", x, y,
                   html_text(one_line(mark.label)));
}

std::string description(const std::vector<const Mark *> &marks) {
    std::string text;
    for (const Mark::Meaning meaning : meanings) {
        std::string labels;
        for (const Mark *mark : marks)
            if (mark->meaning == meaning && !mark->label.empty())
                labels += (labels.empty() ? "" : ", ") + one_line(mark->label);
        if (!labels.empty()) text += fmt::format("{}{}: {}.", text.empty() ? "" : " ", meaning_word(meaning), labels);
    }
    return text;
}

} // namespace

std::string marks_overlay(std::span<const Mark> marks, double width_px, double height_px) {
    std::vector<const Mark *> drawable;
    for (const Mark &mark : marks)
        if (is_drawable(mark)) drawable.push_back(&mark);
    if (drawable.empty() || !(width_px > 0) || !(height_px > 0)) return "";
    std::string lines, labels, title;
    int circles = 0;
    for (const Mark::Meaning meaning : meanings) {
        std::string path;
        int n = 0;
        for (const Mark *mark : drawable)
            if (mark->meaning == meaning) {
                add_mark(path, *mark, std::max(width_px, height_px));
                ++n;
                if (mark->label.empty()) continue;
                add_label(labels, *mark, anchor(*mark, circles), width_px, height_px);
                circles += mark->kind == Mark::Kind::circle;
            }
        if (n == 0) continue;
        // Light on dark, so that it is seen on any picture.
        fmt::format_to(std::back_inserter(lines), R"(<path class="halo {0}" d="{1}"/><path class="ink {0}" d="{1}"/>)",
                       meaning_word(meaning), path);
        title += fmt::format("{}{} {}", title.empty() ? "" : ", ", count(n, "mark"), meaning_word(meaning));
    }
    const std::string says = description(drawable);
    return fmt::format(
        R"(<div class="marks"><svg viewBox="0 0 {} {}" preserveAspectRatio="none" role="img"><title>{}</title>{}{}</svg>)"
        R"({}</div>)",
        coordinate(width_px), coordinate(height_px), title, says.empty() ? "" : "<desc>" + html_text(says) + "</desc>",
        lines, labels.empty() ? "" : R"(<div class="labels" aria-hidden="true">)" + labels + "</div>");
}

std::string marks_legend(std::span<const Mark *const> marks) {
    std::string items;
    for (const Mark::Meaning meaning : meanings) {
        const auto occurs = [&](bool crosses) {
            return std::ranges::any_of(marks, [&](const Mark *m) {
                return is_drawable(*m) && m->meaning == meaning && (m->kind == Mark::Kind::cross) == crosses;
            });
        };
        const bool lines = occurs(false), crosses = occurs(true);
        if (!lines && !crosses) continue;
        const bool upright = meaning == Mark::Meaning::measured;
        std::string path;
        if (lines) path += "M2 7H34";
        if (crosses) path += upright ? "M42 7h10m-5 -5v10" : "M43.5 3.5l7 7m0 -7l-7 7";
        fmt::format_to(
            std::back_inserter(items),
            R"(<li><svg viewBox="{} 0 {} 14" width="{}" height="14" aria-hidden="true"><path class="halo {}" d="{}"/><path class="ink {}" d="{}"/></svg> {}: {}</li>)",
            lines ? 0 : 38,
            lines && crosses ? 56
            : lines          ? 36
                             : 18,
            lines && crosses ? 56
            : lines          ? 36
                             : 18,
            meaning_word(meaning), path, meaning_word(meaning), path, meaning_word(meaning),
            upright ? "read from the picture" : "the closed form, before rendering");
    }
    return items.empty() ? "" : R"(<ul class="legend">)" + items + "</ul>\n";
}

} // namespace threefold::report
