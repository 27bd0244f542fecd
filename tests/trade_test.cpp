// SPDX-License-Identifier: MIT
// The statistics of the trade study on made-up pictures whose noise and bias are known; the choice; the closed form of
// a single path against the tracer; the study with our tracer alone, end to end.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "exporter/temporary_folder.h"
#include "scenes/error.h"
#include "tests/catalogue_scene.h"
#include "verifier/measure/radiance.h"
#include "verifier/studies/trade.h"
#include "verifier/studies/trade_choice.h"
#include "verifier/studies/trade_report.h"
#include "verifier/tolerance/reference.h"

namespace threefold {
namespace {

constexpr int side_px = 64;

/// A picture of radiance about 2 with a known offset and independent normal noise.
Image noisy(double offset, double sigma, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    Image image(side_px, side_px);
    for (Rgb &pixel : image.pixels)
        for (int c = 0; c < 3; ++c) pixel[c] = 2 + offset + sigma * normal(random);
    return image;
}

std::vector<Image> runs_of(int count, double offset, double sigma, std::uint64_t seed) {
    std::vector<Image> runs;
    for (int k = 0; k < count; ++k) runs.push_back(noisy(offset, sigma, seed + static_cast<std::uint64_t>(k)));
    return runs;
}

TEST(ErrorSplit, FindsKnownNoiseAndBiasFromFiveRunsAgainstANoisyReference) {
    // Relative to 2: noise 0.1, bias 0.05; the reference itself is noisier than the bias.
    const ReferencePicture reference = to_reference(runs_of(4, 0, 0.3, 100));
    EXPECT_NEAR(reference.error, 0.3 / std::sqrt(4) / 2, 0.002);
    const ErrorSplit split = split_error(runs_of(5, 0.1, 0.2, 1), reference);
    EXPECT_NEAR(split.variance.value, 0.01, 3e-4);
    EXPECT_NEAR(split.bias2.value, 0.0025, 4e-4);
    EXPECT_NEAR(split.mse.value, 0.0125, 5e-4);
    EXPECT_LT(std::abs(split.bias2.value - 0.0025), 5 * split.bias2.standard_error);
    EXPECT_NEAR(split.mse.value, split.variance.value + split.bias2.value, 1e-9);
    // The mean of 64 pixels: the bias stays, of the noise an eighth.
    EXPECT_NEAR(split.tile_mse, 0.0025 + 0.01 / 64, 5e-4);
}

TEST(ErrorSplit, SeesNoBiasWhereThereIsNone) {
    // Over many repetitions the estimate is zero on the average, below as often as above.
    double sum = 0;
    int negative = 0;
    constexpr int repetitions = 40;
    for (int k = 0; k < repetitions; ++k) {
        const auto seed = static_cast<std::uint64_t>(1000 * k);
        const ErrorSplit split = split_error(runs_of(5, 0, 0.2, seed), to_reference(runs_of(4, 0, 0.1, seed + 500)));
        sum += split.bias2.value;
        negative += split.bias2.value < 0 ? 1 : 0;
        EXPECT_LT(std::abs(split.bias2.value), 5 * split.bias2.standard_error);
    }
    EXPECT_NEAR(sum / repetitions, 0, 1e-5); // of a variance of 1e-2
    EXPECT_GT(negative, 8);
    EXPECT_LT(negative, 32);
}

TEST(ErrorSplit, TakesTheNoiseOffAPairedDifference) {
    std::vector<Image> a = runs_of(5, 0, 0.2, 1), b = a;
    for (std::size_t k = 0; k < b.size(); ++k) {
        const Image other = noisy(0, 0.01, 900 + k);
        for (std::size_t i = 0; i < b[k].pixels.size(); ++i) b[k].pixels[i] += 0.02 + (other.pixels[i] - Rgb(2));
    }
    const Square difference = paired_bias2(b, a, 2);
    EXPECT_NEAR(difference.root(), 0.01, 1e-4);
    EXPECT_DOUBLE_EQ(paired_bias2(a, a, 2).value, 0);
}

/// As POV-Ray's: one random shift of all samples, which each pixel answers in its own way.
std::vector<Image> shifted_runs(int count, double bias, double sigma, std::mt19937_64 &random) {
    std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi);
    std::vector<Image> runs;
    for (int k = 0; k < count; ++k) {
        Image image(side_px, side_px);
        const double u = turn(random), v = turn(random);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const auto at = static_cast<double>(i);
            image.pixels[i] =
                Rgb(2 + bias * (i % 2 ? 1 : -1) + sigma * (std::sin(u + 0.1 * at) + std::sin(v + at * at)));
        }
        runs.push_back(std::move(image));
    }
    return runs;
}

