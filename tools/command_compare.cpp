// SPDX-License-Identifier: MIT
// compare: any two or three pictures, tile by tile.
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "tools/commands.h"
#include "verifier/agreement/tiles.h"
#include "verifier/measure/radiance.h"

namespace threefold {

namespace {

using Json = nlohmann::ordered_json;

struct Picture {
    std::filesystem::path path;
    Image image;
};

double root_mean_square(const Image &a, const Image &b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const Rgb d = a.pixels[i] - b.pixels[i];
        sum += (d.r * d.r + d.g * d.g + d.b * d.b) / 3;
    }
    return std::sqrt(sum / static_cast<double>(a.pixels.size()));
}

} // namespace

Exit command_compare(const Shop &shop, const CompareRequest &request) {
    if (request.tile_px < 2) throw Error(Exit::bad_data, "--tile must be at least 2 px");
    if (!(request.tolerance > 0) || !std::isfinite(request.tolerance))
        throw Error(Exit::bad_data, "--tolerance must be a positive number");
    std::vector<Picture> pictures;
    for (const auto &path : request.pictures) {
        pictures.push_back({path, read_image(path)});
        const Image &first = pictures.front().image, &image = pictures.back().image;
        if (image.width != first.width || image.height != first.height)
            throw Error(Exit::bad_data,
                        fmt::format("{} is {} x {} px, but {} is {} x {} px", path.string(), image.width, image.height,
                                    pictures.front().path.string(), first.width, first.height));
    }
    if (pictures.front().image.pixels.size() < 4)
        throw Error(Exit::bad_data, "the pictures are too small: a tile needs some pixels to tell its noise from");
    double mean_of_all = 0;
    for (const Picture &p : pictures) mean_of_all += mean_radiance(p.image) / static_cast<double>(pictures.size());
    const double tolerance = request.tolerance * std::abs(mean_of_all);
    if (!std::isfinite(tolerance)) throw Error(Exit::bad_data, "the pictures are too bright to be compared");
    if (!(tolerance > 0)) throw Error(Exit::bad_data, "the pictures are black: a relative tolerance has no meaning");
    if (request.folder) make_folder(*request.folder);

    Verdict verdict = Verdict::holds;
    Json pairs = Json::array();
    for (std::size_t i = 0; i < pictures.size(); ++i)
        for (std::size_t j = i + 1; j < pictures.size(); ++j) {
            const Picture &a = pictures[i], &b = pictures[j];
            const TileComparison t = compare_tiles_of_single_pictures(a.image, b.image, request.tile_px, tolerance);
            verdict = all_of(verdict, t.verdict);
            const double rms = root_mean_square(a.image, b.image),
                         bias = mean_radiance(a.image) - mean_radiance(b.image);
            if (!request.json || *request.json != "-")
                fmt::print("{} against {}: {}\n"
                           "  {} of {} tiles agree, {} differ, {} undecided (tolerance {:.3g}, {:.3g} % of the mean "
                           "radiance)\n"
                           "  worst tile at ({}, {}) px: {:+.3g}; RMS {:.3g}; mean difference {:+.3g}\n",
                           a.path.string(), b.path.string(), to_string(t.verdict), t.holding, t.columns * t.rows,
                           t.failing, t.open, tolerance, 100 * request.tolerance, t.worst_column * t.tile_px,
                           t.worst_row * t.tile_px, t.worst_difference, rms, bias);
            std::string map;
            if (request.folder) {
                map = fmt::format("difference-{}-{}.png", i + 1, j + 1);
                write_file_atomically(*request.folder / map,
                                      encode_png_preview(difference_picture(a.image, b.image, 10 * tolerance)));
            }
            pairs.push_back({{"a", a.path.string()},
                             {"b", b.path.string()},
                             {"verdict", to_string(t.verdict)},
                             {"tile_px", t.tile_px},
                             {"tiles", t.columns * t.rows},
                             {"holding", t.holding},
                             {"failing", t.failing},
                             {"undecided", t.open},
                             {"tolerance", tolerance},
                             {"worst_difference", t.worst_difference},
                             {"worst_tile_px", {t.worst_column * t.tile_px, t.worst_row * t.tile_px}},
                             {"rms", rms},
                             {"mean_difference", bias},
                             {"map", map}});
        }
    const Json all{
        {"schema_version", 1}, {"verdict", to_string(verdict)}, {"mean_radiance", mean_of_all}, {"pairs", pairs}};
    if (request.json) write_result(*request.json, all.dump(1, ' ', false, Json::error_handler_t::replace));
    if (request.folder && shop.verbosity >= 0)
        say(fmt::format("maps (red: first brighter, blue: darker; full colour at ten tolerances) in {}",
                        request.folder->string()));
    switch (verdict) {
    case Verdict::holds:
        return Exit::holds;
    case Verdict::fails:
        return Exit::fails;
    case Verdict::undecided:
        return Exit::undecided;
    }
    return Exit::internal;
}

} // namespace threefold
