// SPDX-License-Identifier: MIT
// Numbers to verdicts: equivalence, its error rates, and pictures tile by tile.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

#include "verifier/agreement/equivalence.h"
#include "verifier/agreement/tiles.h"

namespace threefold {
namespace {

std::vector<double> draw(std::mt19937_64 &random, double mean, double spread, int n) {
    std::normal_distribution<double> normal(mean, spread);
    std::vector<double> values;
    for (int k = 0; k < n; ++k) values.push_back(normal(random));
    return values;
}

TEST(Estimate, IsMeanAndStandardErrorOfTheMean) {
    const Estimate e = estimate(std::vector<double>{1, 2, 3, 4});
    EXPECT_DOUBLE_EQ(e.mean, 2.5);
    EXPECT_DOUBLE_EQ(e.standard_error, std::sqrt(5.0 / 3 / 4));
    EXPECT_EQ(e.degrees_of_freedom, 3);
}

TEST(Estimate, ANumberWithoutSpreadHasNoInterval) {
    const Interval i = interval(estimate(std::vector<double>{2, 2, 2}));
    EXPECT_EQ(i.low, 2);
    EXPECT_EQ(i.high, 2);
}

TEST(Estimate, TheIntervalIsStudentsNinetyPercent) {
    const Interval i = interval({0, 1, 7, 8});
    EXPECT_NEAR(i.high, 1.894579, 1e-6);
    EXPECT_NEAR(i.low, -1.894579, 1e-6);
}

TEST(Estimate, ADifferenceHasWelchsDegreesOfFreedom) {
    const Estimate d = difference({3, 1, 7, 8}, {1, 2, 7, 8});
    EXPECT_EQ(d.mean, 2);
    EXPECT_DOUBLE_EQ(d.standard_error, std::sqrt(5.0));
    EXPECT_NEAR(d.degrees_of_freedom, 25.0 / (1.0 / 7 + 16.0 / 7), 1e-12);
    EXPECT_EQ(difference({3, 0, INFINITY, 8}, {1, 2, 7, 8}).degrees_of_freedom, 7) << "a noiseless side adds none";
}

TEST(Judge, HoldsOnlyWithTheWholeIntervalInsideAndFailsOnlyWithAllOfItOutside) {
    EXPECT_EQ(judge({0.9, 1.1}, Relation::equal, 1, 0.2), Verdict::holds);
    EXPECT_EQ(judge({0.9, 1.3}, Relation::equal, 1, 0.2), Verdict::undecided);
    EXPECT_EQ(judge({1.21, 1.3}, Relation::equal, 1, 0.2), Verdict::fails);
    EXPECT_EQ(judge({0.5, 0.79}, Relation::equal, 1, 0.2), Verdict::fails);
    EXPECT_EQ(judge({0, 2}, Relation::equal, 1, 0.2), Verdict::undecided) << "noise is no agreement";
    EXPECT_EQ(judge({-2, -1}, Relation::below, 0, 0), Verdict::holds);
    EXPECT_EQ(judge({-2, 1}, Relation::below, 0, 0), Verdict::undecided);
    EXPECT_EQ(judge({0.1, 1}, Relation::below, 0, 0), Verdict::fails);
    EXPECT_EQ(judge({0.1, 1}, Relation::above, 0, 0), Verdict::holds);
    EXPECT_EQ(judge({NAN, NAN}, Relation::equal, 1, 0.2), Verdict::undecided) << "what was not measured is not agreed";
}

TEST(Judge, SaysHoldsOfANumberAtTheEdgeOfToleranceInAtMostFivePercent) {
    std::mt19937_64 random(7);
    int holds = 0;
    constexpr int trials = 4000;
    for (int k = 0; k < trials; ++k)
        holds += judge(interval(estimate(draw(random, 1.2, 0.05, 8))), Relation::equal, 1, 0.2) == Verdict::holds;
    EXPECT_LT(holds, trials * 0.05 + 4 * std::sqrt(trials * 0.05 * 0.95));
    EXPECT_GT(holds, trials * 0.05 - 4 * std::sqrt(trials * 0.05 * 0.95)) << "and is no stricter than it says";
}

TEST(Verdicts, AllOfThemHoldOnlyIfEachDoesAndOneFailureFails) {
    using enum Verdict;
    EXPECT_EQ(all_of(holds, holds), holds);
    EXPECT_EQ(all_of(holds, undecided), undecided);
    EXPECT_EQ(all_of(undecided, fails), fails);
}

TEST(ReplicatesToDecide, AreEnoughIfNothingChanges) {
    const Estimate e{1.1, 0.2, 7, 8};
    const auto n = replicates_to_decide(e, Relation::equal, 1, 0.2);
    ASSERT_TRUE(n);
    const double spread = e.standard_error * std::sqrt(8.0);
    const Estimate later{e.mean, spread / std::sqrt(*n), static_cast<double>(*n - 1), *n};
    EXPECT_EQ(judge(interval(later), Relation::equal, 1, 0.2), Verdict::holds);
    EXPECT_FALSE(replicates_to_decide({1.2, 0.2, 7, 8}, Relation::equal, 1, 0.2)) << "on the edge no number decides";
}

TEST(MoreDifferThan, FindsOneGreatDifferenceAmongManyAndNoneInNoise) {
    std::vector<double> p(1000, 0.5);
    EXPECT_FALSE(more_differ_than(0, p, 0.05));
    p[7] = 0.01;
    EXPECT_FALSE(more_differ_than(0, p, 0.05)) << "one in a hundred is nothing among a thousand";
    p[7] = 1e-5;
    EXPECT_TRUE(more_differ_than(0, p, 0.05));
    EXPECT_FALSE(more_differ_than(1, p, 0.05)) << "one is allowed";
    p[9] = 1e-5;
    EXPECT_TRUE(more_differ_than(1, p, 0.05));
    EXPECT_FALSE(more_differ_than(1000, p, 0.05));
}

RC_GTEST_PROP(JudgeProperty, AWiderToleranceNeverTurnsHoldsIntoAnythingElse, ()) {
    const double low = *rc::gen::inRange(-100, 100) / 10.0, width = *rc::gen::inRange(0, 50) / 10.0;
    const double tolerance = *rc::gen::inRange(0, 100) / 10.0;
    if (judge({low, low + width}, Relation::equal, 0, tolerance) == Verdict::holds)
        RC_ASSERT(judge({low, low + width}, Relation::equal, 0, tolerance * 1.5) == Verdict::holds);
}

std::vector<Image> noisy(std::uint64_t seed, double spread, double bias_in_one_tile = 0) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0, spread);
    std::vector<Image> all;
    for (int k = 0; k < 8; ++k) {
        Image image(40, 24);
        for (int row = 0; row < 24; ++row)
            for (int column = 0; column < 40; ++column) {
                image.at(column, row) = Rgb(0.3) + Rgb(normal(random), normal(random), normal(random));
                if (column >= 16 && column < 24 && row < 8) image.at(column, row).g += bias_in_one_tile;
            }
        all.push_back(std::move(image));
    }
    return all;
}

