// SPDX-License-Identifier: MIT
// The claims about folds at other values than the study's: where they read, what they refuse, what they say.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exporter/temporary_folder.h"
#include "scenes/error.h"
#include "tests/quick_request.h"
#include "verifier/check/check.h"
#include "verifier/check/plan.h"
#include "verifier/claims/fold_numbers.h"

namespace threefold {
namespace {

using testing::AllOf;
using testing::HasSubstr;

ClaimContext context(std::vector<Assignment> assignments) {
    static const std::vector<SceneRecipe> scenes = built_in_scenes();
    return {scenes, Preset::text, std::move(assignments), true};
}

const Claim &claim(std::string_view name) {
    static const std::vector<Claim> claims = built_in_claims();
    return find_claim(claims, name);
}

TEST(FoldRing, StaysInsideAThickWalledHollow) {
    EXPECT_NEAR(fold_numbers(context({}), {}).circle_share, 0.95, 1e-12) << "where the study's wall leaves room";
    for (const char *wall : {"4", "10", "15"}) {
        const FoldNumbers n = fold_numbers(context({{"orb.wall_mm", wall}}), {});
        EXPECT_LT(n.circle_share * n.orb.outer_mm, n.orb.inner_mm);
        for (std::size_t k = 0; k < n.jump_mm.size(); ++k) EXPECT_TRUE(n.jump_mm[k]) << wall << " mm, fold " << k;
    }
}

TEST(Folds, ThatOverlapAreRefusedBeforeRendering) {
    const auto refusal = [&](const char *name, std::vector<Assignment> assignments) {
        try {
            claim(name).experiments(context(std::move(assignments)));
        } catch (const Error &error) {
            return std::string(error.what()) + error.hint();
        }
        return std::string();
    };
    for (const char *name : {"folds", "shift", "wall-limit"})
        EXPECT_THAT(refusal(name, {{"folds.miss_mm", "-20"}}), AllOf(HasSubstr("overlap"), HasSubstr("folds.miss_mm")))
            << name;
    EXPECT_THAT(refusal("shift", {{"folds.width_deg", "15"}}), HasSubstr("overlap"));
    EXPECT_EQ(refusal("folds", {{"folds.miss_mm", "12"}}), "");
}

TEST(ThreeLines, ABendWhereThePlaceIsReadIsRefusedBeforeRendering) {
    EXPECT_NO_THROW(claim("three-lines").experiments(context({{"lines.half_width_mm", "2"}})));
    for (const char *half : {"3", "7"}) try {
            claim("three-lines").experiments(context({{"lines.half_width_mm", half}}));
            FAIL() << half;
        } catch (const Error &error) {
            EXPECT_THAT(error.what(), HasSubstr("the bent line bends where its place is read"));
        }
}

TEST(Shift, LooksForItsFlipOnBothSides) {
    const std::vector<FlipPoint> flips = claim("shift").flips(context({{"robe.shift_mm", "8"}}));
    ASSERT_EQ(flips.size(), 1u);
    EXPECT_GT(flips.front().value, 0) << "the orb has to follow the robe";
}

TEST(Shift, ReadsABracketAsSharplyAsItsGapAsks) {
    const TemporaryFolder folder;
    CheckRequest request = quick_request<CheckRequest>(folder.path(), {"shift"});
    request.assignments = {{"eye.distance_mm", "300"}};
    const ClaimResult shift = check(request).result.claims.back();
    EXPECT_EQ(shift.verdict, Verdict::holds);
    EXPECT_EQ(shift.flips.size(), 1u);
}

TEST(WallLimit, HoldsTheStudysWordsAgainstItsOwnWall) {
    const auto note = [](std::vector<Assignment> assignments) {
        return claim("wall-limit").notes(context(std::move(assignments))).front();
    };
    EXPECT_THAT(note({}), AllOf(HasSubstr("1.3 mm. That is not so"), HasSubstr("4.98'")));
    EXPECT_THAT(note({{"criterion.acuity_arcmin", "6"}}), AllOf(HasSubstr("That is so"), HasSubstr("4.98'")));
    EXPECT_EQ(note({{"orb.wall_mm", "0.15"}}), note({})) << "the study's wall, not this one";
}

} // namespace
} // namespace threefold
