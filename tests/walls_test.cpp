// SPDX-License-Identifier: MIT
// The walls of the house, read from the includes.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

using Includes = std::map<std::string, std::set<std::string>>; // file -> files of ours that it includes

const fs::path root = THREEFOLD_SOURCE_DIR;

std::string text_of(const fs::path &path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

const Includes &includes() {
    static const Includes all = [] {
        Includes found;
        const std::regex include("#include \"([^\"]+)\"");
        for (const char *room : {"scenes", "exporter", "verifier", "tools"})
            for (const auto &entry : fs::recursive_directory_iterator(root / room)) {
                const std::string extension = entry.path().extension().string();
                if (extension != ".h" && extension != ".cpp") continue;
                auto &mine = found[fs::relative(entry.path(), root).generic_string()];
                const std::string text = text_of(entry.path());
                for (auto i = std::sregex_iterator(text.begin(), text.end(), include); i != std::sregex_iterator(); ++i)
                    mine.insert((*i)[1]);
            }
        return found;
    }();
    return all;
}

bool lies_in(const std::string &file, const std::string &folder) { return file.starts_with(folder); }

/// Everything that a file includes, directly or not.
std::set<std::string> reached_from(const std::string &file) {
    std::set<std::string> reached, open{file};
    while (!open.empty()) {
        const std::string next = *open.begin();
        open.erase(open.begin());
        const auto found = includes().find(next);
        if (found == includes().end()) continue;
        for (const std::string &i : found->second)
            if (reached.insert(i).second) open.insert(i);
    }
    return reached;
}

void expect_no_way(const std::string &from_folder, const std::string &to_folder) {
    std::size_t files = 0;
    for (const auto &[file, direct] : includes()) {
        if (!lies_in(file, from_folder)) continue;
        ++files;
        for (const std::string &reached : reached_from(file))
            EXPECT_FALSE(lies_in(reached, to_folder)) << file << " reaches " << reached;
    }
    EXPECT_GT(files, 0u) << "nothing lies in " << from_folder;
}

TEST(Walls, NothingIncludesUpwards) {
    const std::vector<std::string> layers{"scenes/", "exporter/", "verifier/", "tools/"};
    for (std::size_t low = 0; low < layers.size(); ++low)
        for (std::size_t high = low + 1; high < layers.size(); ++high) expect_no_way(layers[low], layers[high]);
}

TEST(Walls, NothingIsWrittenForOneMajorVersionOfEmbreeAlone) {
    int users = 0;
    for (const char *room : {"scenes", "exporter", "verifier", "tools", "tests"})
        for (const auto &entry : fs::recursive_directory_iterator(root / room)) {
            if (entry.path().filename() == "walls_test.cpp" || !entry.is_regular_file()) continue;
            const std::string text = text_of(entry.path());
            const bool three = text.find("<embree3/") != std::string::npos;
            const bool four = text.find("<embree4/") != std::string::npos;
            EXPECT_EQ(three, four) << entry.path();
            users += three && four;
        }
    EXPECT_GT(users, 0);
}

TEST(Walls, EveryIncludeOfOursIsAFileFromTheRoot) {
    for (const auto &[file, direct] : includes())
        for (const std::string &i : direct) EXPECT_TRUE(fs::exists(root / i)) << file << " includes " << i;
}

TEST(Walls, TheExporterNeverSeesTheCatalogue) { expect_no_way("exporter/", "scenes/catalogue/"); }

TEST(Walls, TheTracerNeverSeesTheClosedForms) { expect_no_way("verifier/tracer/", "verifier/optics/"); }

TEST(Walls, TheClosedFormsKnowNoRendererAndNoPicture) {
    for (const char *room : {"exporter/", "verifier/tracer/", "verifier/measure/", "verifier/claims/"})
        expect_no_way("verifier/optics/", room);
}

TEST(Walls, MeasuringNeverLearnsWhoMadeAPicture) {
    for (const char *room :
         {"exporter/adapter.h", "exporter/run.h", "exporter/povray/", "exporter/blender/", "verifier/tracer/",
          "verifier/witness/", "verifier/check/", "verifier/claims/", "verifier/optics/"})
        expect_no_way("verifier/measure/", room);
}

TEST(Walls, TheReportOnlyReadsResults) {
    for (const char *room :
         {"verifier/claims/", "verifier/witness/", "verifier/check/", "verifier/tracer/", "verifier/optics/"})
        expect_no_way("verifier/report/", room);
}

TEST(Walls, ClaimsNeverReachARenderer) {
    for (const char *room : {"exporter/adapter.h", "exporter/run.h", "exporter/povray/", "exporter/blender/",
                             "verifier/tracer/", "verifier/witness/", "verifier/check/", "verifier/report/"})
        expect_no_way("verifier/claims/", room);
}

TEST(Walls, ClaimsNeverNameARenderer) {
    const std::regex name("pov-?ray|cycles|blender|embree|\\btracer\\b|mitsuba", std::regex::icase);
    for (const auto &[file, direct] : includes())
        if (lies_in(file, "verifier/claims/") || lies_in(file, "verifier/measure/")) {
            std::smatch match;
            const std::string text = text_of(root / file);
            EXPECT_FALSE(std::regex_search(text, match, name)) << file << " names " << match.str();
        }
}

TEST(Walls, TheTopLevelIsFixed) {
    const std::set<std::string> allowed{"CMakeLists.txt", "CMakePresets.json", "CHANGELOG.md", "LICENSE", "README.md",
                                        "docs",           "exporter",          "scenes",       "tests",   "tools",
                                        "verifier"};
    for (const auto &entry : fs::directory_iterator(root)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(".") || name.starts_with("build") || name.starts_with("threefold-report")) continue;
        EXPECT_TRUE(allowed.contains(name)) << name;
    }
}

TEST(Walls, EveryFileReadsInOneSitting) {
    for (const auto &[file, direct] : includes()) {
        const std::string text = text_of(root / file);
        EXPECT_LE(std::ranges::count(text, '\n'), 500) << file;
        EXPECT_TRUE(text.starts_with("// SPDX-License-Identifier: MIT\n")) << file;
    }
}

} // namespace
