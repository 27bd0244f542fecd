// SPDX-License-Identifier: MIT
// What a run makes of values that do not suit all of its claims.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exporter/temporary_folder.h"
#include "scenes/error.h"
#include "tests/quick_request.h"
#include "verifier/check/check.h"
#include "verifier/check/plan.h"
#include "verifier/claims/flip.h"

namespace threefold {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

CheckRequest request(const TemporaryFolder &folder, const std::vector<std::string> &names,
                     std::vector<Assignment> assignments) {
    CheckRequest r = quick_request<CheckRequest>(folder.path(), names);
    r.assignments = std::move(assignments);
    return r;
}

TEST(Plan, LeavesOutAClaimThatHasNoSceneAndGoesOn) {
    const TemporaryFolder folder;
    const CheckOutcome outcome =
        check(request(folder, {"calibration", "three-lines", "hand-contact"}, {{"orb.radius_mm", "160"}}));
    ASSERT_EQ(outcome.result.claims.size(), 3u);
    const ClaimResult &lines = outcome.result.claims[1];
    EXPECT_EQ(lines.verdict, Verdict::undecided);
    EXPECT_THAT(lines.notes, Contains(AllOf(HasSubstr("three-lines"), HasSubstr("cuts the glass orb"))));
    EXPECT_TRUE(lines.blamed.empty());
    EXPECT_THAT(outcome.result.summary,
                HasSubstr("three-lines (text) has no scene with orb.radius_mm=160: a rectangle"));
    EXPECT_NE(outcome.result.claims[2].verdict, Verdict::fails);
    EXPECT_FALSE(outcome.result.claims[2].rows.empty()) << "it was asked";
    EXPECT_EQ(outcome.exit, Exit::undecided);
}

TEST(Plan, RefusesWhatNoClaimCanBeAsked) {
    const TemporaryFolder folder;
    const auto refusal = [&](const std::vector<std::string> &names, std::vector<Assignment> assignments) {
        try {
            plan_of(request(folder, names, std::move(assignments)));
        } catch (const Error &error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(refusal({"calibration", "three-lines"}, {{"orb.radius_mm", "160"}}),
                AllOf(HasSubstr("three-lines"), HasSubstr("cuts the glass orb")));
    EXPECT_THAT(refusal({"three-lines", "soft-light"}, {{"glass.index", "0.5"}}), HasSubstr("out of range"))
        << "no scene can have it";
    EXPECT_THAT(refusal({"three-lines", "soft-light"}, {{"glass.indx", "1.5"}}), HasSubstr("glass.index"));
    EXPECT_EQ(refusal({"three-lines", "hand-contact"}, {{"orb.radius_mm", "160"}}), "");
}

TEST(Plan, AddsNoExperimentThatDoesNotFit) {
    const TemporaryFolder folder;
    const auto problem_of = [&](const std::string &name, std::vector<Assignment> assignments) {
        return plan_of(request(folder, {name}, std::move(assignments))).front().problem;
    };
    EXPECT_EQ(problem_of("dark-layer", {{"orb.wall_mm", "40"}}), "");
    EXPECT_EQ(problem_of("rim-reads-wall", {{"orb.radius_mm", "2"}, {"orb.wall_mm", "0.05"}}), "");
    EXPECT_EQ(problem_of("solid-vs-hollow", {{"eye.distance_mm", "9000"}, {"card.distance_mm", "9000"}}), "");
}

TEST(Plan, KnowsWhichValuesAClaimDoesNotUse) {
    const TemporaryFolder folder;
    const auto unused = [&](const std::string &name, std::vector<Assignment> assignments) {
        return unused_values(plan_of(request(folder, {name}, std::move(assignments))).front());
    };
    EXPECT_THAT(unused("white-spots", {{"source.half_width_mm", "1000"}, {"orb.radius_mm", "70"}}),
                testing::ElementsAre("source.half_width_mm"));
    EXPECT_THAT(unused("energy", {{"glass.interface_transmittance", "0.9"}}),
                testing::ElementsAre("glass.interface_transmittance"));
    EXPECT_THAT(unused("energy", {{"glass.index", "1.6"}, {"orb.wall_mm", "2.0"}}), testing::IsEmpty());
}

TEST(Bracket, DoesNotGoBelowWhatAParameterCanBe) {
    EXPECT_DOUBLE_EQ(bracket_of(1.2103, 1)[0].value, 1.2103 * (1 - bracket_share));
    EXPECT_DOUBLE_EQ(bracket_of(1.002, 1)[0].value, 1.001);
    EXPECT_DOUBLE_EQ(bracket_of(1.002, 1)[1].value, 1.002 * (1 + bracket_share));
}

TEST(RimReadsWall, FailsByOpticsBeyondItsFlipPoint) {
    const TemporaryFolder folder;
    const ClaimResult rim = check(request(folder, {"rim-reads-wall"}, {{"orb.wall_mm", "30"}})).result.claims.back();
    EXPECT_EQ(rim.verdict, Verdict::fails);
    EXPECT_TRUE(rim.blamed.empty()) << "no renderer is at fault";
    EXPECT_THAT(rim.summary, HasSubstr("In a wall of 30 mm"));
}

TEST(SolidVsHollow, ReadsTheSlopeWhereTheCardEnds) {
    const TemporaryFolder folder;
    const ClaimResult far =
        check(request(folder, {"solid-vs-hollow"}, {{"eye.distance_mm", "9000"}, {"card.distance_mm", "9000"}}))
            .result.claims.back();
    EXPECT_EQ(far.verdict, Verdict::holds);
}

TEST(Plan, ClaimsAreDecidedFarFromTheStudysValues) {
    const TemporaryFolder folder;
    struct Far {
        const char *claim;
        std::vector<Assignment> values;
        Verdict verdict;
    };
    for (const Far &far : {
             // Weak glass; an orb that fills a fifth of the eye's view; walls far beyond the flip point.
             Far{"rim-reads-wall", {{"glass.index", "1.05"}}, Verdict::holds},
             {"rim-reads-wall",
              {{"orb.radius_mm", "200"}, {"glass.index", "1.8"}, {"orb.wall_mm", "10"}},
              Verdict::holds},
             {"rim-reads-wall", {{"orb.wall_mm", "45"}}, Verdict::fails},
             {"rim-reads-wall", {{"orb.wall_mm", "30"}, {"glass.index", "1.2"}}, Verdict::fails},
             // The line bends beside the orb, however large that is, and is read where it is seen beyond its bend.
             {"three-lines", {{"orb.radius_mm", "75"}}, Verdict::holds},
             {"three-lines", {{"orb.radius_mm", "90"}}, Verdict::holds},
             {"three-lines", {{"orb.wall_mm", "0.5"}}, Verdict::holds},
             // The robe is wider than what the orb hides of it.
             {"dark-layer", {{"orb.radius_mm", "76.1"}, {"card.distance_mm", "290"}}, Verdict::holds},
         }) {
        const ClaimResult result = check(request(folder, {far.claim}, far.values)).result.claims.back();
        EXPECT_EQ(result.verdict, far.verdict)
            << far.claim << " " << far.values.front().name << " " << far.values.front().value;
    }
}

} // namespace
} // namespace threefold