/// The same for all pixels: the worst case.
std::vector<Image> offset_runs(int count, double bias, double sigma, std::mt19937_64 &random) {
    std::normal_distribution<double> normal;
    std::vector<Image> runs;
    for (int k = 0; k < count; ++k) runs.emplace_back(side_px, side_px, Rgb(2 + bias + sigma * normal(random)));
    return runs;
}

/// What the scatter over tiles alone would say of bias2.
double error_of_tiles(std::span<const Image> runs, const Image &reference, double mean) {
    const auto count = static_cast<double>(runs.size());
    std::vector<double> tiles(std::size_t{side_px / 8} * (side_px / 8));
    for (int row = 0; row < side_px; ++row)
        for (int column = 0; column < side_px; ++column) {
            double middle = 0, squares = 0;
            for (const Image &run : runs) middle += run.at(column, row).g / count;
            for (const Image &run : runs) squares += std::pow(run.at(column, row).g - middle, 2) / (count - 1);
            tiles[static_cast<std::size_t>(row / 8 * (side_px / 8) + column / 8)] +=
                (std::pow(middle - reference.at(column, row).g, 2) - squares / count) / 64 / (mean * mean);
        }
    double middle = 0, squares = 0;
    const auto n = static_cast<double>(tiles.size());
    for (const double t : tiles) middle += t / n;
    for (const double t : tiles) squares += (t - middle) * (t - middle);
    return std::sqrt(squares / (n - 1) / n);
}

TEST(ErrorSplit, KnowsThatThePixelsOfARunMayShareOneDraw) {
    constexpr int trials = 200;
    const ReferencePicture reference = exact_reference(Image(side_px, side_px, Rgb(2)));
    for (const auto make : {shifted_runs, offset_runs})
        for (const int count : {2, 3, 5})
            for (const double bias : {0.0, 0.05}) { // relative 0.025; noise 0.1
                std::mt19937_64 random(static_cast<std::uint64_t>(count));
                int within = 0, within_tiles = 0, claimed = 0;
                for (int trial = 0; trial < trials; ++trial) {
                    const std::vector<Image> runs = make(count, bias, 0.2, random);
                    const Square b = split_error(runs, reference).bias2;
                    const double off = std::abs(b.value - bias * bias / 4);
                    within += off <= 2 * b.standard_error ? 1 : 0;
                    within_tiles += off <= 2 * error_of_tiles(runs, reference.mean, 2) ? 1 : 0;
                    claimed += b.seen() ? 1 : 0;
                }
                EXPECT_GE(within, 183) << count << " " << bias;       // of 190; 183 is 2.3 sigma below
                EXPECT_LE(within_tiles, 140) << count << " " << bias; // what it is mended for
                if (bias == 0) {
                    EXPECT_LE(claimed, 17) << count; // of 10
                }
            }
}

