// SPDX-License-Identifier: MIT
// A stranger's scene as a claim, with our tracer as both renderers.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exporter/files.h"
#include "exporter/mitsuba/read_mitsuba.h"
#include "scenes/error.h"
#include "tests/lit_orb_file.h"
#include "tests/quick_request.h"
#include "tests/temporary_folder.h"
#include "verifier/check/check.h"
#include "verifier/claims/unshadowed.h"

namespace threefold {
namespace {

using testing::Contains;
using testing::HasSubstr;

class Picture : public testing::Test {
protected:
    Claim claim_of(const std::string &xml) {
        write_file_atomically(folder / "lit-orb.xml", xml);
        return claim_picture(mitsuba_scene(folder / "lit-orb.xml"));
    }

    CheckRequest two_tracers(const std::string &xml) {
        auto request = quick_request<CheckRequest>(folder / "run", {"calibration"});
        request.claims.push_back(claim_of(xml));
        request.witnesses.push_back(request.witnesses.front());
        request.witnesses.back().name = "second";
        return request;
    }

    Experiment experiment_of(const std::string &xml, std::vector<Assignment> assignments = {}) {
        return claim_of(xml).experiments({no_scenes, Preset::text, std::move(assignments), true}).front();
    }

    static std::string with(std::string xml, const std::string &old, const std::string &other) {
        EXPECT_NE(xml.find(old), std::string::npos) << old;
        return xml.replace(xml.find(old), old.size(), other);
    }

    const tests::TemporaryFolder folder;
    const std::vector<SceneRecipe> no_scenes;
};

TEST_F(Picture, IsTheSameInTwoRenderersOrAFaultInOneIsFound) {
    CheckRequest request = two_tracers(tests::lit_orb_xml);
    const CheckOutcome honest = check(request);
    EXPECT_EQ(honest.exit, Exit::holds) << honest.result.summary;
    const ClaimResult &claim = honest.result.claims.back();
    EXPECT_EQ(claim.name, "picture");
    EXPECT_EQ(claim.statement, "lit-orb is the same picture in every renderer.");
    ASSERT_EQ(claim.tiles.size(), 1u);
    EXPECT_EQ(claim.tiles.front().columns * claim.tiles.front().rows, 6 * 4);
    EXPECT_DOUBLE_EQ(claim.tiles.front().tolerance,
                     0.024 * unshadowed_mean_radiance(experiment_of(tests::lit_orb_xml).scene));
    EXPECT_EQ(claim.experiments.front().scene, "lit-orb");
    EXPECT_EQ(claim.experiments.front().parameters.at("glass.shadow"), "opaque");

    request.injected["second"] = claim_picture({}).mutant;
    request.claims.erase(request.claims.begin()); // who fails its calibration has no vote
    EXPECT_EQ(check(request).exit, Exit::fails);
}

TEST_F(Picture, HasTheFilesSizeUnlessThatIsLargerThanItNeedsToBe) {
    const auto size = [](const Experiment &e) {
        return std::pair(e.scene.camera.image_width_px(), e.scene.camera.image_height_px());
    };
    const std::string large = with(tests::lit_orb_xml, "\"width\" value=\"96\"", "\"width\" value=\"960\"");
    EXPECT_EQ(size(experiment_of(tests::lit_orb_xml)), std::pair(96, 64));
    EXPECT_EQ(size(experiment_of(large)), std::pair(128, 9));
    EXPECT_EQ(size(experiment_of(large, {{"image.width_px", "300"}})), std::pair(300, 20));
}

TEST_F(Picture, OfAFloorThatReachesBehindTheEyeHasItsLightInTheTolerance) {
    const Experiment e = experiment_of(tests::lit_orb_xml);
    Scene without = e.scene;
    std::erase_if(without.objects, [](const Object &object) { return object.name == "floor"; });
    Scene cut = e.scene; // the same floor, ending before the eye
    for (Object &object : cut.objects)
        if (object.name == "floor") {
            Quad &floor = std::get<Quad>(object.shape);
            floor.centre_mm = {-600, floor.centre_mm.y, 0};
            floor.half_u_mm = {1400, 0, 0};
            floor.half_v_mm = {0, 0, -2000};
        }
    EXPECT_NEAR(unshadowed_mean_radiance(e.scene), unshadowed_mean_radiance(cut), 1e-12);
    EXPECT_GT(std::abs(unshadowed_mean_radiance(e.scene) - unshadowed_mean_radiance(without)), 1e-3);
}

TEST_F(Picture, WithoutGlassSaysThatItTeachesNothingOfGlass) {
    std::string bare = tests::lit_orb_xml;
    const std::size_t from = bare.find("<shape type=\"sphere\" id=\"outside\">");
    bare.erase(from, bare.find("<shape type=\"rectangle\" id=\"wall\">") - from);
    const Claim claim = claim_of(bare);
    const ClaimContext context{no_scenes, Preset::text, {}, true};
    EXPECT_THAT(claim.notes(context), Contains(HasSubstr("holds no glass")));
    EXPECT_TRUE(claim.scope(context, {}).empty());
    EXPECT_EQ(claim_of(tests::lit_orb_xml).scope(context, {}).size(), 1u);
}

TEST_F(Picture, OfDarknessIsRefused) {
    const std::string dark =
        with(with(tests::lit_orb_xml, "name=\"radiance\" value=\"0.6\"", "name=\"radiance\" value=\"0\""),
             "x=\"-1\" y=\"-1.5\" z=\"0.7\"", "x=\"1\" y=\"1.5\" z=\"0.7\""); // on their backs
    try {
        experiment_of(dark);
        FAIL() << "it has no tolerance";
    } catch (const Error &error) {
        EXPECT_EQ(error.code(), Exit::bad_data);
        EXPECT_THAT(error.what(), HasSubstr("lit-orb: nothing in the picture, glass left out, is lit"));
    }
}

} // namespace
} // namespace threefold