TEST(Tiles, AgreeWhenOnlyNoiseDiffers) {
    const TileComparison t = compare_tiles(noisy(1, 0.01), noisy(2, 0.01), 8, 0.005);
    EXPECT_EQ(t.columns, 5);
    EXPECT_EQ(t.rows, 3);
    EXPECT_EQ(t.holding, 15);
    EXPECT_EQ(t.verdict, Verdict::holds);
    EXPECT_NEAR(t.mean_radiance, 0.3, 1e-3);
}

TEST(Tiles, FailWhenOneChannelOfOneTileIsOff) {
    const TileComparison t = compare_tiles(noisy(1, 0.01), noisy(2, 0.01, 0.02), 8, 0.005);
    EXPECT_EQ(t.verdict, Verdict::fails);
    EXPECT_EQ(t.failing, 1);
    EXPECT_EQ(t.worst_column, 2);
    EXPECT_EQ(t.worst_row, 0);
    EXPECT_NEAR(t.worst_difference, -0.02, 0.003);
}

TEST(Tiles, MayDifferInAFewWhenASmallerShareIsAskedFor) {
    const TileComparison most = compare_tiles(noisy(1, 0.01), noisy(2, 0.01, 0.02), 8, 0.005, 0.9);
    EXPECT_EQ(most.verdict, Verdict::holds);
    EXPECT_EQ(most.failing, 1);
    EXPECT_EQ(most.needed_share, 0.9);
    EXPECT_EQ(compare_tiles(noisy(1, 0.01), noisy(2, 0.01, 0.02), 8, 0.005, 0.95).verdict, Verdict::fails);
}