TEST(ErrorSplit, StillFindsATrueBias) {
    const ReferencePicture reference = exact_reference(Image(side_px, side_px, Rgb(2)));
    std::mt19937_64 random(1);
    int claimed = 0, claimed_of_two = 0, claimed_of_pairs = 0, within_pairs = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const std::vector<Image> runs = shifted_runs(5, 0.4, 0.2, random);
        claimed += split_error(runs, reference).bias2.seen() ? 1 : 0;
        claimed_of_two += split_error(shifted_runs(2, 0.4, 0.03, random), reference).bias2.seen() ? 1 : 0;
        // A pair with the same seeds differs in little noise.
        std::vector<Image> others = runs;
        const std::vector<Image> differences = shifted_runs(5, 0.02, 0.005, random);
        for (std::size_t k = 0; k < others.size(); ++k)
            for (std::size_t i = 0; i < others[k].pixels.size(); ++i)
                others[k].pixels[i] += differences[k].pixels[i] - Rgb(2);
        const Square pair = paired_bias2(others, runs, 2);
        claimed_of_pairs += pair.seen() ? 1 : 0;
        within_pairs += std::abs(pair.value - 1e-4) <= 2 * pair.standard_error ? 1 : 0;
    }
    EXPECT_GE(claimed, 70);
    EXPECT_GE(claimed_of_two, 50);
    EXPECT_GE(claimed_of_pairs, 95);
    EXPECT_GE(within_pairs, 90);
}

TEST(ErrorSplit, HasNoMeaningForBlackPictures) {
    EXPECT_THROW(to_reference({Image(8, 8), Image(8, 8)}), Error);
    EXPECT_THROW(split_error(std::vector{Image(8, 8)}, exact_reference(Image(8, 8, Rgb(1)))), Error);
}

TEST(NoiseLaw, IsReadFromPoints) {
    const std::vector<NoisePoint> points{
        {4, 3 * std::pow(4, -1.4)}, {16, 3 * std::pow(16, -1.4)}, {64, 3 * std::pow(64, -1.4)}};
    const NoiseLaw law = fit_noise_law(points);
    EXPECT_NEAR(law.rate, 1.4, 1e-12);
    EXPECT_NEAR(law.factor, 3, 1e-12);
    EXPECT_NEAR(law.samples(law.variance(1000)), 1000, 1e-6);
    EXPECT_TRUE(std::isinf(law.samples(0)));
    EXPECT_EQ(fit_noise_law({}).samples(1e-9), 1); // a picture without noise
    const std::vector<NoisePoint> one{{4, 0.25}};
    EXPECT_NEAR(fit_noise_law(one).variance(16), 0.0625, 1e-12);
}

TEST(ParetoFront, HoldsWhatNothingBeats) {
    const std::vector<double> costs{3, 1, 2, 4, 2}, errors{1, 5, 6, 1, 3};
    EXPECT_EQ(pareto_front(costs, errors), (std::vector<std::size_t>{1, 4, 0}));
}

TEST(Choice, IsTheCheapestSystemThatLeavesTheNoiseRoom) {
    RendererModel model;
    model.noise = {1, 1}; // variance 1 / n
    SystemModel coarse, fine, biased;
    coarse.setting.cut_weight = 1e-2, coarse.bias2 = 4e-5, coarse.own_s_per_sample = 1;
    fine.setting.cut_weight = 1e-4, fine.bias2 = 0, fine.own_s_per_sample = 1.2;
    biased.setting.cut_weight = 1e-1, biased.bias2 = 1e-4, biased.own_s_per_sample = 0.1;
    model.systems = {coarse, fine, biased};
    const auto up = [](double n) { return static_cast<int>(std::ceil(n)); };
    const auto found = candidates_for(model, 1e-2, up); // goal 8e-5 of the square
    ASSERT_EQ(found.size(), 2u);                        // the biased one never can
    EXPECT_EQ(found[0].setting.cut_weight, 1e-4);       // 12500 samples at 1.2 against 25000 at 1
    EXPECT_EQ(found[0].setting.samples, 12500);
    EXPECT_LE(found[0].predicted, 1e-2);
    // Twice the noise that was foretold, at rate 1: twice the samples.
    ErrorSplit measured;
    measured.variance.value = 1.6e-4;
    const auto more = with_more_samples(found[0], measured, 1e-2, 1, up);
    ASSERT_TRUE(more);
    EXPECT_NEAR(more->setting.samples, 25000, 1);
    measured.bias2.value = 9e-5;
    EXPECT_FALSE(with_more_samples(found[0], measured, 1e-2, 1, up));
}

