// SPDX-License-Identifier: MIT
#include "verifier/check/look.h"

#include <algorithm>

#include "verifier/check/plan.h"

namespace threefold {

namespace {

constexpr int fewest_replicates = 4; ///< that tell their own spread well enough

/// Through given points of the pixels only what is drawn at random has noise.
bool is_noisy(const Witness &w, const Experiment &e) {
    return !w.pictures && (e.sampling == Sampling::box || (w.adapter && w.adapter->sample_factor > 1));
}

bool compares_a_share_of_tiles(const Experiment &e) { return e.tile_budget && e.tiles_needed_share != 1; }

} // namespace

RenderJob Look::job() const {
    Experiment longer = *experiment;
    longer.replicates = replicates;
    if (samples_per_pixel) longer.samples_per_pixel = *samples_per_pixel;
    RenderJob job = job_of(longer, seed, 0);
    job.replicates.erase(job.replicates.begin(), job.replicates.begin() + first);
    return fault ? with_fault(std::move(job), *fault) : job;
}

double Look::work() const {
    const Camera &camera = experiment->scene.camera;
    return 2 + 1e-6 * camera.image_width_px() * camera.image_height_px() *
                   samples_per_pixel.value_or(experiment->samples_per_pixel) * (replicates - first);
}

int first_replicates(const Witness &w, const Experiment &e, const std::vector<Experiment> &all) {
    const bool is_paired = !e.partner.empty() || std::ranges::count(all, e.name, &Experiment::partner) > 0;
    const bool decides_noise = e.tile_budget && (e.shift_replicates || (w.adapter && w.adapter->sample_factor > 1));
    if (w.pictures || is_paired || compares_a_share_of_tiles(e) || decides_noise) return e.replicates;
    return std::min(e.replicates, fewest_replicates);
}

std::optional<NoiseWanted> noise_wanted(const Witness &w, const Experiment &e, std::optional<double> tolerance) {
    if (!tolerance || !is_noisy(w, e)) return std::nullopt;
    const bool box = e.sampling == Sampling::box;
    if (!box && !e.tile_budget) return std::nullopt;
    NoiseWanted wanted{*tolerance};
    if (!box || !e.tile_budget) wanted.least_samples = e.samples_per_pixel;
    if (!e.tile_budget) return wanted;
    // Of independent pixels a tile's mean has 1 / tile_px of their noise; an interval within the tolerance takes
    // four standard errors or so.
    constexpr double standard_errors = 4;
    wanted.absolute = total(e.tile_budget(Accuracy{}, Accuracy{})) * e.tile_px / standard_errors;
    return wanted;
}

std::optional<TilesWanted> tiles_wanted(const Witness &w, const Experiment &e) {
    if (!compares_a_share_of_tiles(e) || e.sampling == Sampling::box || !is_noisy(w, e)) return std::nullopt;
    constexpr int most_times = 16; // as long does it take at most
    return TilesWanted{e.tile_px, total(e.tile_budget(Accuracy{}, Accuracy{})), e.tiles_needed_share,
                       e.samples_per_pixel, most_times * e.samples_per_pixel};
}

} // namespace threefold
