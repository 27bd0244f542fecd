// SPDX-License-Identifier: MIT
// Are samples chosen so that tiles can be told to agree?
#include <random>

#include <gtest/gtest.h>

#include "verifier/agreement/tiles.h"
#include "verifier/tolerance/tile_noise.h"

namespace threefold {
namespace {

constexpr int tile_px = 8;

/// 1 everywhere, with noise that grows from left to right, up to `noise` a pixel.
Image noisy(unsigned seed, double noise, int width = 512, int height = 256) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> normal;
    Image image(width, height);
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column)
            image.pixels[static_cast<std::size_t>(row * width + column)] =
                Rgb(1 + noise * (column / tile_px * tile_px) / width * normal(generator));
    return image;
}

TEST(TileNoise, IsThatOfEachTile) {
    const std::vector<double> d = tile_noise(noisy(1, 0.4), noisy(2, 0.4), tile_px);
    ASSERT_EQ(d.size(), 64u * 32u);
    EXPECT_EQ(d[0], 0);
    for (const std::size_t column : {8u, 32u, 63u}) {
        double mean = 0;
        for (std::size_t row = 0; row < 32; ++row) mean += d[64 * row + column] / 32;
        const double expected = 0.4 * static_cast<double>(column) / 64 / tile_px;
        EXPECT_NEAR(mean, expected, 0.05 * expected) << column;
    }
}

TEST(TileNoise, TilesAreThoseThatAComparisonJudges) {
    for (const auto &[width, height] : {std::pair(68, 10), {88, 130}, {5, 9}, {64, 64}}) {
        const Image a = noisy(1, 0.4, width, height), b = noisy(2, 0.4, width, height);
        const TileComparison judged = compare_tiles({a, a}, {b, b}, tile_px, 1);
        EXPECT_EQ(tile_noise(a, b, tile_px).size(), static_cast<std::size_t>(judged.columns * judged.rows));
        EXPECT_EQ(judged.columns * judged.rows, judged.holding + judged.failing + judged.open);
    }
    EXPECT_EQ(tile_noise(noisy(1, 0.4, 88, 130), noisy(2, 0.4, 88, 130), 16).size(), 40u);
}

TEST(TileNoise, GivesTheNumberOfTilesThatStayOpen) {
    const std::vector<Image> exact(5, noisy(0, 0));
    for (const double tolerance : {0.02, 0.05, 0.08}) {
        std::vector<Image> others;
        for (unsigned k = 0; k < 5; ++k) others.push_back(noisy(10 + k, 0.4));
        // Grey pictures: the three channels are one.
        const TileComparison t = compare_tiles(others, exact, tile_px, tolerance, 1, true, first_look);
        const double tiles = t.columns * t.rows, held = t.holding / tiles;
        const double open =
            expected_open(tile_noise(noisy(1, 0.4), noisy(2, 0.4), tile_px), 5, tolerance, first_look) / tiles;
        EXPECT_NEAR(held, 1 - open, 0.02) << tolerance;
        EXPECT_GT(held, 0.2);
        EXPECT_LT(held, 1);
    }
}

TEST(TileNoise, NoNoiseIsNoDoubt) {
    const std::vector<double> none(100, 0.0);
    EXPECT_EQ(expected_open(none, 5, 1e-9, first_look), 0);
}

} // namespace
} // namespace threefold
