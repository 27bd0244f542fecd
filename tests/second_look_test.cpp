// SPDX-License-Identifier: MIT
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/quick_request.h"
#include "tests/temporary_folder.h"
#include "verifier/agreement/tiles.h"
#include "verifier/check/check.h"
#include "verifier/check/pictures.h"
#include "verifier/check/rows.h"

namespace threefold {
namespace {

Row row_at(const std::vector<double> &values, double level) {
    Row row = row_of("e", "w", {"q", "", Relation::equal, 1, {{"all", 0.2, ""}}});
    row.measured = estimate(values);
    row.level = level;
    return judged(row);
}

TEST(SecondLook, BothLooksTogetherSayHoldsOfANumberAtTheEdgeInAtMostFivePercent) {
    std::mt19937_64 random(11);
    std::normal_distribution<double> noise(1.2, 0.05);
    int holds = 0, second = 0;
    constexpr int trials = 4000;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<double> values(8);
        for (double &v : values) v = noise(random);
        Row row = row_at(values, first_look);
        if (const int wanted = replicates_for_second_look("w", 8, {row})) {
            while (static_cast<int>(values.size()) < wanted) values.push_back(noise(random));
            row = row_at(values, second_look);
            ++second;
        }
        holds += row.verdict == Verdict::holds;
    }
    EXPECT_GT(second, trials / 20) << "the second look is taken";
    EXPECT_LT(holds, trials * significance + 4 * std::sqrt(trials * significance * (1 - significance)));
}

TEST(SecondLook, BothLooksTogetherSayFailsWithoutADifferenceInAtMostFivePercentHoweverSmallTheTolerance) {
    for (const double tolerance : {1e-12, 0.003, 0.01, 0.05})
        for (const int replicates : {4, 8, 16}) {
            std::mt19937_64 random(3);
            std::normal_distribution<double> noise(1, 0.05);
            int fails = 0;
            constexpr int trials = 2000;
            for (int trial = 0; trial < trials; ++trial) {
                std::vector<double> values(static_cast<std::size_t>(replicates));
                for (double &v : values) v = noise(random);
                const auto row_of_values = [&](double level) {
                    Row row = row_of("e", "w", {"q", "", Relation::equal, 1, {{"all", tolerance, ""}}});
                    row.measured = estimate(values);
                    row.level = level;
                    return judged(row);
                };
                Row row = row_of_values(first_look);
                if (const int wanted = replicates_for_second_look("w", replicates, {row})) {
                    while (static_cast<int>(values.size()) < wanted) values.push_back(noise(random));
                    row = row_of_values(second_look);
                }
                fails += row.verdict == Verdict::fails;
            }
            EXPECT_LT(fails, trials * significance + 4 * std::sqrt(trials * significance * (1 - significance)))
                << tolerance << ", " << replicates << " replicates";
        }
}

TEST(SecondLook, IsNotTakenWhereNothingIsOpenOrNoNumberOfReplicatesWouldDo) {
    const Row decided = row_at({1, 1.01, 0.99, 1.02, 0.98}, first_look);
    ASSERT_EQ(decided.verdict, Verdict::holds);
    EXPECT_EQ(replicates_for_second_look("w", 5, {decided}), 0);
    const Row hopeless = row_at({1.2, -0.8, 3.2, 1.1, 1.3001}, first_look);
    ASSERT_EQ(hopeless.verdict, Verdict::undecided);
    EXPECT_EQ(replicates_for_second_look("w", 5, {hopeless}), 0);
    const Row open = row_at({1, 1.3, 0.9, 1.02, 0.7}, first_look);
    ASSERT_EQ(open.verdict, Verdict::undecided);
    EXPECT_GT(replicates_for_second_look("w", 5, {open}), 5);
    EXPECT_EQ(replicates_for_second_look("another", 5, {open}), 0);
    // At the edge by its mean, but by less than that is known to.
    const Row unlucky = row_at({1.25, 1.1, 1.31, 1.12, 1.2}, first_look);
    ASSERT_EQ(unlucky.verdict, Verdict::undecided);
    EXPECT_GT(replicates_for_second_look("w", 5, {unlucky}), 5);
}

/// One tile whose replicates have normal noise about `mean`.
std::vector<Image> pictures(std::mt19937_64 &random, double mean, double noise, int count) {
    std::normal_distribution<double> normal(mean, noise);
    std::vector<Image> all;
    for (int k = 0; k < count; ++k) all.emplace_back(8, 8, Rgb(normal(random)));
    return all;
}

TEST(SecondLook, OfPicturesBothLooksTogetherSayHoldsOfATileAtTheEdgeInAtMostFivePercent) {
    std::mt19937_64 random(5);
    constexpr double tolerance = 0.1, noise = 0.03;
    const std::vector<Image> exact(4, Image(8, 8, Rgb(1)));
    int holds = 0, second = 0;
    constexpr int trials = 2000;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<Image> others = pictures(random, 1 + tolerance, noise, 4);
        const auto compared = [&](double level) {
            TileComparison t = compare_tiles(others, exact, 8, tolerance, 1, false, level);
            t.witness = "w", t.versus = "exact";
            return t;
        };
        TileComparison t = compared(first_look);
        if (t.verdict == Verdict::undecided)
            if (const int wanted = replicates_for_second_look("w", 4, {compared(second_look)})) {
                for (Image &more : pictures(random, 1 + tolerance, noise, wanted - 4)) others.push_back(more);
                t = compared(second_look);
                ++second;
            }
        holds += t.verdict == Verdict::holds;
    }
    EXPECT_GT(second, trials / 2);
    EXPECT_LT(holds, trials * significance + 4 * std::sqrt(trials * significance * (1 - significance)));
}

