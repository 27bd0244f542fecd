// SPDX-License-Identifier: MIT
#include "verifier/check/pictures.h"

#include <algorithm>

#include <fmt/format.h>

#include "exporter/image/image_io.h"
#include "verifier/agreement/tiles.h"

namespace threefold {

namespace {

constexpr double most_quantisation = 0.25; ///< of the tolerance

} // namespace

std::vector<TileComparison> compared_pictures(const Experiment &e, const std::vector<Testimony> &testimonies,
                                              double level) {
    std::vector<TileComparison> all;
    if (!e.tile_budget) return all;
    for (std::size_t i = 0; i < testimonies.size(); ++i)
        for (std::size_t j = i + 1; j < testimonies.size(); ++j) {
            const Testimony &a = testimonies[i], &b = testimonies[j];
            const std::vector<BudgetItem> budget =
                e.tile_budget(a.rendered.record.accuracy, b.rendered.record.accuracy);
            TileComparison tiles = compare_tiles(a.rendered.images, b.rendered.images, e.tile_px, total(budget),
                                                 e.tiles_needed_share, e.shift_replicates, level);
            tiles.experiment = e.name;
            tiles.witness = a.witness->name;
            tiles.versus = b.witness->name;
            tiles.budget = budget;
            // Too coarse numbers say nothing of how well the pictures agree.
            const double steps = a.rendered.record.accuracy.radiance_step + b.rendered.record.accuracy.radiance_step;
            if (steps > most_quantisation * tiles.tolerance) {
                tiles.verdict = Verdict::undecided;
                tiles.replicates_to_decide.reset();
                tiles.problem = fmt::format("the pictures store radiance to {:.3g} only, the tolerance is {:.3g}",
                                            steps, tiles.tolerance);
            }
            all.push_back(std::move(tiles));
        }
    return all;
}

std::vector<ReportPicture> report_pictures(const Experiment &e, const std::vector<Testimony> &testimonies,
                                           const std::vector<TileComparison> &compared) {
    std::vector<ReportPicture> pictures;
    std::vector<Image> means;
    for (const Testimony &t : testimonies) {
        means.push_back(mean(t.rendered.images));
        pictures.push_back({ReportPicture::Kind::render, e.name, t.witness->title, encode_png_preview(means.back())});
        if (e.draw) pictures.back().marks = e.draw(means.back(), e.scene.camera);
    }
    for (const TileComparison &tiles : compared) {
        const auto index = [&](const std::string &name) {
            const auto found = std::ranges::find(testimonies, name, [](const Testimony &t) { return t.witness->name; });
            return static_cast<std::size_t>(found - testimonies.begin());
        };
        const std::size_t a = index(tiles.witness), b = index(tiles.versus);
        const double scale = 0.1 * tiles.mean_radiance;
        pictures.push_back({ReportPicture::Kind::difference, e.name,
                            fmt::format("{} minus {}: red brighter, blue darker, full colour at 10 % of the mean",
                                        testimonies[a].witness->title, testimonies[b].witness->title),
                            encode_png_preview(difference_picture(means[a], means[b], scale))});
    }
    return pictures;
}

} // namespace threefold
