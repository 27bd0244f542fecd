// SPDX-License-Identifier: MIT
// The closed forms as a calculator: against an independent table, and as a user meets it.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "scenes/error.h"
#include "tools/command_optics.h"
#include "verifier/optics/concentric.h"
#include "verifier/optics/quad.h"

namespace threefold::optics {
namespace {

using Json = nlohmann::ordered_json;

const std::string oracle_file = THREEFOLD_SOURCE_DIR "/tests/optics_oracle.json";
const std::vector<std::string> answers{"deflection_rad", "transmittance_unpolarised", "transmittance_polarised",
                                       "landing_mm"};

Json read_oracle() { return Json::parse(std::ifstream(oracle_file)); }

Json answer_rows(const std::string &file, const std::string &precision) {
    OpticsQuery query;
    query.rows_file = file;
    query.precision = precision;
    std::ostringstream out;
    EXPECT_EQ(run_optics(query, out), 0);
    return Json::parse(out.str());
}

double relative_error(const Json &answer, const Json &truth) {
    const Quad value(answer.get<std::string>()), reference(truth.get<std::string>());
    return static_cast<double>(abs(value - reference) / (reference == 0 ? Quad(1) : abs(reference)));
}

std::vector<double> oracle_errors(const std::string &precision) {
    const Json oracle = read_oracle(), answered = answer_rows(oracle_file, precision);
    EXPECT_EQ(answered["rows"].size(), oracle["rows"].size());
    std::vector<double> errors;
    for (std::size_t i = 0; i < oracle["rows"].size(); ++i)
        for (const std::string &key : answers) {
            const Json &truth = oracle["rows"][i][key], &answer = answered["rows"][i][key];
            EXPECT_EQ(truth.is_null(), answer.is_null()) << "row " << i + 1 << ", " << key;
            if (!truth.is_null()) errors.push_back(relative_error(answer, truth));
        }
    return errors;
}

// ---------------------------------------------------------------------------------------------------------------------
// The independent table

TEST(optics_oracle, quad_agrees_with_every_row_to_1e_18) {
    const std::vector<double> errors = oracle_errors("quad");
    EXPECT_LT(*std::max_element(errors.begin(), errors.end()), 1e-18);
}

TEST(optics_oracle, double_agrees_to_1e_14_in_the_median_and_1e_10_in_every_row) {
    std::vector<double> errors = oracle_errors("double");
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() / 2], 1e-14);
    EXPECT_LT(errors.back(), 1e-10); // the rest is the rounding of n - 1 and of eye angle against deflection
}

TEST(optics_oracle, rows_are_echoed_as_given_with_the_same_keys_in_the_same_order) {
    const Json oracle = read_oracle(), answered = answer_rows(oracle_file, "quad");
    for (std::size_t i = 0; i < oracle["rows"].size(); ++i) {
        std::vector<std::string> given, got;
        for (const auto &[key, value] : oracle["rows"][i].items()) given.push_back(key);
        for (const auto &[key, value] : answered["rows"][i].items()) got.push_back(key);
        ASSERT_EQ(given, got);
        for (const char *key : {"R_mm", "r_mm", "n", "b_mm", "eye_mm", "plane_mm"})
            ASSERT_EQ(oracle["rows"][i][key], answered["rows"][i][key]);
    }
}

