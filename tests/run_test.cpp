// SPDX-License-Identifier: MIT
// How failures of renderers are met. The programs here are shell scripts that fail in every way; they render nothing.
#include "exporter/run.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "scenes/error.h"
#include "tests/temporary_folder.h"

namespace threefold {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

std::string line_with(std::string_view text, std::string_view sign) {
    const std::size_t found = text.find(sign);
    if (found == text.npos) return {};
    const std::string_view rest = text.substr(found);
    return std::string(rest.substr(0, rest.find('\n')));
}

Adapter make_adapter(std::string_view program = "absent-renderer") {
    return {.name = "fake",
            .title = "Fake",
            .program = program,
            .package = "fake-package",
            .compile = [](const RenderJob &) { return Exported{}; },
            .progress = [](std::string_view line, double last_share, const Exported &) -> std::optional<double> {
                return line == "step" ? std::optional(last_share + 0.25) : std::nullopt;
            },
            .version_argument = "--version",
            .parse_version =
                [](std::string_view output) {
                    const std::string line = line_with(output, "Fake ");
                    return line.empty() ? line : line.substr(5);
                },
            .explain_failure = [](std::string_view log) { return line_with(log, "Error:"); }};
}

class RunExported : public testing::Test {
protected:
    RunExported() {
        job.scene.camera.width_px = 4;
        job.scene.camera.height_px = 2;
        options.folder = folder / "run";
        options.time_limit = 30s;
        exported.outputs = {"out1.exr"};
    }

    RunOutcome run(std::string_view commands) {
        const InstalledRenderer installed{folder.write_program("program", commands), "1"};
        return run_exported(make_adapter(), installed, exported, job, options);
    }

    std::string message_of(std::string_view commands, Exit code = Exit::input_output) {
        try {
            run(commands);
        } catch (const Error &error) {
            EXPECT_EQ(error.code(), code);
            EXPECT_THAT(error.what(), AllOf(testing::StartsWith("Fake "), Not(HasSubstr("\n"))));
            EXPECT_TRUE(fs::exists(options.folder / "fake.log"));
            return error.what();
        }
        ADD_FAILURE() << "no error";
        return {};
    }

    std::string log_note() const { return "; log: " + (options.folder / "fake.log").string(); }

    /// A picture that the program can copy.
    fs::path write_picture(int width, int height, Rgb colour = Rgb(1)) {
        write_image(folder / "picture.exr", Image(width, height, colour));
        return folder / "picture.exr";
    }

