// SPDX-License-Identifier: MIT
// What the help, the manual page and the completion say of a command line, and what the parser takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "exporter/files.h"
#include "tests/temporary_folder.h"
#include "tools/options.h"

namespace threefold {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::UnorderedElementsAreArray;
using Words = std::vector<std::string>;

std::string output_of(const tests::TemporaryFolder &folder, const std::string &command) {
    const auto out = folder / "out.txt";
    std::system(
        fmt::format("cd '{}' && {} > '{}' 2>&1 < /dev/null", folder.path().string(), command, out.string()).c_str());
    return read_file(out);
}

std::string said(const std::string &arguments) {
    return output_of(tests::TemporaryFolder(), "'" THREEFOLD_PROGRAM "' " + arguments);
}

/// "--set" and so on, and no short names: how a help begins its lines differs between versions of CLI11.
Words long_options(const std::string &help) {
    Words found;
    const std::regex option(R"((?:^|\n) +(?:-[a-z], *)?(--[a-z-]+))");
    for (std::sregex_iterator i(help.begin(), help.end(), option); i != std::sregex_iterator(); ++i)
        found.push_back((*i)[1]);
    return found;
}

Words commands() {
    return {"list",  "show",  "doctor",   "export", "render",  "check", "gallery",
            "power", "trade", "extremes", "scope",  "compare", "optics"};
}

TEST(CommandLine, HelpKnowsTheCommandsThatTheseTestsGoThrough) {
    const std::string help = said("--help");
    Words found;
    std::istringstream lines(
        help.substr(help.find("ubcommands") != std::string::npos ? help.find("ubcommands") : help.find("UBCOMMANDS")));
    std::string line, word;
    std::getline(lines, line);
    while (std::getline(lines, line) && line.starts_with("  "))
        if (std::istringstream(line) >> word && line[2] != ' ') found.push_back(word);
    EXPECT_THAT(found, UnorderedElementsAreArray(commands()));
}

TEST(CommandLine, TheManualPageHasEveryCommandAndEveryOptionOfTheHelp) {
    const std::string page = std::regex_replace(said("--man-page"), std::regex(R"(\\-)"), "-");
    std::size_t options = 0;
    for (const std::string &command : commands()) {
        const std::size_t begin = page.find("\n.SS " + command + "\n");
        ASSERT_NE(begin, std::string::npos) << command;
        const std::string section = page.substr(begin, page.find("\n.S", begin + 5) - begin);
        for (const std::string &option : long_options(said(command + " --help"))) {
            EXPECT_TRUE(std::regex_search(section, std::regex(option + R"([ \\])"))) << command << " " << option;
            ++options;
        }
    }
    EXPECT_GT(options, 100u);
    for (const std::string &option : long_options(said("--help"))) EXPECT_THAT(page, HasSubstr(option));
    EXPECT_THAT(page, HasSubstr("69 renderer missing"));
}

/// What is offered for the last of some words.
Words completions(const Words &words) {
    const tests::TemporaryFolder folder;
    std::string typed;
    for (const std::string &word : words) typed += fmt::format(" '{}'", word);
    const std::string script =
        fmt::format("'{}' --completion > c; . ./c; COMP_WORDS=(threefold{}); COMP_CWORD={}; _threefold; "
                    "printf '%s\\n' \"${{COMPREPLY[@]}}\"",
                    THREEFOLD_PROGRAM, typed, words.size());
    write_file_atomically(folder / "script", script);
    std::istringstream offered(output_of(folder, "bash script"));
    Words found;
    for (std::string word; offered >> word;) found.push_back(word);
    return found;
}

TEST(CommandLine, CompletionOffersEveryCommandAndEveryOptionOfTheHelp) {
    Words first = commands();
    for (const std::string &option : long_options(said("--help"))) first.push_back(option);
    EXPECT_THAT(completions({""}), IsSupersetOf(first));
    for (const std::string &command : commands())
        EXPECT_THAT(completions({command, "--"}), UnorderedElementsAreArray(long_options(said(command + " --help"))))
            << command;
}

TEST(CommandLine, CompletionOffersWhatAnOptionOrAnArgumentCanBe) {
    const auto names = [](const char *list) {
        Words all;
        const auto listed = nlohmann::json::parse(said("list --json"));
        for (const auto &entry : listed.at(list)) all.push_back(entry.at("name"));
        return all;
    };
    EXPECT_THAT(completions({"render", ""}), UnorderedElementsAreArray(names("scenes")));
    EXPECT_THAT(completions({"check", "--quick", ""}), UnorderedElementsAreArray(names("claims")));
    EXPECT_THAT(completions({"power", "--faults", ""}), UnorderedElementsAreArray(names("faults")));
    EXPECT_THAT(completions({"render", "--with", "p"}), ElementsAre("povray"));
    EXPECT_THAT(completions({"check", "--with", "tracer,c"}), ElementsAre("tracer,cycles"));
    EXPECT_THAT(completions({"check", "--preset", "b"}), ElementsAre("both"));
    EXPECT_THAT(completions({"render", "--preset", "b"}), ElementsAre());
    EXPECT_THAT(completions({"show", "hollow", "--set", "orb.wal"}), ElementsAre("orb.wall_mm="));
    EXPECT_THAT(completions({"render", "--size", ""}), ElementsAre()) << "a number";
}

TEST(CommandLine, AnOptionTakesAllThatHasItsFormAndNoArgument) {
    EXPECT_EQ(repeat_options({"show", "hollow", "--set", "a=1", "b=2"}),
              (Words{"show", "hollow", "--set", "a=1", "--set", "b=2"}));
    EXPECT_EQ(repeat_options({"show", "--set", "a=1", "b=2", "hollow"}),
              (Words{"show", "--set", "a=1", "--set", "b=2", "hollow"}));
    EXPECT_EQ(repeat_options({"show", "--set=a=1", "b=2", "--json"}),
              (Words{"show", "--set=a=1", "--set", "b=2", "--json"}));
    EXPECT_EQ(repeat_options({"show", "--set", "a", "hollow"}), (Words{"show", "--set", "a", "hollow"}));
    EXPECT_EQ(
        repeat_options({"check", "--inject", "povray:x", "cycles:y", "tint", "--image", "m=a", "n=b"}),
        (Words{"check", "--inject", "povray:x", "--inject", "cycles:y", "tint", "--image", "m=a", "--image", "n=b"}));
    EXPECT_EQ(repeat_options({"check", "--set", "a=1", "--", "b=2"}), (Words{"check", "--set", "a=1", "--", "b=2"}));
    EXPECT_EQ(repeat_options({"show", "--set"}), (Words{"show", "--set"}));
    EXPECT_EQ(repeat_options({"compare", "a=1.exr", "b=2.exr"}), (Words{"compare", "a=1.exr", "b=2.exr"}));
}

TEST(CommandLine, EveryCommandTakesOneOrManyAssignmentsAfterSet) {
    const auto show = nlohmann::json::parse(said("show --set orb.wall_mm=2 glass.index=1.6 hollow --json"));
    EXPECT_EQ(show.at("parameters").at("orb.wall_mm").at("value"), 2);
    EXPECT_EQ(show.at("parameters").at("glass.index").at("value"), 1.6);
    std::size_t takers = 0;
    for (const std::string &command : commands()) {
        const Words options = long_options(said(command + " --help"));
        if (std::ranges::count(options, "--set") == 0) continue;
        ++takers;
        const std::string rest = command == "export" ? " --to obj -o x" : "";
        const std::string argument = command == "check" || command == "scope" ? " tint"
                                     : command == "gallery"                   ? " 3B"
                                                                              : " hollow";
        for (const std::string &line : {command + argument + " --set glass.index=1.6 orb.wal_mm=2" + rest,
                                        command + " --set glass.index=1.6 orb.wal_mm=2" + argument + rest})
            EXPECT_THAT(said(line), HasSubstr("did you mean 'orb.wall_mm'")) << line;
    }
    EXPECT_EQ(takers, 7u);
}

TEST(CommandLine, HelpShowsSeveralValuesOnlyWhereSeveralAreTaken) {
    for (const std::string &command : commands()) {
        const std::string help = said(command + " --help");
        EXPECT_FALSE(std::regex_search(help, std::regex(R"(--[a-z-]+ (TEXT|FLOAT|INT)[^\n]* \.\.\.)"))) << help;
    }
}

TEST(CommandLine, HowLongACheckTakesIsSaidInTheReadmeAlone) {
    const std::regex time(R"([0-9a-z]+ (min|minutes?|hours?)\b(?! of arc))");
    const auto text = [](const char *file) { return read_file(std::filesystem::path(THREEFOLD_SOURCE_DIR) / file); };
    const std::string readme = text("README.md"), budgets = text("docs/BUDGETS.md"), help = said("check --help");
    EXPECT_EQ(std::distance(std::sregex_iterator(readme.begin(), readme.end(), time), {}), 1);
    EXPECT_FALSE(std::regex_search(budgets, time));
    EXPECT_FALSE(std::regex_search(help, time)) << help;
    EXPECT_THAT(help, HasSubstr("README.md says how long"));
}

} // namespace
} // namespace threefold