TEST(Choice, DoesNotTakeChanceForABias) {
    Candidate tried;
    tried.setting.samples = 100, tried.own_s = 1;
    ErrorSplit measured;
    measured.variance.value = 5e-5, measured.bias2 = {9e-5, 1e-4}, measured.mse.value = 1.4e-4;
    const auto up = [](double n) { return static_cast<int>(std::ceil(n)); };
    const auto more = with_more_samples(tried, measured, 1e-2, 1, up); // goal 8e-5
    ASSERT_TRUE(more);
    EXPECT_EQ(more->setting.samples, 175);
    EXPECT_NEAR(more->own_s, 1.75, 1e-12);
    EXPECT_NEAR(more->predicted, std::sqrt(8e-5), 1e-6);
}

TEST(Choice, SavesSamplesThatWereNotNeeded) {
    Candidate met;
    met.setting.samples = 100, met.own_s = 1, met.process_s = 3;
    ErrorSplit measured;
    measured.variance.value = measured.mse.value = 2e-5;
    const auto up = [](double n) { return static_cast<int>(std::ceil(n - 1e-9)); };
    const auto fewer = with_fewer_samples(met, measured, 1e-2, 1, up); // goal 8e-5
    ASSERT_TRUE(fewer);
    EXPECT_EQ(fewer->setting.samples, 25);
    EXPECT_NEAR(fewer->process_s, 2.25, 1e-12);
    measured.variance.value = measured.mse.value = 7e-5;
    EXPECT_FALSE(with_fewer_samples(met, measured, 1e-2, 1, up));
}

TEST(Choice, TellsTheOtherSystemsOfNoiseBeyondTheLaw) {
    Candidate tried;
    tried.setting.samples = 100, tried.predicted = std::sqrt(8e-5), tried.own_s = 1, tried.process_s = 3;
    ErrorSplit measured;
    measured.variance.value = measured.mse.value = 1.6e-4;
    const double times = noise_beyond_law(tried, measured);
    EXPECT_NEAR(times, 2, 1e-9);
    const auto up = [](double n) { return static_cast<int>(std::ceil(n - 1e-9)); };
    const Candidate other = with_noise_beyond_law(tried, times, 2, up); // samples^-2
    EXPECT_EQ(other.setting.samples, 142);
    EXPECT_NEAR(other.process_s, 3 + 0.42, 1e-9);
    measured.variance.value = measured.mse.value = 4e-5; // less is no reason for fewer samples
    EXPECT_EQ(noise_beyond_law(tried, measured), 1);
}

TEST(Sweep, CutsTreesAsFineAsTheToleranceAsks) {
    const Scene scene = catalogue_scene("hollow", {});
    for (const Witness &w : find_witnesses({"tracer", "povray"}))
        for (const auto &[tolerance, most] : {std::pair{1e-2, 1e-5}, {1e-3, 1e-6}}) {
            const auto points = sweep_of(w, scene, true, tolerance);
            EXPECT_LE(points.front().setting.cut_weight, most * 1.001) << w.name;
            // Something stands beside the finest to be held against it, with as many samples.
            EXPECT_TRUE(std::ranges::any_of(points, [&](const SweepPoint &p) {
                return p.knob == Knob::samples && p.setting.samples == points.front().setting.samples;
            })) << w.name;
        }
    const Witness cycles = find_witnesses({"cycles"}).front();
    EXPECT_LT(sweep_of(cycles, scene, true, 1e-3).front().setting.surface_mm,
              sweep_of(cycles, scene, true, 1e-2).front().setting.surface_mm);
}

