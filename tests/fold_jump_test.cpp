// SPDX-License-Identifier: MIT
// The closed form of a line's jump, against textbook sums of inverse sines and against the study's own figures.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scenes/catalogue/catalogue.h"
#include "verifier/claims/fold_experiment.h"
#include "verifier/claims/fold_numbers.h"

namespace threefold {
namespace {

/// A line at `miss_mm` to the left of the point behind the centre.
FoldEdge line_at(double angle_rad, double miss_mm, double plane_mm) {
    const Vec3 along(std::cos(angle_rad), std::sin(angle_rad), 0), left(-along.y, along.x, 0);
    const Vec3 foot = Vec3(0, 0, -plane_mm) + miss_mm * left;
    return {foot + 10.0 * along, foot + 900.0 * along};
}

FoldScene scene_of(double radius_mm, double wall_mm, double index, double eye_mm) {
    return {{Vec3(0), optics::shell(radius_mm, wall_mm, index), {}}, Vec3(0, 0, eye_mm), {}};
}

/// s/h by the textbook: each asin is the angle to the radius at one surface.
double straight_over_landed(double R, double wall, double n, double eye, double plane, double b) {
    const double r = R - wall;
    const double turn = 2 * ((std::asin(b / R) - std::asin(b / (n * R))) + (std::asin(b / (n * r)) - std::asin(b / r)));
    const double angle = std::asin(b / eye) - turn;
    return (eye + plane) * std::tan(std::asin(b / eye)) / ((b + plane * std::sin(angle)) / std::cos(angle));
}

TEST(FoldJump, IsNothingForALineThroughThePointBehindTheCentreAtAnyWallAndGlass) {
    for (const double wall : {0.01, 1.3, 2.72})
        for (const double index : {1.1, 1.51714, 2.4}) {
            const auto jump = edge_jump(scene_of(68, wall, index, 900), line_at(0.7, 0, 250), {50, 61.2, 64.6});
            ASSERT_TRUE(jump);
            EXPECT_NEAR(*jump, 0, 1e-9) << wall << " " << index;
        }
}

TEST(FoldJump, OfALineBesideItFollowsTheTextbook) {
    for (const double b : {30.0, 55.0, 64.6})
        for (const double miss : {-10.0, 3.0, 25.0}) {
            const auto jump = edge_jump(scene_of(68, 1.3, 1.51714, 900), line_at(1.2, miss, 250), {b});
            ASSERT_TRUE(jump);
            EXPECT_NEAR(*jump, -miss * (1 - straight_over_landed(68, 1.3, 1.51714, 900, 250, b)), 1e-9);
        }
}

TEST(FoldJump, AgreesWithTheDeflectionThatTheStudysPageStates) {
    // -106 mrad at b = 0.95 R behind a wall of 2 %.
    const double b = 0.95 * 68, angle = std::asin(b / 900) + 0.106;
    const double straight = 1150 * std::tan(std::asin(b / 900)), landed = (b + 250 * std::sin(angle)) / std::cos(angle);
    const auto jump = edge_jump(scene_of(68, 1.36, 1.51714, 900), line_at(0.3, 10, 250), {b});
    ASSERT_TRUE(jump);
    EXPECT_NEAR(*jump, -10 * (1 - straight / landed), 0.02);
}

TEST(FoldJump, OutsideTheOrbThereIsNone) {
    const FoldScene scene = scene_of(68, 1.3, 1.51714, 900);
    const FoldEdge edge = line_at(0.8, 7, 250);
    const auto azimuth = edge_azimuth(scene, edge, 75);
    ASSERT_TRUE(azimuth);
    EXPECT_NEAR(straight_place(edge, ray_on_circle(scene, 75, *azimuth)).y, 0, 1e-9);
}

TEST(FoldJump, DoesNotAskWhereTheWholeSceneStands) {
    const FoldEdge edge = line_at(0.8, 7, 250);
    FoldScene scene = scene_of(68, 1.3, 1.51714, 900);
    const auto here = edge_jump(scene, edge, {64});
    const Vec3 by(31, -17, 5);
    scene.orb.centre_mm += by;
    scene.eye_mm += by;
    const auto there = edge_jump(scene, {edge.start_mm + by, edge.end_mm + by}, {64});
    ASSERT_TRUE(here && there);
    EXPECT_NEAR(*here, *there, 1e-9);
}

TEST(FoldJump, IsNotStatedWhereNoRayFindsItsWayThrough) {
    EXPECT_FALSE(edge_jump(scene_of(68, 1.3, 1.51714, 900), line_at(0.8, 7, 250), {67})) << "in the rim";
    const FoldEdge far{Vec3(0, 200, -250), Vec3(0, 300, -250)};
    EXPECT_FALSE(edge_jump(scene_of(68, 1.3, 1.51714, 900), far, {50})) << "the edge does not reach so far";
}

ClaimContext context_of(const std::vector<SceneRecipe> &scenes, std::vector<Assignment> assignments) {
    return {scenes, Preset::text, std::move(assignments), true};
}

TEST(FoldFlip, OfTheMissMovesWithDistancesRadiiAndIndexAsTheClosedFormSays) {
    const std::vector<SceneRecipe> scenes = built_in_scenes();
    struct Case {
        double R, wall, n, eye, plane;
    };
    for (const Case c :
         {Case{68, 1.3, 1.51714, 900, 250}, Case{60, 0.9, 1.6, 700, 180}, Case{90, 1.8, 1.45, 1500, 400}}) {
        const ClaimContext context =
            context_of(scenes, {assign("orb.radius_mm", c.R), assign("orb.wall_mm", c.wall), assign("glass.index", c.n),
                                assign("eye.distance_mm", c.eye), assign("card.distance_mm", c.plane)});
        FoldSearch search;
        search.parameter = "folds.miss_mm";
        search.folds = {leftmost_fold};
        search.high = 0.9 * c.R;
        const auto flip = fold_flip(context, search);
        ASSERT_TRUE(flip);
        double share = 0;
        for (int k = 0; k < 16; ++k)
            share +=
                (1 - straight_over_landed(c.R, c.wall, c.n, c.eye, c.plane, (0.90 + 0.05 * (k + 0.5) / 16) * c.R)) / 16;
        const double criterion = (c.eye + c.plane) * std::tan(std::numbers::pi / (180 * 60));
        const double half_width = 2.25 * std::numbers::pi / 180;
        EXPECT_NEAR(*flip, criterion / (share * std::cos(half_width)), 1e-6 * *flip);
    }
}

TEST(WallLimit, OfTheRimIsWhereTheWallCoversTheAcuity) {
    const std::vector<SceneRecipe> scenes = built_in_scenes();
    const ClaimContext context = context_of(
        scenes, {assign("eye.distance_mm", 1500), assign("orb.radius_mm", 80), assign("criterion.acuity_arcmin", 2)});
    const double acuity = 2 * std::numbers::pi / (180 * 60);
    const double wall = 80 - 1500 * std::sin(std::asin(80.0 / 1500) - acuity);
    bool found = false;
    for (const FlipPoint &flip : claim_wall_limit().flips(context)) found |= std::abs(flip.value - wall) < 1e-6 * wall;
    EXPECT_TRUE(found) << wall;
}

TEST(FirstRoot, IsFoundUpwardsAndDownwards) {
    EXPECT_NEAR(*first_root([](double x) { return x * x - 2; }, 0, 5, 10, false), std::sqrt(2), 1e-10);
    EXPECT_NEAR(*first_root([](double x) { return x * x - 2; }, 0, -5, 10, false), -std::sqrt(2), 1e-10);
    EXPECT_NEAR(*first_root([](double x) { return std::log(x); }, 1e-6, 1e6, 7, true), 1, 1e-10);
    EXPECT_FALSE(first_root([](double x) { return x * x + 1; }, -5, 5, 10, false));
}

} // namespace
} // namespace threefold