TEST(optics_oracle, double_given_the_gaps_is_as_good_as_its_format_for_nanometre_walls_and_grazing_rays) {
    for (const char *wall : {"1e-6", "1e-5", "1e-3", "1.36"})
        for (const char *gap : {"1e-7", "1e-4", "1", "40"})
            for (const char *index : {"1.0078125", "1.5", "2.375"}) { // exact in double
                const Orb<Quad> orb = shell(Quad("67.98"), Quad(wall), Quad(index));
                const Impact<Quad> impact{orb.inner_mm - Quad(gap), orb.wall_mm + Quad(gap), Quad(gap)};
                const auto coarse = rounded<double>(orb);
                const auto coarse_impact = rounded<double>(impact);
                const auto error = [](double value, const Quad &truth) {
                    return std::abs(static_cast<double>(Quad(value) / truth - 1));
                };
                EXPECT_LT(error(*deflection(coarse, coarse_impact), *deflection(orb, impact)), 4e-15);
                const auto light = *path_transmittance(orb, impact);
                const auto coarse_light = *path_transmittance(coarse, coarse_impact);
                EXPECT_LT(error(coarse_light.unpolarised, light.unpolarised), 1e-14);
                EXPECT_LT(error(coarse_light.polarised, light.polarised), 1e-14);
            }
}

// ---------------------------------------------------------------------------------------------------------------------
// The calculator

class optics_command : public testing::Test {
protected:
    std::string run() {
        std::ostringstream out;
        run_optics(query, out);
        return out.str();
    }
    /// "code: message" of the error that the query makes.
    std::string error() {
        try {
            run();
        } catch (const Error &error) {
            return std::to_string(static_cast<int>(error.code())) + ": " + error.what();
        }
        return "no error";
    }
    void rows(const std::string &json) {
        const std::string file = testing::TempDir() + "optics_rows.json";
        std::ofstream(file) << json;
        query.rows_file = file;
    }

    OpticsQuery query;
};

TEST_F(optics_command, prints_a_table_with_the_study_s_figures) {
    query.impact_mm = "60";
    EXPECT_THAT(run(), testing::AllOf(testing::HasSubstr("0.6779"), testing::HasSubstr("0.6274"),
                                      testing::HasSubstr("1.04003060492"), testing::HasSubstr("1.21032813341")));
}

TEST_F(optics_command, says_that_a_ray_in_the_rim_is_totally_reflected) {
    query.impact_mm = "67";
    EXPECT_THAT(run(), testing::HasSubstr("totally reflected at the inner wall"));
    query.json = "-";
    const Json answer = Json::parse(run());
    EXPECT_TRUE(answer["deflection_rad"].is_null());
    EXPECT_FALSE(answer["rim_deflection_rad"].is_null());
}

TEST_F(optics_command, writes_json_to_a_file_and_nothing_to_out) {
    query.json = testing::TempDir() + "optics_answer.json";
    query.solid = true;
    EXPECT_EQ(run(), "");
    const Json answer = Json::parse(std::ifstream(*query.json));
    EXPECT_EQ(answer["image_magnification"].get<std::string>().substr(0, 6), "-1.040");
}

TEST_F(optics_command, keeps_unknown_keys_and_takes_json_numbers) {
    rows(R"({"by": "me", "rows": [{"R_mm": 68, "r_mm": 0.0, "n": 1.5, "b_mm": 30, "eye_mm": 900, "plane_mm": 250,
              "seen": true}]})");
    const Json answer = Json::parse(run());
    EXPECT_EQ(answer["by"], "me");
    EXPECT_EQ(answer["rows"][0]["seen"], true);
    EXPECT_EQ(answer["rows"][0]["R_mm"], 68);
    EXPECT_EQ(
        Quad(answer["rows"][0]["deflection_rad"].get<std::string>()).str(25),
        deflection(solid_ball(Quad(68), Quad("1.5")), impact_at(solid_ball(Quad(68), Quad("1.5")), Quad(30)))->str(25));
}

TEST_F(optics_command, answers_null_where_no_ray_passes) {
    rows(R"({"rows": [{"R_mm": 68, "r_mm": 66, "n": 1.5, "b_mm": 67, "eye_mm": 900, "plane_mm": 250}]})");
    const Json answer = Json::parse(run());
    for (const std::string &key : answers) EXPECT_TRUE(answer["rows"][0][key].is_null()) << key;
}