/// Replicates of a picture whose tiles are single pixels: the first `beyond` have the mean `bias`.
std::vector<Image> tiles_of_one_pixel(std::mt19937_64 &random, int width, int height, int beyond, double bias) {
    std::normal_distribution<double> normal;
    std::vector<Image> all;
    for (int k = 0; k < 8; ++k) {
        Image image(width, height);
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            image.pixels[i] = Rgb((static_cast<int>(i) < beyond ? bias : 0) + normal(random));
        all.push_back(std::move(image));
    }
    return all;
}

constexpr int runs = 60;

double share_with(Verdict verdict, int width, int height, int beyond, double bias, double tolerance) {
    std::mt19937_64 random(7);
    const std::vector<Image> exact(8, Image(width, height));
    int found = 0;
    for (int run = 0; run < runs; ++run)
        found +=
            compare_tiles(tiles_of_one_pixel(random, width, height, beyond, bias), exact, 1, tolerance, 0.99).verdict ==
            verdict;
    return static_cast<double>(found) / runs;
}

// The level, and three standard deviations of so many runs.
constexpr double most_wrong = 0.05 + 0.085;

// One tile more than is allowed, each on the edge of the tolerance: the verdict "holds" is wrong.
TEST(Tiles, OfAShareHoldWronglyNoMoreOftenThanTheLevel) {
    EXPECT_EQ(tiles_allowed(256, 0.99), 2);
    EXPECT_EQ(tiles_allowed(40, 0.99), 0);
    EXPECT_EQ(tiles_allowed(100, 0.99), 1);
    EXPECT_LE(share_with(Verdict::holds, 64, 16, 11, 10, 10), most_wrong);
    EXPECT_GE(share_with(Verdict::holds, 16, 16, 2, 20, 10), 0.95) << "those that may differ do not count";
}

// As many as are allowed lie far beyond, all others on the edge: the verdict "fails" is wrong.
TEST(Tiles, OfAShareFailWronglyNoMoreOftenThanTheLevel) {
    EXPECT_LE(share_with(Verdict::fails, 16, 16, 2, 20, 0), most_wrong);
    EXPECT_GE(share_with(Verdict::fails, 16, 16, 3, 20, 10), 0.95) << "one more than is allowed";
}

TEST(Tiles, OfPairedReplicatesForgetWhatBothHaveInCommon) {
    const std::vector<Image> common = noisy(1, 0.3);
    std::vector<Image> a = noisy(2, 0.01), b = noisy(3, 0.01);
    for (std::size_t k = 0; k < common.size(); ++k)
        for (std::size_t i = 0; i < common[k].pixels.size(); ++i) {
            a[k].pixels[i] += common[k].pixels[i];
            b[k].pixels[i] += common[k].pixels[i];
        }
    EXPECT_EQ(compare_tiles(a, b, 8, 0.005).verdict, Verdict::undecided);
    EXPECT_EQ(compare_tiles(a, b, 8, 0.005, 1, true).verdict, Verdict::holds);
}

TEST(Tiles, AreUndecidedInTooMuchNoiseAndSayWhatWouldDecide) {
    const TileComparison t = compare_tiles(noisy(1, 0.3), noisy(2, 0.3), 8, 0.005);
    EXPECT_EQ(t.verdict, Verdict::undecided);
    EXPECT_GT(t.open, 0);
}

TEST(Tiles, OfSinglePicturesUseTheScatterOfThePixels) {
    EXPECT_EQ(compare_tiles_of_single_pictures(noisy(1, 0.005)[0], noisy(2, 0.005)[0], 8, 0.01).verdict,
              Verdict::holds);
    EXPECT_EQ(compare_tiles_of_single_pictures(noisy(1, 0.005)[0], noisy(2, 0.005, 0.05)[0], 8, 0.01).verdict,
              Verdict::fails);
    EXPECT_EQ(compare_tiles_of_single_pictures(noisy(1, 0.3)[0], noisy(2, 0.3)[0], 8, 0.01).verdict,
              Verdict::undecided);
}

} // namespace
} // namespace threefold
