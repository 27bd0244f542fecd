// SPDX-License-Identifier: MIT
// Pictures of one experiment stand side by side: the renders first, then the differences and the optical maps.
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "verifier/report/html_parts.h"
#include "verifier/report/marks_svg.h"
#include "verifier/report/numbers.h"
#include "verifier/report/text.h"
#include "verifier/report/words.h"

namespace threefold::report {

namespace {

/// Up to this width a picture is enlarged, and its pixels stay squares; wider ones are reduced, and smoothed.
constexpr std::size_t pixelated_up_to_px = 420;
constexpr std::size_t greatest_columns = 4;

bool is_render(const ReportPicture &picture) { return picture.kind == ReportPicture::Kind::render; }

void add_picture(Out &out, const ReportPicture &picture, const std::string &scene) {
    const auto [width, height] = png_size(picture.png);
    const std::string title = html_text(one_line(picture.title));
    const std::string data = base64(picture.png);
    const std::string marks = marks_overlay(picture.marks, static_cast<double>(width), static_cast<double>(height));
    fmt::format_to(
        std::back_inserter(out),
        R"(<figure><div class="frame" style="--shape:{:.4g}"><button type="button" class="picture{}" aria-label="Enlarge: {}"><img src="data:image/png;base64,{}" )"
        R"(width="{}" height="{}" alt="{}, {}" decoding="async"></button>{}</div><figcaption>{}</figcaption></figure>)"
        "\n",
        static_cast<double>(width) / static_cast<double>(height), width <= pixelated_up_to_px ? " small" : "", title,
        data, width, height, scene, title, marks, title);
}

void add_strip(Out &out, const std::vector<const ReportPicture *> &pictures, const std::string &scene,
               std::string_view kind, std::size_t columns) {
    if (pictures.empty()) return;
    fmt::format_to(std::back_inserter(out), "<div class=\"strip {}\" style=\"--n:{}\">\n", kind, columns);
    for (const ReportPicture *picture : pictures) add_picture(out, *picture, scene);
    out += "</div>\n";
}

/// The picture that shows a claim best: the first with something drawn on it, or else the first.
std::string key_experiment(const ClaimResult &claim) {
    const auto marked = std::ranges::find_if(claim.pictures, [](const ReportPicture &p) { return !p.marks.empty(); });
    if (marked != claim.pictures.end()) return marked->experiment;
    return claim.pictures.empty() ? "" : claim.pictures.front().experiment;
}

bool all_rows_hold(const ClaimResult &claim, const std::string &experiment) {
    const auto bad = [&](const auto &x) { return x.experiment == experiment && x.verdict != Verdict::holds; };
    return std::ranges::none_of(claim.rows, bad) && std::ranges::none_of(claim.tiles, bad);
}

} // namespace

PictureSize png_size(std::string_view png) {
    if (png.size() < 24 || !png.starts_with("\x89PNG") || png.substr(12, 4) != "IHDR") return {};
    const auto big_endian = [&](std::size_t at) {
        std::size_t value = 0;
        for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<std::uint8_t>(png[i]);
        return value;
    };
    return {big_endian(16), big_endian(20)};
}

void add_pictures(Out &out, const ClaimResult &claim, const Layout &layout) {
    std::vector<std::string> experiments;
    for (const ReportPicture &picture : claim.pictures)
        if (std::ranges::find(experiments, picture.experiment) == experiments.end())
            experiments.push_back(picture.experiment);
    const std::string key = layout.key_picture ? key_experiment(claim) : "";
    for (const std::string &experiment : experiments) {
        std::vector<const ReportPicture *> renders, others;
        std::vector<const Mark *> marks;
        for (const ReportPicture &picture : claim.pictures)
            if (picture.experiment == experiment) {
                (is_render(picture) ? renders : others).push_back(&picture);
                for (const Mark &mark : picture.marks) marks.push_back(&mark);
            }
        const std::string title = html_text(one_line(experiment_title(claim, experiment)));
        const std::size_t columns = std::min(std::max(renders.size(), others.size()), greatest_columns);
        if (layout.folds)
            fmt::format_to(std::back_inserter(out),
                           "<details class=\"fold experiment\" data-title=\"{1}\"{2}><summary><h{0}>{1}</h{0}> <span "
                           "class=\"quiet\">{3}</span></summary>\n",
                           layout.heading, title, experiment == key || !all_rows_hold(claim, experiment) ? " open" : "",
                           count(std::ssize(renders) + std::ssize(others), "picture"));
        else
            fmt::format_to(std::back_inserter(out),
                           "<section class=\"experiment\" data-title=\"{1}\">\n<h{0}>{1}</h{0}>\n", layout.heading,
                           title);
        add_strip(out, renders, title, "renders", columns);
        out += marks_legend(marks);
        add_strip(out, others, title, "others", columns);
        out += layout.folds ? "</details>\n" : "</section>\n";
    }
}

} // namespace threefold::report