TEST(SecondLook, OfPicturesSettlesWhatTheFirstLeavesOpenAndIsTakenByTheNoisyRendererAlone) {
    std::mt19937_64 random(6);
    const std::vector<Image> exact(4, Image(8, 8, Rgb(1)));
    std::vector<Image> others = pictures(random, 1, 0.08, 4);
    TileComparison t = compare_tiles(others, exact, 8, 0.05, 1, false, second_look);
    t.witness = "noisy", t.versus = "exact";
    ASSERT_EQ(t.verdict, Verdict::undecided);
    EXPECT_EQ(replicates_for_second_look("exact", 4, {t}), 0) << "it has nothing to gain";
    const int wanted = replicates_for_second_look("noisy", 4, {t});
    ASSERT_GT(wanted, 4);
    for (Image &more : pictures(random, 1, 0.08, 60)) others.push_back(more);
    EXPECT_EQ(compare_tiles(others, exact, 8, 0.05, 1, false, second_look).verdict, Verdict::holds);
}

TEST(ComparedPictures, AreUndecidedWhereTheirNumbersAreTooCoarse) {
    std::mt19937_64 random(8);
    const std::vector<Witness> renderers = find_witnesses({"tracer", "povray"});
    Experiment e;
    e.tile_px = 8;
    e.tile_budget = [](const Accuracy &, const Accuracy &) { return std::vector<BudgetItem>{{"all", 0.05, ""}}; };
    std::vector<Testimony> testimonies;
    for (const Witness &w : renderers)
        testimonies.push_back({&w, {pictures(random, 0, 0.001, 4), {}}, 1, 1}); // both store the environment as black
    EXPECT_EQ(compared_pictures(e, testimonies, first_look).front().verdict, Verdict::holds);
    testimonies[1].rendered.record.accuracy.radiance_step = 1.5;
    const TileComparison coarse = compared_pictures(e, testimonies, first_look).front();
    EXPECT_EQ(coarse.verdict, Verdict::undecided);
    EXPECT_NE(coarse.problem.find("1.5"), std::string::npos) << coarse.problem;
    EXPECT_EQ(replicates_for_second_look("povray", 4, {coarse}), 0) << "more replicates are no help";
}

TEST(SecondLook, CountsWhereOneOfTwoRenderersRenderedMore) {
    const auto row = [](const char *witness, const char *versus, Verdict verdict, int replicates) {
        Row r = row_of("e", witness, {"q", "", Relation::equal, 1, {}});
        r.versus = versus;
        r.verdict = verdict;
        r.measured.replicates = replicates; // of a difference, the fewer of both
        return r;
    };
    using enum Verdict;
    std::vector<Row> rows{row("quiet", "", holds, 4), row("noisy", "", undecided, 4),
                          row("quiet", "noisy", undecided, 4), row("quiet", "third", undecided, 4)};
    take_second_look(rows,
                     {row("quiet", "", undecided, 4), row("noisy", "", holds, 9), row("quiet", "noisy", holds, 4),
                      row("quiet", "third", holds, 4)},
                     {"noisy"});
    EXPECT_EQ(rows[0].verdict, holds) << "what is decided stays";
    EXPECT_EQ(rows[1].verdict, holds);
    EXPECT_EQ(rows[2].verdict, holds) << "though the quiet one has no more than before";
    EXPECT_EQ(rows[3].verdict, undecided) << "neither rendered more: the first look's level counts";
}

/// The first look leaves brackets open that lie so near to what a sharp eye resolves.
TEST(SecondLook, SettlesWhatTheFirstLeavesOpen) {
    const tests::TemporaryFolder folder;
    auto request = quick_request<CheckRequest>(folder.path(), {"three-lines"});
    request.assignments = {{"criterion.acuity_arcmin", "0.03"}};
    const RunResult result = check(request).result;
    EXPECT_EQ(result.verdict, Verdict::holds) << result.summary;
    int twice = 0;
    for (const ClaimResult &claim : result.claims)
        for (const Row &row : claim.rows) {
            EXPECT_EQ(row.level == second_look, row.measured.replicates > 4) << row.experiment << ": " << row.quantity;
            twice += row.level == second_look;
        }
    EXPECT_GT(twice, 0);
}

} // namespace
} // namespace threefold
