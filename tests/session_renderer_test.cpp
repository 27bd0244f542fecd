// SPDX-License-Identifier: MIT
// Blender, started once, renders one job after another as a Blender of its own would.
#include "exporter/session.h"

#include <chrono>
#include <filesystem>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exporter/blender/cycles.h"
#include "exporter/files.h"
#include "exporter/run.h"
#include "scenes/error.h"
#include "tests/catalogue_scene.h"
#include "tests/temporary_folder.h"

namespace threefold {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class BlenderSession : public testing::Test {
protected:
    static RenderJob job_of(std::string_view scene, const char *width_px) {
        RenderJob job;
        job.scene = catalogue_scene(scene, {{"image.width_px", width_px}, {"image.height_px", "24"}});
        job.samples_per_pixel = 4;
        job.replicates = {{7, {0, 0}}, {8, {0.25, -0.25}}};
        job.threads = 1;
        return job;
    }

    RunOutcome render(const RenderJob &job, const std::string &name, Sessions *sessions) {
        return run_exported(adapter_, *installed_, compile_cycles(job), job,
                            {folder_ / name, std::chrono::minutes(2), {}, sessions});
    }

    /// The end of a script that is not ours to compile.
    ChildResult run_script(Sessions &sessions, const std::string &name, const std::string &script,
                           std::chrono::milliseconds limit = std::chrono::minutes(1)) {
        make_folder(folder_ / name);
        write_file_atomically(folder_ / name / "scene.py", script);
        return sessions.render(adapter_, *installed_, {"-t", "1"}, {folder_ / name, folder_ / name / "log", limit, {}});
    }

    const tests::TemporaryFolder folder_;
    const Adapter adapter_ = cycles_adapter();
    const std::optional<InstalledRenderer> installed_ = find_renderer(adapter_);
};

TEST_F(BlenderSession, RendersToTheLastBitWhatABlenderOfItsOwnRenders) {
    ASSERT_TRUE(installed_) << "Blender is missing";
    const RenderJob hollow = job_of("hollow", "32"), lit = job_of("soft-light", "40");
    Sessions sessions;
    const RunOutcome first = render(hollow, "a", &sessions), other = render(lit, "b", &sessions),
                     again = render(hollow, "it's \"c\"\n\xff", &sessions);
    const RunOutcome alone = render(hollow, "alone", nullptr), lit_alone = render(lit, "lit alone", nullptr);
    ASSERT_EQ(alone.images.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
        EXPECT_EQ(first.images[k].pixels, alone.images[k].pixels);
        EXPECT_EQ(again.images[k].pixels, alone.images[k].pixels) << "what came between left no trace";
        EXPECT_EQ(other.images[k].pixels, lit_alone.images[k].pixels);
    }
    EXPECT_NE(alone.images[0].pixels, alone.images[1].pixels);
    EXPECT_LT(again.cpu_seconds, first.cpu_seconds) << "without a start";
    EXPECT_GT(again.own_cpu_seconds, 0);
    EXPECT_LE(again.own_cpu_seconds, again.cpu_seconds);
    EXPECT_THAT(read_file(folder_ / "b" / "cycles.log"), HasSubstr("threefold replicate 2 of 2"));
}

TEST_F(BlenderSession, SaysThatAScriptFailedAndGoesOnWithTheNext) {
    ASSERT_TRUE(installed_);
    Sessions sessions;
    const ChildResult failed = run_script(sessions, "bad", "raise RuntimeError('no such thing')\n");
    EXPECT_EQ(failed.end, ChildResult::End::exited);
    EXPECT_EQ(failed.exit_code, 3);
    EXPECT_THAT(read_file(folder_ / "bad" / "log"), HasSubstr("RuntimeError: no such thing"));
    EXPECT_EQ(run_script(sessions, "good", "print('hello')\n").exit_code, 0);
    EXPECT_EQ(run_script(sessions, "exits", "import sys\nsys.exit(0)\n").exit_code, 3)
        << "a script that leaves early rendered nothing";
}

TEST_F(BlenderSession, EndsWhatCrashesOrTakesTooLongAndStartsAnother) {
    ASSERT_TRUE(installed_);
    Sessions sessions;
    EXPECT_EQ(run_script(sessions, "slow", "import time\ntime.sleep(600)\n", std::chrono::seconds(6)).end,
              ChildResult::End::timed_out);
    EXPECT_EQ(run_script(sessions, "good", "print('hello')\n").exit_code, 0);
    const ChildResult killed = run_script(sessions, "killed", "import os\nos.kill(os.getpid(), 9)\n");
    EXPECT_EQ(killed.end, ChildResult::End::signalled);
    EXPECT_EQ(killed.signal, 9);
    EXPECT_EQ(run_script(sessions, "better", "print('hello')\n").exit_code, 0);
}

} // namespace
} // namespace threefold
