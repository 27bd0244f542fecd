// SPDX-License-Identifier: MIT
// The other judges' formulas on known pictures, the search for the smallest fault, and a small power study.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

#include "exporter/temporary_folder.h"
#include "scenes/catalogue/catalogue.h"
#include "scenes/error.h"
#include "tests/quick_request.h"
#include "verifier/studies/power.h"
#include "verifier/studies/power_report.h"

namespace threefold {
namespace {

/// The radiance of an 8-bit sRGB value above the curve's straight part.
double radiance_of(int code) { return std::pow((code / 255.0 + 0.055) / 1.055, 2.4); }

Image grey(int width, int height, int code) { return Image(width, height, Rgb(radiance_of(code))); }

TEST(FalseAlarms, OfNoneInFortyRunsTheRateIsUnderSevenPercentWithNinetyFivePercentConfidence) {
    EXPECT_NEAR(FalseAlarms::upper_bound(0, 40), 1 - std::pow(0.05, 1.0 / 40), 1e-12);
    EXPECT_NEAR(FalseAlarms::upper_bound(0, 40), 0.072, 0.0005);
    // That or fewer alarms happen in 5 % of all sets of runs, were the rate the bound.
    const double p = FalseAlarms::upper_bound(2, 40), q = 1 - p;
    EXPECT_NEAR(std::pow(q, 40) + 40 * p * std::pow(q, 39) + 780 * p * p * std::pow(q, 38), 0.05, 1e-9);
    EXPECT_EQ(FalseAlarms::upper_bound(3, 3), 1);
    EXPECT_EQ(FalseAlarms::upper_bound(0, 0), 1);
}

TEST(Idiff, CountsPixelsThatDifferByMoreThanFourCodes) {
    // 4 / 255 = 0.0157 is within 0.016, 5 / 255 = 0.0196 is not.
    const Image reference = grey(10, 10, 128);
    EXPECT_FALSE(judge_by_idiff(reference, grey(10, 10, 132)).fails);
    EXPECT_DOUBLE_EQ(judge_by_idiff(reference, grey(10, 10, 132)).value, 0);
    EXPECT_TRUE(judge_by_idiff(reference, grey(10, 10, 133)).fails);
    EXPECT_DOUBLE_EQ(judge_by_idiff(reference, grey(10, 10, 133)).value, 1);
}

TEST(Idiff, FailsAboveOnePercentOfPixelsAndNotAtIt) {
    const Image reference = grey(10, 10, 128);
    Image one = reference, two = reference;
    one.at(3, 3) = two.at(3, 3) = Rgb(1);
    two.at(4, 4).b = 1; // one channel is enough
    EXPECT_FALSE(judge_by_idiff(reference, one).fails);
    EXPECT_DOUBLE_EQ(judge_by_idiff(reference, one).value, 0.01);
    EXPECT_TRUE(judge_by_idiff(reference, two).fails);
    EXPECT_DOUBLE_EQ(judge_by_idiff(reference, two).value, 0.02);
}

TEST(RmsInDecibels, OfGreyPicturesIsTheirSquaredDistance) {
    // Grey: i = q = 0, and the distance is 0.5053 d^2. For d = 20: 202.12 / 35215 = 0.0057396, -22.4112 dB.
    const Image reference = grey(8, 8, 100);
    EXPECT_NEAR(judge_by_rms(reference, grey(8, 8, 120)).value, -22.4112, 1e-3);
    EXPECT_FALSE(judge_by_rms(reference, grey(8, 8, 120)).fails);
    // d = 21: 222.8 / 35215, -21.9874 dB
    EXPECT_NEAR(judge_by_rms(reference, grey(8, 8, 121)).value, -21.9874, 1e-3);
    EXPECT_TRUE(judge_by_rms(reference, grey(8, 8, 121)).fails);
    EXPECT_FALSE(judge_by_rms(reference, reference).fails);
}

TEST(RmsInDecibels, IsDilutedByBackground) {
    // A quarter of the pixels at d = 21: half the root mean square, 3.01 dB less.
    Image picture = grey(8, 8, 100);
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) picture.at(column, row) = Rgb(radiance_of(121));
    EXPECT_NEAR(judge_by_rms(grey(8, 8, 100), picture).value, -24.9977, 1e-3);
}

TEST(RmsInDecibels, WeighsColoursLessThanGrey) {
    // Red alone from 0 to 255: y = 76.218, i = 151.974, q = 53.925; 0.5053 y^2 + 0.299 i^2 + 0.1957 q^2 = 10410.2,
    // of 35215: -5.2927 dB.
    EXPECT_NEAR(judge_by_rms(Image(2, 2, Rgb(0)), Image(2, 2, Rgb(1, 0, 0))).value, -5.2927, 1e-3);
}

TEST(ZTest, FailsBeyondSidaksLevelAndNotBelow) {
    // 10,000 pixels: alpha = 1 - 0.99^(1/10000) = 1.00503e-6, two-sided z = 4.8907.
    const Image mean(100, 100, Rgb(0.5)), variance(100, 100, Rgb(0.04)); // sd 0.2, with 16 samples 0.05
    EXPECT_FALSE(judge_by_z_test(mean, variance, Image(100, 100, Rgb(0.5 + 4.88 * 0.05)), 16).fails);
    EXPECT_TRUE(judge_by_z_test(mean, variance, Image(100, 100, Rgb(0.5 + 4.90 * 0.05)), 16).fails);
}

TEST(ZTest, ForgivesAQuarterOfAPercentOfThePixels) {
    const Image mean(100, 100, Rgb(0.5)), variance(100, 100, Rgb(0.04));
    Image picture = mean;
    for (int column = 0; column < 25; ++column) picture.at(column, 0) = Rgb(3);
    EXPECT_FALSE(judge_by_z_test(mean, variance, picture, 16).fails);
    picture.at(25, 0) = Rgb(3);
    EXPECT_TRUE(judge_by_z_test(mean, variance, picture, 16).fails);
}

TEST(ZTest, TakesNoVarianceForLessThanATenThousandth) {
    // sd 0.01, with 16 samples 0.0025
    const Image mean(100, 100, Rgb(0.5)), none(100, 100, Rgb(0));
    EXPECT_FALSE(judge_by_z_test(mean, none, Image(100, 100, Rgb(0.5 + 4.88 * 0.0025)), 16).fails);
    EXPECT_TRUE(judge_by_z_test(mean, none, Image(100, 100, Rgb(0.5 + 4.90 * 0.0025)), 16).fails);
}

TEST(ZTest, TakesTheVarianceOfOneSampleFromReplicates) {
    const std::vector<Image> replicates{Image(1, 1, Rgb(1, 0, 0)), Image(1, 1, Rgb(3, 0, 0)),
                                        Image(1, 1, Rgb(5, 0, 3))};
    const Image variance = variance_of_a_sample(replicates, 16);
    EXPECT_DOUBLE_EQ(variance.at(0, 0).r, 16 * 4.0); // (4 + 0 + 4) / 2
    EXPECT_DOUBLE_EQ(variance.at(0, 0).g, 0);
    EXPECT_DOUBLE_EQ(variance.at(0, 0).b, 16 * 3.0); // (1 + 1 + 4) / 2
}

TEST(SmallestFault, IsFoundToItsResolution) {
    const FaultEntry &index = entry_of(Fault::index_one_percent);
    const auto found = smallest_fault(
        index, [](double size) { return size >= 1.7e-5; }, 1.1);
    ASSERT_TRUE(found && found->missed);
    EXPECT_GE(found->caught, 1.7e-5);
    EXPECT_LT(*found->missed, 1.7e-5);
    EXPECT_LE(found->caught / *found->missed, 1.1);
    EXPECT_LE(found->evaluations, 9);
}

TEST(SmallestFault, GivesUpAtAMillionth) {
    const auto found = smallest_fault(
        entry_of(Fault::index_one_percent), [](double) { return true; }, 1.1);
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->missed);
    EXPECT_NEAR(found->caught, 1e-8, 1e-12);
}

