// SPDX-License-Identifier: MIT
// gallery: the study's figures, once per renderer.
#include <algorithm>

#include <fmt/format.h>

#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "tools/commands.h"
#include "tools/progress.h"
#include "verifier/gallery/gallery.h"

namespace threefold {

namespace {

constexpr double usual_scale = 0.5, quick_scale = 0.25;
constexpr int usual_samples = 9, quick_samples = 4; // squares: some renderers sample on a grid
constexpr double least_scale = 0.02, greatest_scale = 4;

std::vector<Figure> asked_figures(const std::vector<std::string> &numbers) {
    std::vector<Figure> figures = study_figures();
    if (numbers.empty()) return figures;
    std::vector<std::string> valid;
    for (const Figure &figure : figures) valid.push_back(figure.number);
    for (const std::string &number : numbers)
        if (std::ranges::count(valid, number) == 0) throw Error(Exit::usage, unknown_name("figure", number, valid));
    std::erase_if(figures, [&](const Figure &figure) { return std::ranges::count(numbers, figure.number) == 0; });
    return figures;
}

} // namespace

Exit command_gallery(const Shop &shop, const GalleryCommand &command) {
    GalleryRequest request;
    request.figures = asked_figures(command.figures);
    request.scenes = shop.scenes;
    request.preset = parse_preset(command.preset);
    for (const std::string &text : command.assignments) request.assignments.push_back(parse_assignment(text));
    request.scale = command.scale.value_or(command.quick ? quick_scale : usual_scale);
    if (!(request.scale >= least_scale && request.scale <= greatest_scale))
        throw Error(Exit::bad_data,
                    fmt::format("--scale must lie in [{}, {}], not {}", least_scale, greatest_scale, request.scale));
    request.samples_per_pixel = command.samples_per_pixel.value_or(command.quick ? quick_samples : usual_samples);
    if (request.samples_per_pixel < 1) throw Error(Exit::bad_data, "--spp must be at least 1");
    request.seed = command.seed;
    request.threads = shop.threads;
    request.time_limit = to_time_limit(command.time_limit_s);
    request.folder = command.folder;
    std::vector<std::string> names;
    for (Witness &w : asked_witnesses(command.with))
        if (w.present()) {
            names.push_back(w.name);
            request.witnesses.push_back(std::move(w));
        } else if (shop.verbosity >= 0) {
            say(fmt::format("without {}: it is not installed", w.title));
        }
    Progress progress(names, shop.verbosity < 0);
    request.on_progress = [&progress](const std::string &witness, double share, const std::string &now) {
        progress.update(witness, share, now);
    };
    const Gallery gallery = make_gallery(request);
    progress.finish();

    write_image(command.folder / "contact-sheet.png", contact_sheet(gallery));
    const std::filesystem::path index = command.folder / "index.html";
    write_file_atomically(index, to_index(gallery, request, shop.command_line));
    for (const GalleryFigure &figure : gallery.figures) {
        if (!figure.missing.empty() && shop.verbosity >= 0)
            say(fmt::format("figure {} is missing: no scene {} in this catalogue", figure.number, figure.missing));
        for (const GalleryPicture &picture : figure.pictures)
            if (picture.file.empty())
                say(fmt::format("figure {} by {}: {}", figure.number, picture.title, picture.problem));
    }
    fmt::print("{}\n", index.string());
    return gallery.exit;
}

} // namespace threefold
