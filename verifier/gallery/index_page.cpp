// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iterator>

#include <fmt/format.h>

#include "verifier/gallery/gallery.h"
#include "verifier/report/html_parts.h"
#include "verifier/report/numbers.h"
#include "verifier/report/text.h"

namespace threefold {

namespace {

using namespace report;

std::string anchor(const GalleryFigure &figure) { return "figure-" + slug(figure.number); }

void add_picture(Out &out, const GalleryFigure &figure, const GalleryPicture &picture) {
    const std::string title = plain(picture.title);
    if (picture.file.empty())
        fmt::format_to(std::back_inserter(out), "<figure><p class=\"quiet\">No picture: {}</p>",
                       plain(picture.problem));
    else
        fmt::format_to(
            std::back_inserter(out),
            R"(<figure><a href="{0}"><img src="{0}" width="{1}" height="{2}" alt="Figure {3} by {4}" loading="lazy"></a>)",
            plain(picture.file), picture.width_px, picture.height_px, plain(figure.number), title);
    fmt::format_to(std::back_inserter(out), "<figcaption>{}{}</figcaption></figure>\n", title,
                   picture.seconds > 0 ? ", " + typeset(duration(picture.seconds)) : "");
}

void add_figure(Out &out, const GalleryFigure &figure) {
    fmt::format_to(std::back_inserter(out),
                   "<article class=\"claim\" id=\"{}\">\n<h2>Figure {}</h2>\n<p class=\"summary\">{}</p>\n"
                   "<div class=\"strip\" style=\"--n:{}\">\n",
                   anchor(figure), plain(figure.number), html_text(figure.caption),
                   std::clamp<std::size_t>(figure.pictures.size(), 1, 4));
    for (const GalleryPicture &picture : figure.pictures) add_picture(out, figure, picture);
    out += "</div>\n";
    const bool is_mean = figure.sources.size() > 1;
    for (const std::string &source : figure.sources)
        fmt::format_to(std::back_inserter(out), "<p class=\"quiet\">{}<code>{}</code></p>\n",
                       !is_mean                             ? "Scene "
                       : &source == &figure.sources.front() ? "The mean of "
                                                            : "and of ",
                       plain(source));
    if (!figure.instead_of.empty())
        fmt::format_to(std::back_inserter(out), "<p class=\"quiet\">In place of {}, which this catalogue lacks.</p>\n",
                       plain(figure.instead_of));
    out += "<details><summary>Commands that repeat each picture</summary>\n<pre><code>";
    for (const GalleryPicture &picture : figure.pictures)
        for (const std::string &command : picture.commands) out += plain(command) + "\n";
    out += "</code></pre></details>\n</article>\n";
}

constexpr std::string_view gallery_style = R"css(
.strip img { display: block; width: 100%; height: auto; background: var(--mat); }
.contents { columns: 3 16rem; padding-left: 0; list-style: none; margin: 0; } .contents li { break-inside: avoid; margin-bottom: .4rem; }
.sheet { display: block; max-width: 100%; height: auto; }
)css";

} // namespace

std::string to_index(const Gallery &gallery, const GalleryRequest &request, const std::string &command) {
    Out out;
    fmt::format_to(
        std::back_inserter(out),
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src 'self' file:; style-src "
        "'unsafe-inline'; base-uri 'none'; form-action 'none'\">\n"
        "<meta name=\"color-scheme\" content=\"light dark\">\n<title>Threefold: the study's figures</title>\n"
        "<style>\n{}{}</style>\n</head>\n<body>\n",
        page_style, gallery_style);
    fmt::format_to(std::back_inserter(out),
                   "<header class=\"top\">\n<p class=\"origin\">Preset {} · {} of the study's size · {} a pixel</p>\n"
                   "<h1>The study's figures</h1>\n<p class=\"lead\">Each scene is described once and rendered by every "
                   "renderer. Shown: {}.</p>\n</header>\n<main>\n",
                   to_string(request.preset), percent(request.scale), count(request.samples_per_pixel, "sample"),
                   tone_curve);
    std::string contents, missing;
    for (const GalleryFigure &figure : gallery.figures)
        if (figure.missing.empty())
            fmt::format_to(std::back_inserter(contents), "<li><a href=\"#{}\">{}</a> {}</li>\n", anchor(figure),
                           plain(figure.number), html_text(figure.caption));
        else
            fmt::format_to(std::back_inserter(missing),
                           "<li>{}: {} <span class=\"quiet\">Needs the scene {}.</span></li>\n", plain(figure.number),
                           html_text(figure.caption), plain(figure.missing));
    if (!contents.empty())
        out += "<section><h2>Contents</h2>\n<ul class=\"contents\">\n" + contents +
               "</ul>\n<p><a href=\"contact-sheet.png\">All on one sheet</a></p>\n</section>\n";
    for (const GalleryFigure &figure : gallery.figures)
        if (figure.missing.empty()) add_figure(out, figure);
    if (!missing.empty())
        out += "<section id=\"missing\"><h2>Not in this catalogue</h2>\n<ul>\n" + missing + "</ul>\n</section>\n";
    fmt::format_to(std::back_inserter(out),
                   "<section class=\"record\"><h2>How to repeat this</h2>\n<pre><code>{}</code></pre>\n</section>\n"
                   "</main>\n</body>\n</html>\n",
                   html_text(command));
    return out;
}

} // namespace threefold