TEST(ClosedFormPicture, OfASinglePathIsTheTracers) {
    // Hollow (straight, totally reflected at the inner surface) and thick (past the hollow through the glass), tinted.
    for (const char *wall : {"1.3", "20"})
        for (const char *scene_name : {"hollow", "solid"}) {
            std::vector<Assignment> values{{"image.width_px", "32"},
                                           {"image.height_px", "32"},
                                           {"glass.coating", "antireflective"},
                                           {"card.surface", "coordinate"},
                                           {"environment.radiance", "0.3"},
                                           {"glass.interface_transmittance", "0.9"}};
            if (std::string(scene_name) == "hollow") values.emplace_back("orb.wall_mm", wall);
            const Scene scene = catalogue_scene(scene_name, values);
            const auto pictures = closed_form_pictures(scene, 256, 4, 1);
            ASSERT_TRUE(pictures);
            const ReferencePicture reference = to_reference(*pictures);
            RenderJob job;
            job.scene = scene;
            job.samples_per_pixel = 256;
            job.replicates = {{11, {}}, {12, {}}, {13, {}}, {14, {}}};
            const ErrorSplit split = split_error(trace(job).images, reference);
            EXPECT_LT(std::abs(split.bias2.value), 5 * split.bias2.standard_error) << scene_name << " " << wall;
            EXPECT_LT(std::sqrt(std::abs(split.bias2.value)), 2e-3) << scene_name << " " << wall;
        }
}

TEST(ClosedFormPicture, IsNotClaimedWhereRaysBranch) {
    EXPECT_FALSE(closed_form_pictures(catalogue_scene("hollow", {}), 1, 2, 1));
    EXPECT_EQ(
        closed_form_pictures(catalogue_scene("furnace", {{"image.width_px", "8"}, {"image.height_px", "8"}}), 1, 1, 1)
            ->front()
            .at(3, 3)
            .g,
        1);
}

TEST(Trade, OfTheTracerAloneNamesASettingThatMeetsTheTolerance) {
    const TemporaryFolder folder;
    TradeRequest request;
    request.scene =
        catalogue_scene("solid", {{"image.width_px", "32"}, {"image.height_px", "32"}, {"glass.index", "1.7"}});
    request.witnesses = find_witnesses({"tracer"});
    request.tolerances = {3e-2};
    request.quick = true;
    request.folder = folder.path();
    const TradeResult result = study_trade(request);
    ASSERT_EQ(result.choices.size(), 1u);
    const TradeChoice &choice = result.choices.front();
    EXPECT_TRUE(choice.met) << choice.note;
    EXPECT_LE(choice.measured.root(), 3e-2);
    EXPECT_GT(choice.measured.root(), 1e-3); // no waste: within a decade or so of what was asked
    EXPECT_TRUE(result.all_met());
    // Independently: fresh seeds of our own.
    bool float_row = false;
    for (const TradeRow &row : result.rows) {
        EXPECT_EQ(row.error.runs, 5);
        EXPECT_GT(row.cost.own_cpu_s, 0);
        if (row.knob != Knob::precision) continue;
        float_row = true;
        ASSERT_TRUE(row.difference);
        EXPECT_LT(row.difference->root(), 1e-2); // another number of samples beside the glass, not another picture
    }
    EXPECT_TRUE(float_row);
    const std::string csv = to_csv(result);
    EXPECT_EQ(std::ranges::count(csv, '\n'), static_cast<long>(result.rows.size()) + 1);
    EXPECT_EQ(to_json(result)["choices"][0]["met"], true);
    const std::string page = to_html(result);
    EXPECT_EQ(page.find("http://"), page.find("http://www.w3.org/2000/svg")); // opens offline
    EXPECT_NE(page.find("<svg"), std::string::npos);
}

TEST(Trade, EscapesWhatASceneIsCalled) {
    TradeResult result;
    result.scene = "<script>alert(1)</script>";
    result.tolerances = {1e-2};
    EXPECT_EQ(to_html(result).find("<script"), std::string::npos);
}

} // namespace
} // namespace threefold
