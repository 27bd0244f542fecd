// SPDX-License-Identifier: MIT
// The program as people and scripts meet it: exit codes, one-line errors, nothing half-written.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sys/wait.h>

#include <nlohmann/json.hpp>

#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "scenes/catalogue/catalogue.h"
#include "tests/lit_orb_file.h"
#include "tests/temporary_folder.h"

namespace threefold {
namespace {

using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

struct Answer {
    int exit_code;
    std::string out, err;
};

/// Runs the program through a shell, so that redirections and PATH can be part of a case.
Answer run(const tests::TemporaryFolder &folder, const std::string &arguments, const std::string &environment = "") {
    const fs::path out = folder / "out.txt", err = folder / "err.txt";
    const std::string command = "cd '" + fs::path(folder / ".").string() + "' && " + environment +
                                " '" THREEFOLD_PROGRAM "' " + arguments + " > '" + out.string() + "' 2> '" +
                                err.string() + "' < /dev/null";
    const int status = std::system(command.c_str());
    Answer answer{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out), read_file(err)};
    fs::remove(out);
    fs::remove(err);
    return answer;
}

void expect_one_clear_line(const Answer &answer, int exit_code, const std::string &saying) {
    EXPECT_EQ(answer.exit_code, exit_code) << answer.err;
    EXPECT_EQ(std::ranges::count(answer.err, '\n'), 1) << answer.err;
    EXPECT_THAT(answer.err, HasSubstr(saying));
    EXPECT_EQ(answer.out, "");
}

struct BadInput {
    std::string arguments;
    int exit_code;
    std::string saying;
};

void PrintTo(const BadInput &bad, std::ostream *out) { *out << bad.arguments; }

class Refuses : public testing::TestWithParam<BadInput> {};

TEST_P(Refuses, BadInputInOneLineWithItsExitCodeAndWritesNothing) {
    const tests::TemporaryFolder folder;
    expect_one_clear_line(run(folder, GetParam().arguments), GetParam().exit_code, GetParam().saying);
    EXPECT_TRUE(fs::is_empty(folder / ".")) << GetParam().arguments;
}

INSTANTIATE_TEST_SUITE_P(
    Cli, Refuses,
    testing::Values(
        BadInput{"render holow", 64, "did you mean 'hollow'"}, BadInput{"show nothing-like-it", 64, "calibration"},
        BadInput{"gallery 3C", 64, "unknown figure '3C'"}, BadInput{"gallery 3B --scale 0", 65, "--scale must lie in"},
        BadInput{"gallery 3B --with tracer --set orb.wal_mm=1", 64, "did you mean 'orb.wall_mm'"},
        BadInput{"check solid-vs-holow", 64, "did you mean 'solid-vs-hollow'"},
        BadInput{"render hollow --set orb.wal_mm=1", 64, "did you mean 'orb.wall_mm'"},
        BadInput{"check --with tracer --set orb.wal_mm=1 rim-reads-wall -o .", 64, "did you mean 'orb.wall_mm'"},
        BadInput{"render hollow --set orb.radius_mm=nan", 65, "finite"},
        BadInput{"render hollow --set orb.radius_mm=-1", 65, "out of range"},
        BadInput{"render hollow --set orb.radius_mm=0", 65, "out of range"},
        BadInput{"render hollow --set orb.wall_mm=68", 65, "thinner"},
        BadInput{"render hollow --set orb.wall_mm=100", 65, "thinner"},
        BadInput{"render hollow --set glass.index=0.99", 65, "out of range"},
        BadInput{"render hollow --set eye.distance_mm=60", 65, "eye"},
        BadInput{"render hollow --set eye.distance_mm=67.5", 65, "eye"},
        BadInput{"render hollow --set card.distance_mm=60", 65, "cuts"},
        BadInput{"render hollow --size 0x0", 65, "out of range"},
        BadInput{"render hollow --size 100000x100000", 65, "GB"},
        BadInput{"render hollow --size 12", 64, "WIDTHxHEIGHT"},
        BadInput{"render hollow --set nonsense", 64, "name=value"},
        BadInput{"render hollow --preset old", 64, "published"},
        BadInput{"render hollow --with mitsuba", 64, "valid: tracer, povray, cycles"},
        BadInput{"render hollow --spp 0", 65, "--spp"}, BadInput{"render hollow -o a.jpg", 64, ".exr"},
        BadInput{"render hollow --precision half", 64, "double"}, BadInput{"check --with mitsuba", 64, "renderer"},
        BadInput{"check --inject povray", 64, "RENDERER:FAULT"},
        BadInput{"check --inject povray:index+2%", 64, "did you mean 'index+1%'"},
        BadInput{"export hollow --to pov -o x", 64, "povray"}, BadInput{"compare a.exr b.exr", 74, "a.exr"},
        BadInput{"frobnicate", 64, "frobnicate"}, BadInput{"", 64, "subcommand"},
        BadInput{"render \"$(printf 'a\\nb')\"", 64, "unknown scene"}, BadInput{"render hollow --cut nan", 65, "--cut"},
        BadInput{"render hollow --timeout nan", 65, "--timeout"}, BadInput{"check --json - --junit -", 64, "stdout"},
        BadInput{"check --with tracer --inject povray:wall-doubled", 64, "takes no part"},
        BadInput{"check --quick --with tracer --set image.width_px=100000 --set image.height_px=100000", 65, "GB"},
        BadInput{"render hollow --with povray --spp 2000000000", 65, "read back"},
        BadInput{"check salvator --mitsuba a.xml", 64, "name no claims"},
        BadInput{"check --mitsuba a.xml --preset text", 64, "--preset"}, BadInput{"check --mitsuba a.xml", 74, "a.xml"},
        BadInput{"render hollow --seed -1", 64, "from 0 to 2^64 - 1"},
        BadInput{"render hollow --seed 18446744073709551616", 64, "--seed"},
        BadInput{"check --seed -1", 64, "from 0 to 2^64 - 1"}, BadInput{"power --seed -1", 64, "from 0 to 2^64 - 1"},
        BadInput{"render hollow --size 8x8 --spp 2147483648", 64, "--spp"}, BadInput{"optics --index 0.5", 65, "index"},
        BadInput{"optics --impact-mm nan", 65, "impact"}, BadInput{"optics --rows missing.json", 74, "missing.json"}));

TEST(Cli, AMeshThatIsNoneIsAnsweredInOneLineWhateverItsName) {
    const tests::TemporaryFolder folder;
    const std::string good = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const auto render = [&](const std::string &quoted_name) {
        return run(folder, "render salvator --size 8x12 --spp 1 --set hand.mesh=" + quoted_name);
    };
    write_file_atomically(folder / "empty.obj", "");
    write_file_atomically(folder / "words.obj", "no mesh at all\n");
    write_file_atomically(folder / "nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write_file_atomically(folder / "index.obj", good + "f 1 2 99\n");
    write_file_atomically(folder / "cut.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"meshes\": [{");
    fs::create_directory(folder / "folder.obj");
    for (const char *name : {"empty.obj", "words.obj", "nan.obj", "index.obj", "cut.gltf"})
        expect_one_clear_line(render(name), 65, std::string("cannot read mesh ") + name);
    expect_one_clear_line(render("missing.obj"), 74, "missing.obj: No such file");
    expect_one_clear_line(render("folder.obj"), 74, "directory");

    const std::string hostile = "\"; touch pwned; $(touch pwned)\n`touch pwned`.obj";
    const std::string quoted = "'" + hostile + "'";
    expect_one_clear_line(render(quoted), 74, "touch pwned");
    write_file_atomically(folder / hostile, "no mesh at all\n");
    expect_one_clear_line(render(quoted), 65, "cannot read mesh");
    EXPECT_FALSE(fs::exists(folder / "pwned"));
    // Only what was put there: no picture was begun.
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 7);
}

TEST(Cli, AnImageForAMeshWithoutTextureCoordinatesIsRefusedBeforeItIsRead) {
    const tests::TemporaryFolder folder;
    write_file_atomically(folder / "bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expect_one_clear_line(
        run(folder, "render salvator --size 8x12 --set hand.mesh=bare.obj --set hand.texture=missing.png"), 65,
        "bare.obj has no texture coordinates");
}

TEST(Cli, HelpTeachesAndSucceeds) {
    const tests::TemporaryFolder folder;
    const Answer help = run(folder, "--help");
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_THAT(help.out, HasSubstr("Start here"));
    EXPECT_THAT(help.out, HasSubstr("Exit codes"));
    for (const char *command :
         {"list", "show", "doctor", "export", "render", "check", "compare", "optics", "power", "extremes"}) {
        EXPECT_THAT(help.out, HasSubstr(command));
        EXPECT_EQ(run(folder, std::string(command) + " --help").exit_code, 0);
    }
}

TEST(Cli, ListAndShowNameEverything) {
    const tests::TemporaryFolder folder;
    const auto list = nlohmann::json::parse(run(folder, "list --json").out);
    EXPECT_EQ(list.at("scenes").size(), built_in_scenes().size());
    const Answer show = run(folder, "show hollow");
    EXPECT_THAT(show.out, HasSubstr("orb.wall_mm"));
    EXPECT_THAT(show.out, HasSubstr("1.36"));
    const auto json = nlohmann::json::parse(run(folder, "show hollow --preset published --json").out);
    EXPECT_EQ(json.at("parameters").at("eye.distance_mm").at("value"), 1200);
    EXPECT_EQ(json.at("scene").at("objects").size(), 2u);
}

TEST(Cli, TheTracerGivesAFirstPictureWithNoOtherProgramInPath) {
    const tests::TemporaryFolder folder;
    const Answer answer = run(folder, "render hollow --size 64x64", "PATH=/nowhere");
    EXPECT_EQ(answer.exit_code, 0) << answer.err;
    EXPECT_EQ(answer.out, "hollow.exr\nhollow.png\n");
    const Image image = read_image(folder / "hollow.exr");
    EXPECT_EQ(image.width, 64);
    EXPECT_THAT(answer.err, HasSubstr("dropped"));
}

TEST(Cli, ARendererThatWasDemandedAndIsMissingIsExit69) {
    const tests::TemporaryFolder folder;
    expect_one_clear_line(run(folder, "render hollow --with povray", "PATH=/nowhere"), 69, "apt-get install povray");
    EXPECT_EQ(run(folder, "check --with cycles -o report", "PATH=/nowhere").exit_code, 69);
}

TEST(Cli, WithoutTheOthersACheckIsUndecidedSaysWhichAreMissingAndTheTracerStillAnswers) {
    const tests::TemporaryFolder folder;
    const Answer answer = run(folder, "check --quick rim-reads-wall -o report --json -", "PATH=/nowhere");
    EXPECT_EQ(answer.exit_code, 2) << answer.err;
    const auto json = nlohmann::json::parse(answer.out);
    EXPECT_EQ(json.at("verdict"), "undecided");
    EXPECT_THAT(json.at("summary").get<std::string>(), HasSubstr("POV-Ray is not installed"));
    EXPECT_THAT(json.at("summary").get<std::string>(), HasSubstr("Cycles is not installed"));
    bool tracer_answers = false;
    for (const auto &claim : json.at("claims"))
        for (const auto &row : claim.at("rows"))
            tracer_answers |= row.at("witness") == "tracer" && row.at("verdict") == "holds";
    EXPECT_TRUE(tracer_answers);
}

TEST(Cli, WhatTheTracerRefusesLeavesOutOneExperimentAndNotTheRun) {
    const tests::TemporaryFolder folder;
    const Answer answer =
        run(folder, "check --quick --with tracer rim-reads-wall salvator --set hand.drop_mm=-5 -o report --json -");
    EXPECT_EQ(answer.exit_code, 2) << answer.err;
    const auto json = nlohmann::json::parse(answer.out);
    EXPECT_THAT(json.at("summary").get<std::string>(), HasSubstr("gave no picture of salvator-"));
    for (const auto &claim : json.at("claims"))
        if (claim.at("name") != "salvator") {
            EXPECT_EQ(claim.at("verdict"), "holds") << claim.at("name");
        }
}

TEST(Cli, CheckWritesReportJsonAndJunit) {
    const tests::TemporaryFolder folder;
    const Answer answer = run(folder, "check --quick --with tracer -o report --junit j.xml --json r.json");
    EXPECT_EQ(answer.exit_code, 0) << answer.err << answer.out;
    EXPECT_THAT(answer.out, HasSubstr("report: "));
    EXPECT_THAT(answer.out, Not(HasSubstr("\033")));
    for (const char *file : {"report/report.html", "report/result.json", "j.xml", "r.json"})
        EXPECT_TRUE(fs::exists(folder / file)) << file;
}

TEST(Cli, AFaultIsAnsweredByFailsAndExit1) {
    const tests::TemporaryFolder folder;
    const Answer answer =
        run(folder, "check --quick --with tracer rim-reads-wall --inject tracer:wall-doubled -o report");
    EXPECT_EQ(answer.exit_code, 1);
    EXPECT_THAT(answer.out, HasSubstr("racer"));
}

TEST(Cli, ADryRunRendersNothing) {
    const tests::TemporaryFolder folder;
    const Answer answer = run(folder, "check --dry-run");
    EXPECT_EQ(answer.exit_code, 0);
    EXPECT_THAT(answer.out, HasSubstr("hollow-map"));
    EXPECT_TRUE(fs::is_empty(folder / "."));
}

TEST(Cli, CompareJudgesPicturesAndRefusesDamagedOnes) {
    const tests::TemporaryFolder folder;
    run(folder, "render solid --size 48x48 --spp 64 -o a.exr");
    run(folder, "render solid --size 48x48 --spp 64 --seed 2 -o b.exr");
    run(folder, "render solid --size 48x48 --spp 64 --set glass.index=1.7 -o c.exr");
    run(folder, "render solid --size 40x48 -o small.exr");
    EXPECT_EQ(run(folder, "compare a.exr b.exr --tolerance 0.03").exit_code, 0);
    const Answer fails = run(folder, "compare a.exr b.exr c.exr -o maps --json -");
    EXPECT_EQ(fails.exit_code, 1);
    EXPECT_EQ(nlohmann::json::parse(fails.out).at("pairs").size(), 3u);
    EXPECT_TRUE(fs::exists(folder / "maps/difference-1-3.png"));
    expect_one_clear_line(run(folder, "compare a.exr small.exr"), 65, "40 x 48");
    fs::resize_file(folder / "b.exr", fs::file_size(folder / "b.exr") / 2);
    expect_one_clear_line(run(folder, "compare a.exr b.exr"), 65, "b.exr");
    std::ofstream(folder / "text.exr") << "no picture";
    EXPECT_EQ(run(folder, "compare a.exr text.exr").exit_code, 65);
}

TEST(Cli, AFolderThatCannotBeWrittenIsExit74) {
    const tests::TemporaryFolder folder;
    std::ofstream(folder / "file") << "x";
    expect_one_clear_line(run(folder, "render hollow --size 16x16 -q -o file/a.exr"), 74, "file");
    expect_one_clear_line(run(folder, "check --quick --with tracer -q -o file/report"), 74, "file");
    expect_one_clear_line(run(folder, "export hollow --to povray -o file/x"), 74, "file");
}

TEST(Cli, AFullDiskIsExit74AndLeavesNothingUnderAFinalName) {
    const tests::TemporaryFolder folder;
    // A limit on file size stands for the full disk: the write is cut short in the same way.
    const Answer answer = run(folder, "render hollow --size 256x256 --spp 1 -q -o big.exr", "ulimit -f 8;");
    EXPECT_EQ(answer.exit_code, 74) << answer.err;
    EXPECT_FALSE(fs::exists(folder / "big.exr"));
    EXPECT_TRUE(fs::is_empty(folder / "."));
    for (const char *command : {"list", "--help", "--version", "check --help", "--man-page", "--completion"})
        EXPECT_EQ(run(folder, std::string(command) + " > /dev/full; exit $?").exit_code, 74) << command;
}

TEST(Cli, SurvivesStreamsThatCannotBeWritten) {
    const tests::TemporaryFolder folder;
    EXPECT_EQ(run(folder, "list nosuch 2>&-; exit $?").exit_code, 64);
    EXPECT_EQ(run(folder, "show nosuch 2>/dev/full; exit $?").exit_code, 64);
    EXPECT_EQ(run(folder, "show hollow --json >/dev/full; exit $?").exit_code, 74);
    EXPECT_EQ(run(folder, "render hollow --size 16x16 -o a.exr 2>&-; exit $?").exit_code, 0);
}

TEST(Cli, OddScenesAreNeverHeldAgainstTheRenderer) {
    const tests::TemporaryFolder folder;
    for (const char *set :
         {"orb.wall_mm=20", "orb.wall_mm=30", "orb.wall_mm=60", "orb.wall_mm=67.9", "glass.index=1.01",
          "orb.shift_mm=30", "orb.shift_mm=200", "eye.distance_mm=68.1", "image.orb_share=1e-6", "image.orb_share=1.5",
          "orb.wall_mm=1e-7", "environment.radiance=0.01"}) {
        const Answer answer =
            run(folder, std::string("check --quick --with tracer energy rim-reads-wall -o r --json - --set ") + set);
        // Exit 1: exact optics denies the conclusion there.
        ASSERT_TRUE(answer.exit_code == 0 || answer.exit_code == 1 || answer.exit_code == 2)
            << set << ": " << answer.exit_code << answer.err;
        for (const auto &claim : nlohmann::json::parse(answer.out).at("claims"))
            EXPECT_TRUE(claim.at("blamed").empty()) << set << ": " << claim.at("name");
    }
}

/// `timeout` asks it to stop after a second, and kills it, with exit 137, if it has not done so long after.
TEST(Cli, StopsInsideAPixelOfVeryManySamples) {
    const tests::TemporaryFolder folder;
    for (const char *options : {"hollow --size 4x4 --spp 500000000", "hollow --size 4x4 --spp 2147483647",
                                "hollow --size 4x4 --spp 500000000 --precision float",
                                "solid --size 4x4 --spp 536870912 --set environment.radiance=1 image.orb_share=0.01",
                                "setup --size 4x4 --spp 500000000", "furnace --size 4x4 --spp 500000000"}) {
        const Answer answer = run(folder, std::string("render ") + options + " --threads 1 -q -o a.exr",
                                  "timeout --foreground --preserve-status -k 20 1");
        EXPECT_EQ(answer.exit_code, 130) << options << answer.err;
        EXPECT_THAT(answer.err, HasSubstr("interrupted")) << options;
        EXPECT_FALSE(fs::exists(folder / "a.exr")) << options;
    }
}

TEST(Cli, ComparesNoPicturesOfOnePixel) {
    const tests::TemporaryFolder folder;
    run(folder, "render solid --size 1x1 -o a.exr");
    expect_one_clear_line(run(folder, "compare a.exr a.exr"), 65, "too small");
}

TEST(Cli, ARendererThatDoesNotTellItsVersionHasNoVoteAndTheOthersGoOn) {
    const tests::TemporaryFolder folder;
    fs::create_directory(folder / "bin");
    std::ofstream(folder / "bin/povray") << "#!/bin/sh\nexit 3\n";
    fs::permissions(folder / "bin/povray", fs::perms::owner_all);
    const Answer answer = run(folder, "check --quick rim-reads-wall -o report", "PATH=$PWD/bin");
    EXPECT_EQ(answer.exit_code, 2) << answer.err;
    EXPECT_THAT(answer.out, HasSubstr("version"));
    EXPECT_EQ(run(folder, "check --quick --with povray -o report", "PATH=$PWD/bin").exit_code, 74);
}

/// A stand-in for a renderer that is broken in one way; it takes part in no claim of agreement.
void put_broken_povray(const tests::TemporaryFolder &folder, const std::string &behaviour) {
    fs::create_directory(folder / "bin");
    std::ofstream(folder / "bin/povray")
        << "#!/bin/sh\ncase \"$*\" in *ersion*) echo 'POV-Ray 3.7.0.10'; exit 0;; esac\n"
        << behaviour << "\n";
    fs::permissions(folder / "bin/povray", fs::perms::owner_all);
}

TEST(Cli, ARendererThatCrashesOrWritesNothingHasNoVoteAndTheOthersGoOn) {
    for (const char *behaviour : {"kill -SEGV $$", "exit 1", "exit 0", "head -c 40 /dev/zero > picture1.png"}) {
        const tests::TemporaryFolder folder;
        put_broken_povray(folder, behaviour);
        const Answer answer = run(folder, "check --quick --with tracer,povray rim-reads-wall -o report --json -",
                                  "PATH=$PWD/bin:/bin:/usr/bin");
        EXPECT_EQ(answer.exit_code, 2) << behaviour << answer.err;
        const auto json = nlohmann::json::parse(answer.out);
        EXPECT_THAT(json.at("summary").get<std::string>(), HasSubstr("POV-Ray gave no picture")) << behaviour;
        EXPECT_TRUE(fs::exists(folder / "report/report.html"));
        EXPECT_EQ(run(folder, "render hollow --size 16x16 --with povray -q -o a.exr", "PATH=$PWD/bin:/bin:/usr/bin")
                      .exit_code,
                  74);
        EXPECT_FALSE(fs::exists(folder / "a.exr"));
    }
}

TEST(Cli, ARendererThatHangsIsStoppedAndExit124) {
    const tests::TemporaryFolder folder;
    put_broken_povray(folder, "sleep 1000");
    const Answer answer = run(folder, "check --quick --timeout 1 --with tracer,povray rim-reads-wall -o report",
                              "PATH=$PWD/bin:/bin:/usr/bin");
    EXPECT_EQ(answer.exit_code, 124) << answer.err;
    EXPECT_THAT(answer.out, HasSubstr("out of time"));
    EXPECT_EQ(
        run(folder, "render hollow --size 16x16 --with povray --timeout 1 -q", "PATH=$PWD/bin:/bin:/usr/bin").exit_code,
        124);
}

TEST(Cli, ExportsAreCompleteFoldersWithWhatTheyLose) {
    const tests::TemporaryFolder folder;
    const Answer povray = run(folder, "export hollow --to povray --strict -o p");
    EXPECT_EQ(povray.exit_code, 0) << povray.err;
    EXPECT_THAT(povray.out, HasSubstr("p/scene.pov\n"));
    EXPECT_THAT(povray.err, HasSubstr("nothing is lost"));
    for (const char *name : {"p/scene.pov", "p/scene.ini", "p/README.txt", "p/LOSSES.txt"})
        EXPECT_TRUE(fs::exists(folder / name)) << name;

    expect_one_clear_line(run(folder, "export hollow --to obj --strict -o o"), 65, "OBJ cannot say all of hollow");
    EXPECT_FALSE(fs::exists(folder / "o"));
    const Answer obj = run(folder, "export hollow --set orb.wall_mm=2 --preset published --to obj -o o");
    EXPECT_EQ(obj.exit_code, 0) << obj.err;
    EXPECT_THAT(obj.err, HasSubstr("  The camera."));
    EXPECT_THAT(read_file(folder / "o/LOSSES.txt"), HasSubstr("- The camera."));
    const std::string readme = read_file(folder / "o/README.txt");
    EXPECT_THAT(readme, HasSubstr("orb.wall_mm = 2\n"));
    EXPECT_THAT(readme, HasSubstr("threefold export hollow --preset published --set orb.wall_mm=2 --to obj"));

    expect_one_clear_line(run(folder, "export hollow --to povray -o o"), 74, "not empty");
    expect_one_clear_line(run(folder, "export hollow --to obj --onto card -o n"), 64, "--onto");
    expect_one_clear_line(run(folder, "export salvator --set robe.relief_resolution=20 --to stmap -o n"), 64, "robe");
    EXPECT_FALSE(fs::exists(folder / "n"));
}

TEST(Cli, ShowTellsWhatAMitsubaFileIsTakenFor) {
    const tests::TemporaryFolder folder;
    write_file_atomically(folder / "sheet.xml", R"(<scene version="0.5.0">
<sensor type="perspective"><float name="fov" value="10"/><transform name="toWorld"><lookat origin="90,0,0" target="0,0,0" up="0,1,0"/></transform></sensor>
<emitter type="constant"><spectrum name="radiance" value="1"/></emitter>
<shape type="sphere"><bsdf type="thindielectric"><spectrum name="specularTransmittance" value="0.85"/></bsdf></shape>
</scene>)");
    // It changes the picture: said without --verbose.
    const Answer told = run(folder, "show --mitsuba sheet.xml");
    EXPECT_EQ(told.exit_code, 0) << told.err;
    EXPECT_THAT(told.err, HasSubstr("a sheet without thickness"));
    EXPECT_THAT(told.err, HasSubstr("reflects about 7.5 % less"));
    EXPECT_EQ(std::ranges::count(told.err, '\n'), 1) << told.err;
}

TEST(Cli, ChecksThePictureOfAMitsubaFileLikeAnyClaim) {
    const tests::TemporaryFolder folder;
    write_file_atomically(folder / "lit-orb.xml", tests::lit_orb_xml);
    const std::string check = "check --mitsuba lit-orb.xml --quick --with tracer --set file.unit_mm=1 ";
    const Answer plan = run(folder, check + "--dry-run");
    EXPECT_EQ(plan.exit_code, 0) << plan.err;
    EXPECT_THAT(plan.out, HasSubstr("scene lit-orb              96 x 64 px, 8 replicates"));
    const Answer unknown = run(folder, check + "--set file.unit=1");
    EXPECT_EQ(unknown.exit_code, 64);
    EXPECT_THAT(unknown.err, HasSubstr("did you mean 'file.unit_mm'"));
    const Answer alone = run(folder, check + "--json - --junit junit.xml -o run");
    EXPECT_EQ(alone.exit_code, 2) << "one picture agrees with nothing";
    const auto result = nlohmann::json::parse(alone.out);
    ASSERT_EQ(result.at("claims").size(), 2u);
    EXPECT_EQ(result.at("claims").at(0).at("verdict"), "holds");
    EXPECT_EQ(result.at("claims").at(1).at("name"), "picture");
    EXPECT_EQ(result.at("claims").at(1).at("verdict"), "undecided");
    EXPECT_EQ(result.at("assignments").at("file.unit_mm"), "1");
    EXPECT_THAT(read_file(folder / "junit.xml"), HasSubstr("the same picture of lit-orb"));
    EXPECT_TRUE(fs::exists(folder / "run/report.html"));
}

TEST(Cli, ClaimsScenesForElsewhereGoIntoAFolderOfTheirOwn) {
    const tests::TemporaryFolder folder;
    write_file_atomically(folder / "mine.txt", "kept");
    const Answer answer = run(folder, "check calibration --quick --export mitsuba=.");
    EXPECT_EQ(answer.exit_code, 74) << answer.err;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "."), fs::directory_iterator()), 1);
    EXPECT_EQ(run(folder, "check calibration --quick --export mitsuba=there").exit_code, 0);
    EXPECT_TRUE(fs::exists(folder / "there/render.sh"));
    const std::string script = read_file(folder / "there/render.sh");
    EXPECT_EQ(run(folder, "check calibration --quick --export mitsuba=there").exit_code, 74);
    EXPECT_EQ(read_file(folder / "there/render.sh"), script);
}

TEST(Cli, ExportsThatNeedBlenderSayWhenItIsMissing) {
    const tests::TemporaryFolder folder;
    for (const char *format : {"blender", "glb"})
        expect_one_clear_line(run(folder, fmt::format("export hollow --to {} -o x", format), "PATH=/nowhere"), 69,
                              "Blender is not installed");
    EXPECT_FALSE(fs::exists(folder / "x"));
}

} // namespace
} // namespace threefold
