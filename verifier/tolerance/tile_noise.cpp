// SPDX-License-Identifier: MIT
#include "verifier/tolerance/tile_noise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/poisson.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "verifier/agreement/equivalence.h"
#include "verifier/agreement/tiles.h"
#include "verifier/measure/tile_grid.h"
#include "verifier/tracer/sampler.h"

namespace threefold {

namespace {

constexpr int pilot_share = 4; ///< the pilot's pictures have so many times fewer samples

/// Chance that a tile is found to hold whose mean has the standard error 1 and no error besides: |z| + t s <=
/// tolerance, z normal and s^2 (n - 1) of chi squared, by Simpson's rule over the quantiles of s^2.
class ChanceToHold {
public:
    ChanceToHold(int replicates, double level) {
        const double freedom = replicates - 1;
        const boost::math::chi_squared spread(freedom);
        const double t = boost::math::quantile(complement(boost::math::students_t(freedom), level));
        for (int i = 0; i <= steps; ++i) {
            const double share = std::clamp(static_cast<double>(i) / steps, 1e-9, 1 - 1e-9);
            taken_.at(static_cast<std::size_t>(i)) = t * std::sqrt(boost::math::quantile(spread, share) / freedom);
        }
    }

    double operator()(double tolerance) const {
        const boost::math::normal normal;
        double sum = 0;
        for (int i = 0; i <= steps; ++i) {
            const double room = tolerance - taken_.at(static_cast<std::size_t>(i));
            const double weight = i == 0 || i == steps ? 1 : i % 2 ? 4 : 2;
            if (room > 0) sum += weight * (2 * boost::math::cdf(normal, room) - 1);
        }
        return sum / (3 * steps);
    }

private:
    static constexpr int steps = 64;
    std::array<double, steps + 1> taken_{}; ///< of the tolerance, by the interval's half width
};

} // namespace

std::vector<double> tile_noise(const Image &a, const Image &b, int tile_px) {
    std::vector<double> deviations;
    for (const PixelRectangle &tile : TileGrid(a.width, a.height, tile_px).tiles()) {
        Rgb squares(0);
        for (int row = tile.top; row < tile.bottom; ++row)
            for (int column = tile.left; column < tile.right; ++column) {
                const Rgb d = a.at(column, row) - b.at(column, row);
                squares += d * d;
            }
        // The difference has twice a picture's variance.
        deviations.push_back(std::sqrt(std::max({squares.r, squares.g, squares.b}) / 2) / tile.pixels());
    }
    return deviations;
}

double expected_open(std::span<const double> deviations, int replicates, double tolerance, double level) {
    // The chance by the tolerance over the standard error, in steps: every tile needs it.
    constexpr double step = 0.05, surely = 20;
    static constexpr int steps = static_cast<int>(surely / step);
    const ChanceToHold chance_to_hold(replicates, level);
    std::vector<double> chance;
    for (int i = 0; i <= steps; ++i) chance.push_back(chance_to_hold(i * step));
    double sum = 0;
    for (const double deviation : deviations) {
        const double x = tolerance * std::sqrt(static_cast<double>(replicates)) / deviation / step; // or infinite
        if (x < steps) sum += 1 - chance[static_cast<std::size_t>(x)];
    }
    return sum;
}

int samples_for_tiles(const Witness &witness, const RenderJob &job, const TilesWanted &wanted,
                      const RenderOptions &options) {
    RenderJob pilot = job;
    pilot.samples_per_pixel = std::max(1, wanted.least_samples / pilot_share);
    pilot.replicates.clear();
    for (std::uint64_t k = 0; k < 2; ++k)
        pilot.replicates.push_back({tracer::mix(tracer::mix(job.replicates.front().seed + 500) + k), {0, 0}});
    RenderOptions quiet = options;
    quiet.on_progress = nullptr; // the share is that of the picture to come
    quiet.label += "-pilot";
    const std::vector<Image> pictures = render(witness, pilot, quiet).images;
    const std::vector<double> few = tile_noise(pictures[0], pictures[1], wanted.tile_px);
    const int allowed = tiles_allowed(static_cast<int>(few.size()), wanted.needed_share);
    const double level = tile_level(first_look, allowed);
    constexpr double chance = 0.9;
    const auto replicates = static_cast<int>(job.replicates.size());
    int samples = wanted.least_samples;
    while (samples < wanted.most_samples) {
        // Less noise is as good as more tolerance.
        const double finer = std::sqrt(static_cast<double>(samples) / pilot.samples_per_pixel);
        const double open = expected_open(few, replicates, wanted.tolerance * finer, level);
        if (open == 0 || boost::math::cdf(boost::math::poisson(open), allowed - allowed / 2) >= chance) break;
        samples = std::min(wanted.most_samples, samples + std::max(1, samples / 20));
    }
    return samples;
}

} // namespace threefold
