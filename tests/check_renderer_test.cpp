// SPDX-License-Identifier: MIT
// The main job with the real POV-Ray and Blender: it holds; every fault in one renderer's export alone is found; a run
// that was killed goes on. The tests share one folder, so that what one has rendered the next finds in the cache.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cctype>
#include <csignal>
#include <fstream>
#include <map>
#include <optional>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>

#include "exporter/files.h"
#include "exporter/process/child.h"
#include "exporter/temporary_folder.h"
#include "scenes/catalogue/catalogue.h"
#include "verifier/check/check.h"
#include "verifier/report/json.h"

extern char **environ;

namespace threefold {
namespace {

namespace fs = std::filesystem;
using testing::Contains;

const fs::path shared_folder = THREEFOLD_CHECK_FOLDER;

CheckRequest request(const std::vector<std::string> &names, const fs::path &folder = shared_folder) {
    CheckRequest r;
    const auto claims = built_in_claims();
    for (const std::string &name : names) r.claims.push_back(find_claim(claims, name));
    r.scenes = built_in_scenes();
    r.witnesses = find_witnesses(witness_names());
    r.quick = true;
    r.folder = folder;
    return r;
}

std::vector<std::string> all_names() {
    std::vector<std::string> names;
    for (const Claim &c : built_in_claims()) names.push_back(c.name);
    return names;
}

TEST(Renderers, AreInstalled) {
    for (const Witness &w : find_witnesses(witness_names())) EXPECT_TRUE(w.present()) << w.title << " is missing";
}

// One ray a pixel, yet noisy: Cycles draws branches and lights at random. The other two have nothing to gain.
TEST(CheckTolerance, GivesAPictureOfGivenPointsMoreSamplesWhereItIsNoisy) {
    const auto samples_with = [](std::optional<double> tolerance) {
        CheckRequest r = request({"setup"});
        r.witnesses = find_witnesses({"tracer", "cycles"});
        r.tolerance = tolerance;
        r.presets = {Preset::text};
        std::map<std::string, int> samples;
        for (const RenderRecord &record : check(r).result.renders)
            if (record.experiment == "setup-picture") samples[record.witness] = record.samples_per_pixel;
        return samples;
    };
    const auto usual = samples_with({}), fine = samples_with(0.01);
    ASSERT_TRUE(usual.contains("cycles"));
    EXPECT_GT(fine.at("cycles"), usual.at("cycles"));
    EXPECT_EQ(fine.at("tracer"), usual.at("tracer"));
}

class EveryClaim : public testing::TestWithParam<std::string> {};

TEST_P(EveryClaim, HoldsInAllThreeRenderers) {
    const CheckOutcome outcome = check(request({"calibration", GetParam()}));
    EXPECT_EQ(outcome.exit, Exit::holds) << to_json(outcome.result).dump(1);
    for (const ClaimResult &claim : outcome.result.claims) {
        EXPECT_EQ(claim.verdict, Verdict::holds) << claim.name;
        for (const TileComparison &t : claim.tiles) {
            // What the issue of a picture's agreement allows at most, as shares of the mean radiance.
            const bool random = t.witness == "cycles" || t.versus == "cycles";
            const bool lit = t.needed_share < 1; // the whole composition and the set-up
            EXPECT_LE(t.tolerance, (lit ? 0.03 : random ? 0.01 : 0.005) * t.mean_radiance) << t.experiment;
            EXPECT_GE(t.holding, t.needed_share * t.columns * t.rows);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Claims, EveryClaim, testing::ValuesIn([] {
                             std::vector<std::string> names = all_names();
                             std::erase(names, "calibration"); // stands before every other
                             return names;
                         }()));

struct Settings {
    std::vector<Assignment> assignments;
};

void PrintTo(const Settings &settings, std::ostream *out) {
    for (const Assignment &a : settings.assignments) *out << a.name << '=' << a.value << ' ';
}

struct Mutant {
    std::string renderer;
    Fault fault;
    std::vector<std::string> claims;
};

void PrintTo(const Mutant &mutant, std::ostream *out) { *out << mutant.renderer << ' ' << to_string(mutant.fault); }

class Mutants : public testing::TestWithParam<Mutant> {};

TEST_P(Mutants, InOneRenderersExportAloneAreAnsweredByFailsAndTheRendererIsNamed) {
    CheckRequest r = request(GetParam().claims);
    r.injected[GetParam().renderer] = GetParam().fault;
    const CheckOutcome outcome = check(r);
    EXPECT_EQ(outcome.exit, Exit::fails) << outcome.result.summary;
    std::vector<std::string> blamed;
    for (const ClaimResult &claim : outcome.result.claims)
        if (claim.verdict == Verdict::fails) blamed.insert(blamed.end(), claim.blamed.begin(), claim.blamed.end());
    EXPECT_THAT(blamed, Contains(GetParam().renderer));
    for (const std::string &name : blamed) EXPECT_EQ(name, GetParam().renderer) << "the innocent are not blamed";
}

std::vector<Mutant> mutants() {
    std::vector<Mutant> all;
    for (const char *renderer : {"tracer", "povray", "cycles"}) {
        all.push_back({renderer, Fault::index_one_percent, {"calibration", "solid-vs-hollow"}});
        all.push_back({renderer, Fault::wall_doubled, {"calibration", "rim-reads-wall"}});
        all.push_back({renderer, Fault::inner_surface_missing, {"calibration", "rim-reads-wall"}});
        all.push_back({renderer, Fault::camera_one_pixel, {"calibration"}});
        all.push_back({renderer, Fault::texture_mirrored, {"calibration"}});
        all.push_back({renderer, Fault::radiance_slip, {"calibration", "energy"}});
        all.push_back({renderer, Fault::light_missing, {"calibration", "soft-light"}});
    }
    return all;
}

INSTANTIATE_TEST_SUITE_P(Faults, Mutants, testing::ValuesIn(mutants()), [](const auto &info) {
    std::string name = info.param.renderer + "_" + std::string(to_string(info.param.fault));
    for (char &c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
});

class OpticalMap : public testing::TestWithParam<Settings> {};

TEST_P(OpticalMap, LandsWhereExactOpticsSaysInEveryRenderer) {
    CheckRequest r = request({"solid-vs-hollow"});
    const auto experiments = r.claims.front().experiments;
    r.claims.front().experiments = [experiments](const ClaimContext &context) {
        std::vector<Experiment> maps = experiments(context);
        std::erase_if(maps, [](const Experiment &e) { return !e.name.ends_with("-map"); });
        return maps;
    };
    r.assignments = GetParam().assignments;
    const RunResult result = check(r).result;
    int rows = 0;
    for (const Row &row : result.claims.front().rows)
        if (row.quantity == "landing error, 95th percentile") {
            EXPECT_LT(row.interval.high, row.witness == "tracer" ? 1e-11 : 2e-4)
                << row.experiment << ' ' << row.witness;
            ++rows;
        }
    EXPECT_EQ(rows, 6);
}

INSTANTIATE_TEST_SUITE_P(Sweep, OpticalMap,
                         testing::Values(Settings{{{"orb.wall_mm", "0.68"},
                                                   {"glass.index", "1.05"},
                                                   {"eye.distance_mm", "500"},
                                                   {"card.distance_mm", "100"}}},
                                         Settings{{{"orb.wall_mm", "1.36"},
                                                   {"glass.index", "2.4"},
                                                   {"eye.distance_mm", "500"},
                                                   {"card.distance_mm", "400"}}},
                                         Settings{{{"orb.wall_mm", "2.72"},
                                                   {"glass.index", "1.8"},
                                                   {"eye.distance_mm", "2000"},
                                                   {"card.distance_mm", "100"}}},
                                         Settings{{{"orb.wall_mm", "2.72"},
                                                   {"glass.index", "2.4"},
                                                   {"eye.distance_mm", "2000"},
                                                   {"card.distance_mm", "400"}}}));

// ---------------------------------------------------------------------------------------------------------------------
// Kill it at any moment

pid_t start_check(const fs::path &folder) {
    const std::string out = folder.string();
    std::vector<std::string> words{THREEFOLD_PROGRAM, "check", "--quick", "-q", "energy", "-o", out};
    std::vector<char *> arguments;
    for (std::string &w : words) arguments.push_back(w.data());
    arguments.push_back(nullptr);
    pid_t pid = 0;
    EXPECT_EQ(posix_spawn(&pid, THREEFOLD_PROGRAM, nullptr, nullptr, arguments.data(), environ), 0);
    return pid;
}

/// Processes that work in a folder under `folder`.
int processes_in(const fs::path &folder) {
    int count = 0;
    for (const auto &entry : fs::directory_iterator("/proc")) {
        std::error_code ignored;
        const fs::path where = fs::read_symlink(entry.path() / "cwd", ignored);
        count += !ignored && where.string().starts_with(folder.string() + "/");
    }
    return count;
}

void expect_no_orphans(const fs::path &folder) {
    for (int tenths = 0; tenths < 50 && processes_in(folder) > 0; ++tenths)
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(processes_in(folder), 0);
}

int wait_for(pid_t pid) {
    int status = 0;
    waitpid(pid, &status, 0);
    return status;
}

/// Renders that are finished and kept.
int finished_in(const fs::path &folder) {
    int count = 0;
    std::error_code ignored;
    for (const auto &entry : fs::directory_iterator(folder / "renders", ignored))
        count += fs::exists(entry.path() / "done.json", ignored);
    return count;
}

TEST(Killed, AtAnyMomentGoesOnWhereItStoppedAndFindsTheSame) {
    const TemporaryFolder folder;
    for (const int finished : {0, 1, 3, 4}) { // of nine
        const pid_t pid = start_check(folder.path());
        for (int tenths = 0; tenths < 600 && finished_in(folder.path()) < finished; ++tenths)
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        kill(pid, SIGKILL);
        ASSERT_TRUE(WIFSIGNALED(wait_for(pid))) << "it had ended before";
        expect_no_orphans(folder.path());
        EXPECT_FALSE(fs::exists(folder.path() / "result.json"));
        if (fs::exists(folder.path() / "report.html")) {
            EXPECT_THAT(read_file(folder.path() / "report.html"), testing::HasSubstr("Running: 1 of 2 claims judged"));
        }
    }
    EXPECT_EQ(WEXITSTATUS(wait_for(start_check(folder.path()))), 0);
    const auto resumed = nlohmann::ordered_json::parse(read_file(folder.path() / "result.json"));
    const auto whole = to_json(check(request({"calibration", "energy"})).result);
    ASSERT_EQ(resumed.at("claims").size(), whole.at("claims").size());
    bool from_cache = false;
    for (const auto &render : resumed.at("renders")) from_cache |= render.at("from_cache").get<bool>();
    EXPECT_TRUE(from_cache) << "what was finished before the kill is not done again";
    for (std::size_t i = 0; i < whole.at("claims").size(); ++i) {
        EXPECT_EQ(resumed.at("claims")[i].at("verdict"), whole.at("claims")[i].at("verdict"));
        for (std::size_t k = 0; k < whole.at("claims")[i].at("rows").size(); ++k) {
            const auto &a = resumed.at("claims")[i].at("rows")[k];
            const auto &b = whole.at("claims")[i].at("rows")[k];
            // Two runs of Cycles may differ in the last bit of single precision.
            EXPECT_NEAR(a.at("measured").at("mean").get<double>(), b.at("measured").at("mean").get<double>(), 1e-6);
        }
    }
}

TEST(Interrupted, StopsTheRendererAndSaysSoByItsExitCode) {
    const TemporaryFolder folder;
    const pid_t pid = start_check(folder.path());
    for (int tenths = 0; tenths < 100 && processes_in(folder.path()) == 0; ++tenths)
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    ASSERT_GT(processes_in(folder.path()), 0) << "no renderer was started";
    kill(pid, SIGINT);
    EXPECT_EQ(WEXITSTATUS(wait_for(pid)), 130);
    expect_no_orphans(folder.path());
}

} // namespace
} // namespace threefold