    const TemporaryFolder folder;
    RenderJob job;
    Exported exported;
    RunOptions options;
};

TEST_F(RunExported, RunsTheProgramInTheFolderOfItsFilesAndReturnsRadiance) {
    const fs::path picture = write_picture(12, 6, Rgb(0.5, 1, 2));
    exported.files = {{"scene.txt", "the scene"}};
    exported.arguments = {"scene.txt", picture.string()};
    exported.outputs = {"out1.exr", "out2.exr"};
    exported.supersampling = 3;
    exported.radiance_scale = 0.25;
    job.replicates.resize(2);
    const RunOutcome outcome = run("cat $1; cp $2 out1.exr; cp $2 out2.exr");
    ASSERT_EQ(outcome.images.size(), 2u);
    for (const Image &image : outcome.images) {
        EXPECT_EQ(image.width, 4);
        EXPECT_EQ(image.height, 2);
        EXPECT_EQ(image.at(3, 1), Rgb(2, 4, 8));
    }
    EXPECT_EQ(read_file(options.folder / "fake.log"), "the scene");
    EXPECT_GT(outcome.seconds, 0);
}

TEST_F(RunExported, ReadsTheSamplesOfAPngAsTheyStand) {
    Texture texture{4, 2, std::vector<std::uint16_t>(24, 13107)};
    write_file_atomically(folder / "linear.png", encode_png16(texture));
    write_file_atomically(folder / "curved.png", encode_png_preview(Image(4, 2, Rgb(0.5))));
    for (const auto &[name, expected] : {std::pair("linear.png", 0.2), {"curved.png", 188 / 255.0}}) {
        exported.outputs = {"out.png"};
        EXPECT_EQ(run(fmt::format("cp {} out.png", (folder / name).string())).images.at(0).at(0, 0), Rgb(expected));
    }
}

TEST_F(RunExported, AcceptsThePictureOfACrop) {
    job.scene.camera.crop = Crop{1, 0, 2, 1};
    const fs::path picture = write_picture(2, 1);
    EXPECT_EQ(run(fmt::format("cp {} out1.exr", picture.string())).images.at(0).width, 2);
}

TEST_F(RunExported, PassesOnTheProgress) {
    const fs::path picture = write_picture(4, 2);
    std::vector<double> shares;
    options.on_progress = [&](double share) { shares.push_back(share); };
    run(fmt::format("printf 'step\\rother\\rstep\\n'; cp {} out1.exr", picture.string()));
    EXPECT_THAT(shares, ElementsAre(0.25, 0.5));
}

TEST_F(RunExported, ReportsAFailureWithItsReasonAndLog) {
    EXPECT_EQ(message_of("echo start; printf 'Error:\\ta bad\\rscene\\n'; echo after; exit 1"),
              "Fake failed: exit code 1: Error: a bad scene" + log_note());
    EXPECT_EQ(message_of("exit 3"), "Fake failed: exit code 3" + log_note());
}

TEST_F(RunExported, ReportsACrash) {
    EXPECT_EQ(message_of("kill -SEGV $$"), "Fake failed: killed by signal 11 (Segmentation fault)" + log_note());
}

TEST_F(RunExported, ReportsAHang) {
    options.time_limit = 400ms;
    EXPECT_THAT(message_of("sleep 1000", Exit::timed_out),
                AllOf(HasSubstr("Fake ran out of time after 0."), EndsWith(log_note())));
}

TEST_F(RunExported, ReportsAMissingPicture) {
    exported.outputs = {"out1.exr", "out2.exr"};
    job.replicates.resize(2);
    const fs::path picture = write_picture(4, 2);
    EXPECT_EQ(message_of(fmt::format("cp {} out1.exr", picture.string())),
              "Fake wrote no picture (out2.exr is missing)" + log_note());
    EXPECT_EQ(message_of("echo Error: no space"),
              "Fake wrote no picture (out1.exr is missing): Error: no space" + log_note());
}

TEST_F(RunExported, DoesNotTakeThePictureOfAnEarlierRun) {
    make_folder(options.folder);
    write_image(options.folder / "out1.exr", Image(4, 2));
    EXPECT_THAT(message_of("exit 0"), HasSubstr("wrote no picture (out1.exr is missing)"));
}

TEST_F(RunExported, ReportsATruncatedPicture) {
    const fs::path picture = write_picture(4, 2);
    const auto size = fs::file_size(picture);
    for (const auto part : {size - 1, size / 2, decltype(size){0}})
        EXPECT_THAT(
            message_of(fmt::format("head -c {} {} > out1.exr", part, picture.string())),
            AllOf(HasSubstr("Fake wrote a truncated or damaged picture"), HasSubstr("out1.exr"), EndsWith(log_note())));
}

TEST_F(RunExported, ReportsAPictureOfTheWrongSize) {
    const fs::path picture = write_picture(4, 3);
    EXPECT_EQ(message_of(fmt::format("cp {} out1.exr", picture.string())),
              "Fake wrote a picture of the wrong size (out1.exr is 4 x 3, not 4 x 2)" + log_note());
}

TEST_F(RunExported, ReportsAPictureWithNan) {
    // A portable float map of 4 x 2 pixels whose samples are all NaN.
    std::string bytes = "PF\n4 2\n-1.0\n";
    for (int i = 0; i < 24; ++i) bytes += std::string("\0\0\xc0\x7f", 4);
    write_file_atomically(folder / "nan.pfm", bytes);
    exported.outputs = {"out.pfm"};
    EXPECT_THAT(message_of(fmt::format("cp {} out.pfm", (folder / "nan.pfm").string())),
                HasSubstr("pixel (0, 0) is nan"));
}

TEST_F(RunExported, RefusesAnExportThatContradictsItself) {
    const auto code_of = [&] {
        try {
            run("exit 0");
        } catch (const Error &error) {
            return error.code();
        }
        return Exit::holds;
    };
    exported.outputs = {};
    EXPECT_EQ(code_of(), Exit::internal);
    exported.outputs = {"../out.exr"};
    EXPECT_EQ(code_of(), Exit::internal);
    exported.outputs = {"out.exr"};
    exported.radiance_scale = 0;
    EXPECT_EQ(code_of(), Exit::internal);
    exported.radiance_scale = 1;
    exported.files = {{"/etc/scene", ""}};
    EXPECT_EQ(code_of(), Exit::internal);
}

TEST_F(RunExported, AFolderThatCannotBeMadeIsNamed) {
    write_file_atomically(folder / "plain", "");
    try {
        write_exported(exported, folder / "plain" / "run");
        ADD_FAILURE() << "no error";
    } catch (const Error &error) {
        EXPECT_EQ(error.code(), Exit::input_output);
        EXPECT_THAT(error.what(), HasSubstr("plain/run"));
    }
}

class FindRenderer : public testing::Test {
protected:
    std::optional<InstalledRenderer> find(std::string_view commands) {
        program = folder.write_program("renderer", commands).string();
        return find_renderer(make_adapter(program));
    }
    std::string message_of(std::string_view commands) {
        try {
            find(commands);
        } catch (const Error &error) {
            EXPECT_EQ(error.code(), Exit::input_output);
            return error.what();
        }
        ADD_FAILURE() << "no error";
        return {};
    }

    const TemporaryFolder folder;
    std::string program;
};

TEST_F(FindRenderer, IsEmptyWhenThereIsNone) { EXPECT_FALSE(find_renderer(make_adapter())); }

TEST_F(FindRenderer, AsksForTheVersion) {
    const auto found = find("echo warning >&2; echo \"Fake 3.4 $1\"");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->version, "3.4 --version");
    EXPECT_EQ(found->program, program);
}

TEST_F(FindRenderer, ReportsARendererThatCrashesOrBabbles) {
    const std::string message = message_of("kill -ABRT $$");
    EXPECT_EQ(message, "Fake (" + program + ") does not tell its version: killed by signal 6 (Aborted)");
    EXPECT_THAT(message_of("echo Fake 3; exit 1"), EndsWith("exit code 1"));
    EXPECT_THAT(message_of("echo something; echo else"), EndsWith("unknown answer: something else"));
}

} // namespace
} // namespace threefold
