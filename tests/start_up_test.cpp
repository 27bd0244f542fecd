// SPDX-License-Identifier: MIT
// What the program loads before its first line. Each shared library costs time in every command, and OpenImageIO with
// the 260 that it draws in ten times as much as all others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <regex>
#include <string>
#include <vector>

namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

std::string output_of(const std::string &command) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE *)> pipe(::popen(command.c_str(), "r"), ::pclose);
    std::string text;
    char buffer[4096];
    while (const std::size_t count = std::fread(buffer, 1, sizeof buffer, pipe.get())) text.append(buffer, count);
    return text;
}

std::vector<std::string> found(const std::string &text, const char *pattern) {
    const std::regex regex(pattern);
    std::vector<std::string> all;
    for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) all.push_back((*i)[1]);
    return all;
}

/// Of all libraries that the loader maps, those of other libraries too.
std::vector<std::string> loaded_at_start() {
    return found(output_of("LD_TRACE_LOADED_OBJECTS=1 '" THREEFOLD_PROGRAM "' list"), "\\t(\\S+) ");
}

TEST(StartUp, TheProgramIsLinkedToNoOtherLibrariesThanThese) {
    const auto linked = found(output_of("readelf -dW '" THREEFOLD_PROGRAM "'"), "\\(NEEDED\\).*\\[(.*)\\]");
    EXPECT_THAT(linked, Contains(HasSubstr("libembree")));
    // The second group: the C and C++ libraries, and what a sanitizer needs.
    const std::regex allowed(
        "lib(embree[34]|tbb|assimp|pugixml|fmt|OpenEXR|OpenEXRCore|Iex|IlmThread|Imath|png16|z)\\b.*"
        "|lib(stdc\\+\\+|gcc_s|m|c|dl|pthread|asan|ubsan)\\.so.*|ld-linux.*");
    for (const std::string &library : linked) EXPECT_TRUE(std::regex_match(library, allowed)) << library;
}

TEST(StartUp, NothingThatTheProgramLoadsDrawsInOpenImageIo) {
    const auto loaded = loaded_at_start();
    EXPECT_THAT(loaded, Contains(HasSubstr("libembree")));
    EXPECT_THAT(loaded, Not(Contains(HasSubstr("OpenImageIO"))));
    EXPECT_LE(loaded.size(), 32u) << testing::PrintToString(loaded);
}

} // namespace