TEST_F(optics_command, names_the_flag_that_makes_no_sense) {
    struct Case {
        std::string OpticsQuery::*flag;
        const char *value, *message;
    };
    for (const Case &bad : {Case{&OpticsQuery::outer_mm, "nan", "65: --outer-mm: \"nan\" is not a number"},
                            Case{&OpticsQuery::outer_mm, "0", "65: --outer-mm: must be greater than 0"},
                            Case{&OpticsQuery::outer_mm, "1e9999", "65: --outer-mm: "},
                            Case{&OpticsQuery::wall_mm, "-1", "65: --wall-mm: -1 is negative"},
                            Case{&OpticsQuery::wall_mm, "68", "65: --wall-mm: 68 is not less than the outer radius 68"},
                            Case{&OpticsQuery::index, "0.99", "65: --index: 0.99 is below 1"},
                            Case{&OpticsQuery::index, "1,5", "65: --index: \"1,5\" is not a number"},
                            Case{&OpticsQuery::impact_mm, "68.1", "65: --impact-mm: 68.1 is larger"},
                            Case{&OpticsQuery::impact_mm, "", "65: --impact-mm: \"\" is not a number"},
                            Case{&OpticsQuery::eye_mm, "68", "65: --eye-mm: 68 is not outside the orb"},
                            Case{&OpticsQuery::plane_mm, "0x10", "65: --plane-mm: \"0x10\" is not a number"},
                            Case{&OpticsQuery::precision, "half", "64: precision \"half\" is unknown"}}) {
        query = {};
        query.*bad.flag = bad.value;
        EXPECT_THAT(error(), testing::StartsWith(bad.message));
    }
}

TEST_F(optics_command, names_the_row_and_the_key_that_make_no_sense) {
    const std::string good = R"({"R_mm": 68, "r_mm": 66, "n": 1.5, "b_mm": 6, "eye_mm": 900, "plane_mm": 250})";
    const auto second = [&](const std::string &key, const std::string &value) {
        Json row = Json::parse(good);
        if (value.empty())
            row.erase(key);
        else
            row[key] = Json::parse(value);
        rows("{\"rows\": [" + good + ", " + row.dump() + "]}");
        return error();
    };
    EXPECT_THAT(second("n", ""), testing::EndsWith("row 2, n: is missing"));
    EXPECT_THAT(second("n", "\"nan\""), testing::EndsWith("row 2, n: \"nan\" is not a number"));
    EXPECT_THAT(second("n", "null"), testing::EndsWith("row 2, n: must be a number or a decimal string"));
    EXPECT_THAT(second("b_mm", "-1"), testing::EndsWith("row 2, b_mm: -1 is negative"));
    EXPECT_THAT(second("b_mm", "69"), testing::HasSubstr("row 2, b_mm: 69 is larger than the outer radius 68"));
    EXPECT_THAT(second("r_mm", "69"), testing::HasSubstr("row 2, r_mm: 69 is larger than the outer radius 68"));
    EXPECT_THAT(second("eye_mm", "\"60\""), testing::HasSubstr("row 2, eye_mm: 60 is not outside the orb"));
}

TEST_F(optics_command, tells_an_unreadable_file_from_one_that_is_not_in_the_form) {
    query.rows_file = testing::TempDir() + "no/such/file.json";
    EXPECT_THAT(error(), testing::StartsWith("74: cannot read"));
    rows("{\"rows\": [");
    EXPECT_THAT(error(), testing::AllOf(testing::StartsWith("65: "), testing::HasSubstr("is not JSON: parse error")));
    rows("[]");
    EXPECT_THAT(error(), testing::EndsWith("has no list \"rows\""));
    rows(R"({"units": "cm", "rows": []})");
    EXPECT_THAT(error(), testing::EndsWith("units must be \"mm, rad\""));
    rows(std::string(5000, '[') + std::string(5000, ']'));
    EXPECT_THAT(error(), testing::EndsWith("nested more than 100 deep"));
}

} // namespace
} // namespace threefold::optics
