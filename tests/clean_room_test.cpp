// SPDX-License-Identifier: MIT
// tools/clean-room: what it says before it makes anything. CI runs the rest.
#include <cstdlib>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exporter/files.h"
#include "tests/temporary_folder.h"

namespace threefold {
namespace {

using testing::HasSubstr;

struct Ended {
    int exit_code;
    std::string out, err;
};

Ended run(const std::string &before, const std::string &arguments) {
    const tests::TemporaryFolder folder;
    const std::string out = folder / "out", err = folder / "err";
    const int status = std::system(
        fmt::format("cd '{}' && {} tools/clean-room {} >'{}' 2>'{}'", THREEFOLD_SOURCE_DIR, before, arguments, out, err)
            .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out), read_file(err)};
}

TEST(CleanRoom, TeachesByItsHelpAndRefusesWhatItDoesNotKnow) {
    const Ended help = run("", "--help");
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_THAT(help.out, HasSubstr("usage: tools/clean-room [--keep] SUITE [COMMAND...]"));
    for (const char *suite : {"bookworm", "trixie", "sid"}) EXPECT_THAT(help.out, HasSubstr(suite));
    EXPECT_EQ(run("", "").exit_code, 64);
    const Ended unknown = run("", "woody");
    EXPECT_EQ(unknown.exit_code, 64);
    EXPECT_THAT(unknown.err, HasSubstr("unknown suite \"woody\"; known are bookworm, trixie and sid"));
    EXPECT_EQ(run("", "--kepp trixie").exit_code, 64);
}

TEST(CleanRoom, SaysWhatRightItLacks) {
    const Ended ended =
        ::geteuid() == 0 ? run("setpriv --reuid 65534 --clear-groups", "trixie true") : run("", "trixie true");
    EXPECT_EQ(ended.exit_code, 77);
    EXPECT_THAT(ended.err, HasSubstr("this needs root"));
}

} // namespace
} // namespace threefold
