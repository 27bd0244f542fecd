// SPDX-License-Identifier: MIT
#include "verifier/agreement/tiles.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "verifier/measure/radiance.h"
#include "verifier/measure/tile_grid.h"

namespace threefold {

namespace {

Estimate of_channel(const std::vector<Image> &tiles, std::size_t tile, int channel) {
    std::vector<double> values;
    for (const Image &image : tiles) values.push_back(image.pixels[tile][channel]);
    return estimate(values);
}

/// Judges the differences of all tiles; `difference_of(tile, channel)` has the noise.
template <class DifferenceOf>
TileComparison judge_tiles(int columns, int rows, int tile_px, double tolerance, double needed_share, double level,
                           DifferenceOf difference_of) {
    TileComparison c;
    c.tile_px = tile_px;
    c.columns = columns;
    c.rows = rows;
    c.tolerance = tolerance;
    c.needed_share = needed_share;
    c.level = level;
    c.allowed = tiles_allowed(columns * rows, needed_share);
    const double own_level = tile_level(level, c.allowed);
    std::vector<double> p_values;          // of each tile
    std::vector<double> replicates_needed; // by each open tile
    for (int tile = 0; tile < columns * rows; ++tile) {
        Verdict verdict = Verdict::holds;
        double needed = 0, p_value = 1;
        for (int channel = 0; channel < 3; ++channel) {
            const Estimate d = difference_of(static_cast<std::size_t>(tile), channel);
            const Verdict v = judge(d, Relation::equal, 0, tolerance, own_level);
            verdict = all_of(verdict, v);
            p_value = std::min(p_value, 3 * p_value_of_difference(d, 0, tolerance));
            if (v == Verdict::undecided) {
                const auto n = replicates_to_decide(d, Relation::equal, 0, tolerance, own_level);
                needed = std::max(needed, n ? *n : std::numeric_limits<double>::infinity());
            }
            if (std::abs(d.mean) > std::abs(c.worst_difference)) {
                c.worst_difference = d.mean;
                c.worst_column = tile % columns;
                c.worst_row = tile / columns;
            }
        }
        p_values.push_back(p_value);
        switch (verdict) {
        case Verdict::holds:
            ++c.holding;
            break;
        case Verdict::fails:
            ++c.failing;
            break;
        case Verdict::undecided:
            ++c.open;
            replicates_needed.push_back(needed);
            break;
        }
    }
    if (more_differ_than(c.allowed, std::move(p_values), level))
        c.verdict = Verdict::fails;
    else
        c.verdict = c.failing + c.open <= c.allowed ? Verdict::holds : Verdict::undecided;
    if (c.verdict == Verdict::undecided && c.failing <= c.allowed) {
        // As many of the open tiles as must still hold, the easiest first.
        std::ranges::sort(replicates_needed);
        const auto to_settle = static_cast<std::size_t>(c.failing + c.open - c.allowed);
        const double needed = replicates_needed.at(to_settle - 1);
        if (std::isfinite(needed)) c.replicates_to_decide = static_cast<int>(needed);
    }
    return c;
}

/// Share of `a` in the summed variance of all tiles' means; a half where there is no noise at all.
double share_of_noise(const std::vector<Image> &tiles_a, const std::vector<Image> &tiles_b) {
    const auto variance = [](const std::vector<Image> &tiles) {
        double sum = 0;
        for (std::size_t tile = 0; tile < tiles.front().pixels.size(); ++tile)
            for (int channel = 0; channel < 3; ++channel) {
                const double e = of_channel(tiles, tile, channel).standard_error;
                sum += e * e;
            }
        return sum;
    };
    const double a = variance(tiles_a), b = variance(tiles_b);
    return a + b > 0 && std::isfinite(a + b) ? a / (a + b) : 0.5;
}

} // namespace

int tiles_allowed(int tiles, double needed_share) { return static_cast<int>((1 - needed_share) * tiles + 1e-9); }

double tile_level(double level, int allowed) { return level / (allowed + 1); }

TileComparison compare_tiles(const std::vector<Image> &a, const std::vector<Image> &b, int tile_px, double tolerance,
                             double needed_share, bool paired, double level) {
    std::vector<Image> tiles_a, tiles_b;
    for (const Image &image : a) tiles_a.push_back(tile_means(image, tile_px));
    for (const Image &image : b) tiles_b.push_back(tile_means(image, tile_px));
    TileComparison c =
        judge_tiles(tiles_a.front().width, tiles_a.front().height, tile_px, tolerance, needed_share, level,
                    [&](std::size_t tile, int channel) {
                        if (!paired)
                            return difference(of_channel(tiles_a, tile, channel), of_channel(tiles_b, tile, channel));
                        std::vector<double> differences;
                        for (std::size_t k = 0; k < std::min(tiles_a.size(), tiles_b.size()); ++k)
                            differences.push_back(tiles_a[k].pixels[tile][channel] - tiles_b[k].pixels[tile][channel]);
                        return estimate(differences);
                    });
    c.mean_radiance = (mean_radiance(mean(a)) + mean_radiance(mean(b))) / 2;
    if (!paired) c.noise_of_witness = share_of_noise(tiles_a, tiles_b);
    c.replicates = static_cast<int>(std::min(a.size(), b.size()));
    return c;
}

TileComparison compare_tiles_of_single_pictures(const Image &a, const Image &b, int tile_px, double tolerance) {
    Image d(a.width, a.height), squares(a.width, a.height);
    for (std::size_t i = 0; i < d.pixels.size(); ++i) {
        d.pixels[i] = a.pixels[i] - b.pixels[i];
        squares.pixels[i] = d.pixels[i] * d.pixels[i];
    }
    const Image means = tile_means(d, tile_px), mean_squares = tile_means(squares, tile_px);
    const std::vector<PixelRectangle> tiles = TileGrid(a.width, a.height, tile_px).tiles();
    TileComparison c =
        judge_tiles(means.width, means.height, tile_px, tolerance, 1, significance, [&](std::size_t tile, int channel) {
            const double m = means.pixels[tile][channel], n = tiles[tile].pixels();
            const double variance = std::max(0.0, mean_squares.pixels[tile][channel] - m * m) * n / (n - 1);
            return Estimate{m, std::sqrt(variance / n), n - 1, 1};
        });
    c.mean_radiance = (mean_radiance(a) + mean_radiance(b)) / 2;
    return c;
}

Image difference_picture(const Image &a, const Image &b, double full_scale) {
    Image picture(a.width, a.height);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const Rgb d = a.pixels[i] - b.pixels[i];
        const double t = std::clamp((d.r + d.g + d.b) / 3 / full_scale, -1.0, 1.0);
        const Rgb towards = t > 0 ? Rgb(0.6, 0.02, 0.02) : Rgb(0.02, 0.08, 0.6);
        picture.pixels[i] = Rgb(0.5) * (1 - std::abs(t)) + towards * std::abs(t);
    }
    return picture;
}

} // namespace threefold
