// SPDX-License-Identifier: MIT
// A stranger's scene as a claim, in the real renderers: from the command line to the verdict.
#include <cstdlib>
#include <sys/wait.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "exporter/files.h"
#include "tests/lit_orb_file.h"
#include "tests/temporary_folder.h"
#include "verifier/witness/witness.h"

namespace threefold {
namespace {

using testing::HasSubstr;

class PictureOfAFile : public testing::Test {
protected:
    void SetUp() override {
        for (const Witness &w : find_witnesses(witness_names()))
            if (!w.present()) GTEST_SKIP() << w.title << " is not installed";
        write_file_atomically(folder / "lit-orb.xml", tests::lit_orb_xml);
    }

    nlohmann::json check(const std::string &options, int exit_code) {
        const std::string command = "cd '" + folder.path().string() +
                                    "' && '" THREEFOLD_PROGRAM
                                    "' check --mitsuba lit-orb.xml --quick -q -o run --junit junit.xml " +
                                    options + " > out.txt 2>&1";
        const int status = std::system(command.c_str());
        EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, exit_code) << read_file(folder / "out.txt");
        return nlohmann::json::parse(read_file(folder / "run/result.json"));
    }

    const tests::TemporaryFolder folder;
};

TEST_F(PictureOfAFile, IsTheSameInAllThreeAndAFaultInOneIsNamed) {
    const nlohmann::json honest = check("", 0);
    const auto &claim = honest.at("claims").at(1);
    EXPECT_EQ(claim.at("name"), "picture");
    EXPECT_EQ(claim.at("verdict"), "holds");
    ASSERT_EQ(claim.at("tiles").size(), 3u) << "every two of the three";
    EXPECT_THAT(read_file(folder / "junit.xml"), HasSubstr("picture"));

    const nlohmann::json solid = check("--set thin.wall_share=0.01 --inject povray:no-inner-surface", 1);
    EXPECT_EQ(solid.at("claims").at(1).at("verdict"), "fails");
    EXPECT_EQ(solid.at("claims").at(1).at("blamed"), nlohmann::json::array({"povray"}));
    EXPECT_EQ(solid.at("assignments").at("thin.wall_share"), "0.01");
}

} // namespace
} // namespace threefold
