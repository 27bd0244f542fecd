// SPDX-License-Identifier: MIT
#include "verifier/report/html.h"
#include "verifier/report/json.h"
#include "verifier/report/junit.h"
#include "verifier/report/numbers.h"
#include "verifier/report/terminal.h"
#include "verifier/report/text.h"

#include <fstream>
#include <iterator>
#include <limits>
#include <regex>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

namespace threefold {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const std::string hostile = "</script><script>alert(\"1\")</script>'&\x1b[31m\xff\n]]>";

Row row(const std::string &quantity, const std::string &witness, const std::string &versus, Verdict verdict) {
    Row r{"hollow", quantity, "mm", witness, versus, Relation::equal, {1.25, .01, 7, 8}, {1.2311, 1.2689},
          1.2,      .1,       {},   verdict, {}};
    r.budget = {{"sampling", .06, "noise of eight replicates"}, {"edge", .04, "a reason"}};
    if (verdict == Verdict::undecided) r.replicates_to_decide = 24;
    return r;
}

/// A PNG's head is all that the page reads of it.
std::string png_of(int width, int height) {
    std::string png("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16);
    for (const int side : {width, height})
        for (const int shift : {24, 16, 8, 0}) png += static_cast<char>(side >> shift & 255);
    return png + "the rest";
}

RunResult example() {
    RunResult r;
    r.threefold_version = "0.1.0";
    r.started = "2025-03-02T09:14:07Z";
    r.command = "threefold check wall";
    r.preset = "published";
    r.assignments = {{"orb.wall_mm", "2.6"}};
    r.versions = {{"POV-Ray", "3.7.0.10"}};
    r.witnesses = {{"tracer", "Threefold tracer", "0.1.0", "", true, true, "", 1.5, ""},
                   {"povray", "POV-Ray", "3.7.0.10", "/usr/bin/povray", true, true, "", 90, ""},
                   {"cycles", "Blender Cycles", "", "", false, std::nullopt, "Blender is not installed", 0, ""}};
    r.seconds = 100;
    r.renderer_seconds = 91.5;
    r.tracer_seconds = 1.5;
    r.verdict = Verdict::fails;
    r.summary = "One number is outside its tolerance.";
    ClaimResult c;
    c.name = "wall";
    c.statement = "The ring is as wide as the wall.";
    c.verdict = Verdict::fails;
    c.blamed = {"povray"};
    c.notes = {"It flips at 1.21."};
    c.experiments = {{"hollow", "Hollow orb", "orb", {{"orb.wall_mm", "2.6"}}, "c0ffee"}};
    c.rows = {row("ring", "tracer", "", Verdict::holds), row("ring", "povray", "", Verdict::fails),
              row("ring", "povray", "tracer", Verdict::undecided)};
    c.tiles = {
        {"hollow", "povray", "tracer", 8, 20, 10, .5, .005, {}, -.004, 3, 5, 199, 0, 1, 1, Verdict::undecided, 41}};
    c.pictures = {{ReportPicture::Kind::render, "hollow", "POV-Ray", "\x89PNG\r\n\x1a\nnot a whole picture"}};
    r.claims = {c};
    RenderRecord render;
    render.experiment = "hollow";
    render.witness = "povray";
    render.folder = "renders/hollow/povray";
    render.command = "povray scene.ini";
    render.missing_weight_mean = 2e-7;
    r.renders = {render};
    return r;
}

RunResult hostile_result() {
    RunResult r = example();
    for (std::string *text : {&r.threefold_version, &r.started, &r.command, &r.preset, &r.summary}) *text = hostile;
    r.assignments = {{hostile, hostile}};
    r.versions = {{hostile, hostile}};
    for (WitnessRecord &w : r.witnesses)
        for (std::string *text : {&w.name, &w.title, &w.version, &w.program, &w.problem, &w.injected_fault})
            *text = hostile;
    for (ClaimResult &c : r.claims) {
        c.name = c.statement = c.summary = hostile;
        c.notes = c.blamed = {hostile};
        for (ExperimentRecord &e : c.experiments) {
            e.name = e.title = e.scene = e.scene_hash = hostile;
            e.parameters = {{hostile, hostile}};
        }
        for (Row &x : c.rows) {
            x.experiment = x.quantity = x.unit = x.witness = x.versus = hostile;
            x.budget = {{hostile, .1, hostile}};
        }
        for (TileComparison &t : c.tiles) {
            t.experiment = t.witness = t.versus = hostile;
            t.budget = {{hostile, .1, hostile}};
        }
        for (ReportPicture &p : c.pictures) p.experiment = p.title = hostile;
        c.preset = hostile;
        c.flips = {{hostile, hostile, 1, 2, hostile, {hostile}}};
        c.pictures[0].png = png_of(8, 8);
        c.pictures[0].marks = {{Mark::Kind::line, {1, 1}, {2, 2}, 0, Mark::Meaning::measured, hostile}};
    }
    r.claims.push_back(r.claims.front()); // the same claim under another preset
    r.claims.back().preset += hostile;
    for (RenderRecord &x : r.renders) x.experiment = x.witness = x.folder = x.command = x.scene_hash = hostile;
    return r;
}

/// The example as a run under both presets: a conclusion that flips, with renders beside it and marks on its picture.
RunResult example_under_both() {
    RunResult r = example();
    r.preset = "both";
    r.verdict = Verdict::holds;
    ClaimResult &text = r.claims[0];
    text.preset = "text";
    text.verdict = Verdict::holds;
    text.blamed.clear();
    text.tiles.clear();
    text.rows = {row("ring", "tracer", "", Verdict::holds)};
    text.flips = {{"glass.index", "", 1.2103, 1.51714, "it inverts only above it", {"below", "above"}}};
    for (const auto &[name, index] : {std::pair{"below", "1.20062"}, {"above", "1.21998"}}) {
        text.experiments.push_back({name, "beside it", "solid", {{"glass.index", index}}, "f00d"});
        text.rows.push_back(row("slope", "tracer", "", Verdict::holds));
        text.rows.back().experiment = name;
    }
    text.pictures[0].png = png_of(32, 16);
    text.pictures[0].marks = {
        {Mark::Kind::line, {2, 3}, {30, 4.25}, 0, Mark::Meaning::measured, "upper line"},
        {Mark::Kind::arrow, {16, 8}, {20, 8}, 0, Mark::Meaning::measured, ""},
        {Mark::Kind::circle, {16, 8}, {}, 7, Mark::Meaning::expected, "inner rim"},
        {Mark::Kind::cross, {nan, 8}, {}, 0, Mark::Meaning::expected, "nowhere"},
    };
    ClaimResult published = text;
    published.preset = "published";
    published.flips[0].value = 1.1663;
    r.claims.push_back(published);
    return r;
}

std::size_t occurrences(const std::string &text, const std::string &part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

void collect_keys(const nlohmann::ordered_json &value, std::set<std::string> &keys) {
    if (value.is_object())
        for (const auto &[key, child] : value.items()) {
            if (key != "assignments" && key != "parameters") collect_keys(child, keys);
            keys.insert(key);
        }
    if (value.is_array())
        for (const auto &child : value) collect_keys(child, keys);
}

pugi::xml_document parse(const std::string &xml) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_string(xml.c_str());
    EXPECT_TRUE(parsed) << parsed.description();
    return document;
}

// ---------------------------------------------------------------------------------------------------------------------
// JSON

TEST(ResultJson, survives_a_round_trip_through_text) {
    const auto json = to_json(example());
    EXPECT_EQ(nlohmann::ordered_json::parse(json.dump()), json);
    EXPECT_EQ(json.begin().key(), "schema_version");
    EXPECT_EQ(json.at("schema_version"), RunResult::schema_version);
    const auto &first = json.at("claims").at(0).at("rows").at(0);
    EXPECT_EQ(first.at("measured").at("mean"), 1.25);
    EXPECT_EQ(first.at("interval").at("high"), 1.2689);
    EXPECT_TRUE(first.at("versus").is_null());
    EXPECT_EQ(first.at("budget").at(1).at("name"), "edge");
    EXPECT_EQ(json.at("claims").at(0).at("rows").at(2).at("replicates_to_decide"), 24);
}

TEST(ResultJson, tells_the_overhead) {
    const auto timing = to_json(example()).at("timing");
    EXPECT_DOUBLE_EQ(timing.at("overhead_seconds"), 8.5);
    EXPECT_DOUBLE_EQ(timing.at("overhead_share"), .085);
    EXPECT_TRUE(to_json(RunResult{}).at("timing").at("overhead_share").is_null());
}

TEST(ResultJson, writes_numbers_that_are_not_finite_as_null) {
    RunResult r = example();
    r.claims[0].rows[0].measured = {nan, infinity, infinity, 1};
    const auto measured = to_json(r).at("claims").at(0).at("rows").at(0).at("measured");
    EXPECT_TRUE(measured.at("mean").is_null());
    EXPECT_TRUE(measured.at("standard_error").is_null());
    EXPECT_TRUE(measured.at("degrees_of_freedom").is_null());
}

TEST(ResultJson, can_be_dumped_whatever_bytes_names_hold) { EXPECT_NO_THROW(to_json(hostile_result()).dump()); }

TEST(ResultJson, has_every_key_in_its_documentation) {
    std::ifstream file(THREEFOLD_SOURCE_DIR "/docs/RESULT_SCHEMA.md");
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    std::set<std::string> keys;
    collect_keys(to_json(example_under_both()), keys);
    collect_keys(to_json(example()), keys);
    for (const std::string &key : keys)
        EXPECT_TRUE(std::regex_search(page, std::regex("\\b" + key + "\\b"))) << key << " is not documented";
}

// ---------------------------------------------------------------------------------------------------------------------
// JUnit

TEST(Junit, has_a_suite_a_claim_and_a_case_a_row_and_tile_comparison) {
    const auto document = parse(to_junit(example()));
    const auto suite = document.child("testsuites").find_child_by_attribute("name", "wall");
    EXPECT_EQ(suite.attribute("tests").as_int(), 4);
    EXPECT_EQ(suite.attribute("failures").as_int(), 1);
    EXPECT_EQ(suite.attribute("skipped").as_int(), 2);
    EXPECT_EQ(document.select_nodes("//testsuite[@name='wall']/testcase").size(), 4u);
    EXPECT_EQ(document.select_nodes("//failure").size(), 1u);
    EXPECT_THAT(document.select_node("//failure").node().attribute("message").value(), HasSubstr("within 0.1 mm"));
    EXPECT_EQ(document.child("testsuites").attribute("tests").as_int(), 7);
}

TEST(Junit, skips_a_missing_renderer_by_name) {
    const auto document = parse(to_junit(example()));
    const auto test = document.select_node("//testsuite[@name='renderers']/testcase[@name='Blender Cycles']").node();
    EXPECT_STREQ(test.child("skipped").attribute("message").value(), "missing: Blender is not installed");
}

TEST(Junit, shows_a_verdict_that_its_rows_do_not_explain) {
    RunResult r = example();
    r.claims[0].rows.clear();
    r.claims[0].tiles.clear();
    r.claims[0].verdict = Verdict::undecided;
    EXPECT_EQ(parse(to_junit(r)).select_nodes("//testsuite[@name='wall']/testcase/skipped").size(), 1u);
}

TEST(Junit, is_well_formed_whatever_names_hold) {
    const std::string xml = to_junit(hostile_result());
    EXPECT_EQ(parse(xml).select_nodes("//script").size(), 0u);
    EXPECT_THAT(xml, Not(HasSubstr("\x1b")));
    EXPECT_THAT(xml, Not(HasSubstr("&#27;")));
}

TEST(Junit, names_the_suites_of_both_presets_apart) {
    const auto document = parse(to_junit(example_under_both()));
    EXPECT_EQ(document.select_nodes("//testsuite[@name='wall.text']").size(), 1u);
    EXPECT_EQ(document.select_nodes("//testsuite[@name='wall.published']").size(), 1u);
    EXPECT_EQ(document.select_nodes("//testcase[@classname='threefold.wall.published.tracer']").size(), 3u);
}

// ---------------------------------------------------------------------------------------------------------------------
// Terminal

TEST(Terminal, says_the_verdict_in_words_and_shows_rows_that_do_not_hold) {
    const std::string text = to_text(example(), false, 0);
    EXPECT_TRUE(text.starts_with("✗ The claim fails.\n")) << text;
    EXPECT_THAT(text, HasSubstr("measured 1.250 mm (92 % interval 1.231 to 1.269), expected 1.2 within 0.1 mm"));
    EXPECT_THAT(text, HasSubstr("24 replicates would decide"));
    EXPECT_THAT(text, HasSubstr("Blender Cycles, missing: Blender is not installed"));
    EXPECT_EQ(occurrences(text, "measured"), 2u);
    EXPECT_EQ(occurrences(to_text(example(), false, 1), "measured"), 3u);
    EXPECT_EQ(occurrences(to_text(example(), false, -1), "measured"), 0u);
}

TEST(Terminal, tells_a_claim_under_both_presets_once) {
    RunResult r = example_under_both();
    std::string text = to_text(r, false, 0);
    EXPECT_TRUE(text.starts_with("✓ The claim holds under both presets.\n")) << text;
    EXPECT_EQ(occurrences(text, "The ring is as wide as the wall."), 1u);
    EXPECT_THAT(text, HasSubstr("✓ holds     under published: Threefold tracer holds"));
    r.claims[1].verdict = r.verdict = Verdict::fails;
    text = to_text(r, false, -1);
    EXPECT_TRUE(text.starts_with("✗ The claim fails under published.\n")) << text;
    EXPECT_THAT(text, HasSubstr("✗ fails     under published\n"));
    r.claims.push_back(r.claims[0]);
    r.claims.back().name = "palm";
    EXPECT_THAT(to_text(r, false, 0), HasSubstr("1 of 2 claims fails under published."));
    r.claims[0].verdict = Verdict::fails;
    EXPECT_THAT(to_text(r, false, 0), HasSubstr("1 of 2 claims fails under both presets."));
}

TEST(Terminal, tells_where_a_conclusion_flips) {
    EXPECT_THAT(
        to_text(example_under_both(), false, 0),
        HasSubstr("flips at glass.index = 1.2103 (here 1.51714, 25 % above it), bracketed by renders: holds\n"));
    const std::string all = to_text(example_under_both(), false, 1);
    EXPECT_THAT(all, HasSubstr("bracketed by renders at 1.2006 and 1.2200: holds"));
    EXPECT_THAT(all, HasSubstr("it inverts only above it"));
}

TEST(Terminal, has_no_escape_codes_without_colour_whatever_names_hold) {
    EXPECT_THAT(to_text(hostile_result(), false, 1), Not(HasSubstr("\x1b")));
    EXPECT_THAT(to_text(hostile_result(), true, 1), HasSubstr("\x1b["));
}

TEST(Terminal, differs_only_by_escape_codes_with_colour) {
    const std::string painted = to_text(example(), true, 1);
    EXPECT_EQ(std::regex_replace(painted, std::regex("\x1b\\[[0-9;]*m"), ""), to_text(example(), false, 1));
}

TEST(Terminal, does_not_praise_a_run_that_is_not_complete) {
    RunResult r = example();
    r.claims[0].verdict = Verdict::holds;
    r.verdict = Verdict::undecided;
    EXPECT_THAT(to_text(r, false, 0), HasSubstr("but not everything was tested"));
    EXPECT_THAT(to_text(RunResult{}, false, 0), HasSubstr("Nothing was checked"));
}

// ---------------------------------------------------------------------------------------------------------------------
// HTML

TEST(Html, holds_every_row_and_tile_comparison) {
    const std::string page = to_html(example());
    EXPECT_EQ(occurrences(page, "<svg class=\"interval"), 3u);
    EXPECT_EQ(occurrences(page, "<tbody class=\"row "), 4u);
    for (const char *part : {"POV-Ray minus Threefold tracer", "1.231 to 1.269", "24 replicates would decide",
                             "41 replicates would decide", "noise of eight replicates", "The claim fails.",
                             "Blender is not installed", "povray scene.ini", "8.5 %", "It flips at 1.21.", "c0ffee"})
        EXPECT_THAT(page, HasSubstr(part));
}

TEST(Html, loads_nothing_from_elsewhere) {
    const std::string page = to_html(example());
    for (const char *part : {"http:", "https:", "<link", "@import", "<iframe", "src=\"/"})
        EXPECT_THAT(page, Not(HasSubstr(part)));
    EXPECT_EQ(occurrences(page, "src=\""), occurrences(page, "src=\"data:image/png;base64,"));
    EXPECT_EQ(occurrences(page, "url("), 0u);
    EXPECT_THAT(page, HasSubstr("default-src 'none'"));
}

TEST(Html, escapes_whatever_names_hold) {
    const std::string page = to_html(hostile_result());
    EXPECT_EQ(occurrences(page, "<script"), 1u);
    EXPECT_EQ(occurrences(page, "</script"), 1u);
    EXPECT_EQ(occurrences(page, "alert(\""), 0u);
    EXPECT_EQ(page.find('\x1b'), std::string::npos);
    EXPECT_EQ(page, report::valid_utf8(page));
}

TEST(Html, puts_both_presets_of_a_claim_into_one_article) {
    const std::string page = to_html(example_under_both());
    EXPECT_EQ(occurrences(page, "<article"), 1u);
    for (const char *part : {"The claim holds under both presets.", "id=\"claim-wall-text\"",
                             "href=\"#claim-wall-text\"", "id=\"claim-wall-published\"", ">Under published</th>"})
        EXPECT_EQ(occurrences(page, part), 1u + (std::string(part).starts_with("href") ? 1 : 0)) << part;
    std::set<std::string> ids;
    const std::regex id(" id=\"([^\"]*)\"");
    for (std::sregex_iterator at(page.begin(), page.end(), id), end; at != end; ++at)
        EXPECT_TRUE(ids.insert((*at)[1]).second) << (*at)[1] << " is there twice";
}

TEST(Html, tells_where_a_conclusion_flips_in_its_claim_and_in_one_table) {
    const std::string page = to_html(example_under_both());
    EXPECT_EQ(occurrences(page, "1.2103"), 2u);
    EXPECT_EQ(occurrences(page, "1.1663"), 2u);
    EXPECT_THAT(page, HasSubstr("Where each conclusion flips"));
    EXPECT_THAT(page, HasSubstr("at 1.2006 and 1.2200"));
    EXPECT_THAT(to_html(example()), Not(HasSubstr("Where each conclusion flips")));
}

TEST(Html, draws_marks_over_their_picture_in_its_pixels) {
    const std::string page = to_html(example_under_both());
    EXPECT_EQ(occurrences(page, "<svg viewBox=\"0 0 32 16\""), 2u);
    for (const char *part : {"M2 3L30 4.25", "M9 8a7 7 0 1 0 14 0a7 7 0 1 0 -14 0", "2 marks measured, 1 mark expected",
                             "measured: upper line. expected: inner rim.", "measured: read from the picture"})
        EXPECT_THAT(page, HasSubstr(part));
    EXPECT_THAT(page, Not(HasSubstr("nowhere")));
    EXPECT_EQ(occurrences(to_html(example()), "class=\"marks\""), 0u);
}

TEST(Html, folds_away_what_holds_in_a_run_of_many_claims) {
    RunResult r = example_under_both();
    EXPECT_EQ(occurrences(to_html(r), "<details class=\"fold"), 0u);
    for (const char *name : {"palm", "tint", "shift"})
        for (int part : {0, 1}) {
            r.claims.push_back(r.claims[static_cast<std::size_t>(part)]);
            r.claims.back().name = name;
        }
    std::string page = to_html(r);
    EXPECT_EQ(occurrences(page, "<details class=\"fold"), 16u);
    EXPECT_EQ(occurrences(page, "<details class=\"fold\" open"), 0u) << "the numbers of what holds";
    EXPECT_EQ(occurrences(page, "Hollow orb\" open>"), 4u) << "the marked picture of each claim, once";
    r.claims[1].verdict = r.claims[1].rows[0].verdict = Verdict::fails;
    page = to_html(r);
    EXPECT_EQ(occurrences(page, "<details class=\"fold\" open"), 1u);
    EXPECT_EQ(occurrences(page, "Hollow orb\" open>"), 5u);
}

TEST(Html, leaves_out_what_is_empty) {
    const std::string page = to_html(RunResult{});
    for (const char *part : {"<table", "<dialog", "<img", "<article", "<ul", "<h3"})
        EXPECT_THAT(page, Not(HasSubstr(part)));
    EXPECT_THAT(page, HasSubstr("Nothing was checked"));
}

TEST(Html, draws_an_interval_without_a_number) {
    RunResult r = example();
    r.claims[0].rows[0].measured = {nan, infinity, 1, 0};
    r.claims[0].rows[0].interval = {nan, nan};
    r.claims[0].rows[1].interval = {-infinity, infinity};
    r.claims[0].rows[2].tolerance = 0;
    const std::string page = to_html(r);
    EXPECT_FALSE(std::regex_search(page, std::regex("(x|d|width)=\"[^\"]*(nan|inf)")));
    EXPECT_THAT(page, HasSubstr("not a number"));
}

TEST(Report, is_the_same_for_the_same_result) {
    EXPECT_EQ(to_html(example()), to_html(example()));
    EXPECT_EQ(to_json(example()).dump(), to_json(example()).dump());
    EXPECT_EQ(to_junit(example()), to_junit(example()));
    EXPECT_EQ(to_text(example(), true, 1), to_text(example(), true, 1));
}

// ---------------------------------------------------------------------------------------------------------------------
// Text and numbers

TEST(ReportText, replaces_bytes_that_are_no_text) {
    EXPECT_EQ(report::valid_utf8("a\xff"
                                 "b"),
              "a\uFFFD"
              "b");
    EXPECT_EQ(report::valid_utf8("\xc0\xaf"), "\uFFFD\uFFFD");
    EXPECT_EQ(report::valid_utf8("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD");
    EXPECT_EQ(report::valid_utf8("µ × 𝛼 日"), "µ × 𝛼 日");
    EXPECT_EQ(report::valid_utf8("\xe2\x82"), "\uFFFD\uFFFD");
    EXPECT_EQ(report::printable(std::string_view("a\0b\x1b\n\xc2\x9b", 7)), "a\uFFFD"
                                                                            "b\uFFFD\n\uFFFD");
    EXPECT_EQ(report::html_text("<a href='x'>&\""), "&lt;a href=&#39;x&#39;&gt;&amp;&quot;");
}

TEST(ReportNumbers, have_the_digits_that_matter) {
    using namespace report;
    EXPECT_EQ(number(0.004), "0.004");
    EXPECT_EQ(number(1.0 / 3), "0.333");
    EXPECT_EQ(number(1.23e-5), "1.23e-5");
    EXPECT_EQ(number(1200), "1200");
    EXPECT_EQ(number(nan), "not a number");
    EXPECT_EQ(number(-infinity), "-infinite");
    EXPECT_EQ(number_at(1.04023, .002), "1.0402");
    EXPECT_EQ(number_at(-0.00001, .002), "0");
    EXPECT_EQ(number_at(-4e-5, 4e-4), "-0.00004");
    EXPECT_EQ(number_at(123456.7, 300), "123457");
    EXPECT_EQ(bound_at(2.72, .002), "2.72");
    EXPECT_EQ(bound_at(100, 30), "100");
    EXPECT_EQ(percent(.0243), "2.4 %");
    EXPECT_EQ(duration(.4242), "0.42 s");
    EXPECT_EQ(duration(523.4), "8 min 43 s");
    EXPECT_EQ(duration(4320), "1 h 12 min");
    EXPECT_EQ(count(1, "tile"), "1 tile");
    EXPECT_EQ(count(1024, "tile"), "1,024 tiles");
    EXPECT_EQ(typeset("-1.2e-5 to 3"), "−1.2×10⁻⁵ to 3");
}

} // namespace
} // namespace threefold