TEST(SmallestFault, OfAPowerIsItsDepartureFromOne) {
    const auto found = smallest_fault(
        entry_of(Fault::gamma_slip), [](double size) { return size >= 1.05; }, 1.1);
    ASSERT_TRUE(found);
    EXPECT_GE(found->caught, 1.05);
    EXPECT_LE(found->caught, 1.055);
}

TEST(SmallestFault, OfAWholeNumberIsExact) {
    const FaultEntry &bounces = entry_of(Fault::four_bounces);
    for (const double most : {4, 5, 6, 11, 37, 200, 255}) {
        const auto found = smallest_fault(
            bounces, [most](double size) { return size <= most; }, 1.1);
        ASSERT_TRUE(found) << most;
        EXPECT_EQ(found->caught, most);
        EXPECT_EQ(found->missed, most + 1);
    }
}

TEST(SmallestFault, DoesNotExistForWhatIsThereOrNot) {
    EXPECT_FALSE(smallest_fault(
        entry_of(Fault::texture_mirrored), [](double) { return true; }, 1.1));
}

TEST(Power, TellsWhatIsCaughtByWhomAndHowSmall) {
    const TemporaryFolder folder;
    PowerRequest r = quick_request<PowerRequest>(folder.path(), {"calibration", "rim-reads-wall"});
    r.faults = {Fault::wall_doubled, Fault::texture_mirrored, Fault::light_missing};
    r.runs = 2;
    double last = 0;
    r.on_progress = [&last](double share, const std::string &) {
        EXPECT_GE(share, last);
        EXPECT_LE(share, 1);
        last = share;
    };
    const PowerResult result = study_power(r);
    EXPECT_EQ(result.honest, Verdict::holds);
    ASSERT_EQ(result.rows.size(), 3u);
    EXPECT_EQ(result.rows[0].caught_by, std::vector<std::string>{"rim-reads-wall"});
    ASSERT_TRUE(result.rows[0].smallest);
    EXPECT_LT(result.rows[0].smallest->caught, 0.05) << "of the wall";
    EXPECT_EQ(result.rows[1].caught_by, std::vector<std::string>{"calibration"});
    EXPECT_TRUE(result.rows[1].pictures.front().idiff.fails);
    EXPECT_FALSE(result.rows[1].smallest);
    EXPECT_FALSE(result.rows[2].caught()) << "neither claim has a light, and the table says so";
    EXPECT_EQ(result.verdict(), Verdict::fails);
    EXPECT_EQ(result.false_alarms.runs, 2);
    EXPECT_EQ(result.false_alarms.ours, 0);
    EXPECT_EQ(to_json(result).at("faults").at(2).at("ours").at("caught"), false);
    EXPECT_NE(to_markdown(result).find("misses light-missing"), std::string::npos);
}

TEST(Power, LeavesNoFaultyPicturesBehind) {
    const TemporaryFolder folder;
    PowerRequest r = quick_request<PowerRequest>(folder.path(), {"rim-reads-wall"});
    r.faults = {Fault::wall_ten_percent};
    r.runs = 0;
    EXPECT_EQ(study_power(r).verdict(), Verdict::holds);
    for (const auto &entry : std::filesystem::recursive_directory_iterator(folder.path()))
        EXPECT_FALSE(entry.is_regular_file()) << entry.path();
}

TEST(Power, NeedsTheRendererThatGetsTheFaults) {
    const TemporaryFolder folder;
    PowerRequest r = quick_request<PowerRequest>(folder.path(), {"rim-reads-wall"});
    r.witnesses.clear();
    EXPECT_THROW(study_power(r), Error);
}

} // namespace
} // namespace threefold
