// SPDX-License-Identifier: MIT
// What claims leave out: the formulas against others, every claim's answer to every effect, and that check says what is
// required.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include <glm/geometric.hpp>
#include <rapidcheck/gtest.h>

#include "exporter/temporary_folder.h"
#include "scenes/catalogue/catalogue.h"
#include "scenes/error.h"
#include "tests/quick_request.h"
#include "verifier/check/check.h"
#include "verifier/claims/parallel_planes.h"
#include "verifier/claims/scope_bounds.h"
#include "verifier/report/html.h"
#include "verifier/report/json.h"
#include "verifier/report/terminal.h"
#include "verifier/studies/scope.h"
#include "verifier/studies/scope_report.h"

namespace threefold {
namespace {

const std::vector<SceneRecipe> &scenes() {
    static const std::vector<SceneRecipe> all = built_in_scenes();
    return all;
}

std::vector<ScopeNumber> scope_of(const std::string &claim, const ScopeSettings &settings = {},
                                  std::vector<Assignment> assignments = {}) {
    const auto claims = built_in_claims();
    return find_claim(claims, claim).scope({scenes(), Preset::text, std::move(assignments), true}, settings);
}

ScopeResult studied(const std::vector<std::string> &names, bool closed_forms_only = true,
                    std::vector<Assignment> assignments = {}) {
    ScopeRequest request;
    const auto claims = built_in_claims();
    for (const std::string &name : names) request.claims.push_back(find_claim(claims, name));
    request.scenes = scenes();
    request.assignments = std::move(assignments);
    request.closed_forms_only = closed_forms_only;
    return study_scope(request);
}

// ---------------------------------------------------------------------------------------------------------------------
// Formulas

TEST(IndexAtWavelength, KeepsTheAbbeNumberAndComesNearToRealCrownGlass) {
    const double n = 1.5168, abbe = 64.17;
    const auto at = [&](double nm) { return optics::index_at_wavelength(n, abbe, nm); };
    EXPECT_DOUBLE_EQ(at(optics::line_d_nm), n);
    EXPECT_NEAR((n - 1) / (at(optics::line_f_nm) - at(optics::line_c_nm)), abbe, 1e-9);
    EXPECT_NEAR(at(400), 1.53085, 2e-4); // the maker's six-term formula of N-BK7
    EXPECT_NEAR(at(700), 1.51306, 2e-4);
}

TEST(GlassLeg, IsTheDistanceBetweenTheSpheresAlongTheRefractedRay) {
    const optics::Orb<double> shell = optics::shell(68.0, 1.36, 1.5), ball = optics::solid_ball(68.0, 1.5);
    EXPECT_NEAR(optics::glass_leg_mm(shell, optics::impact_at(shell, 0.0)), 1.36, 1e-12);
    EXPECT_NEAR(optics::glass_leg_mm(ball, optics::impact_at(ball, 0.0)), 136, 1e-12);
    for (const double b : {30.0, 60.0, 67.5}) { // 67.5: totally reflected
        const double g = b / 1.5, r = 68 - 1.36;
        EXPECT_NEAR(optics::glass_leg_mm(shell, optics::impact_at(shell, b)),
                    std::sqrt(68 * 68 - g * g) - std::sqrt(r * r - g * g), 1e-10);
        EXPECT_NEAR(optics::glass_leg_mm(ball, optics::impact_at(ball, b)), 2 * std::sqrt(68 * 68 - g * g), 1e-10);
    }
}

TEST(ExchangedShare, IsAllOfItAtHalfAWaveAndStaysSo) {
    EXPECT_DOUBLE_EQ(optics::exchanged_share(0, 500), 0);
    EXPECT_NEAR(optics::exchanged_share(125, 500), 0.5, 1e-12); // a quarter wave
    EXPECT_NEAR(optics::exchanged_share(250, 500), 1, 1e-12);
    EXPECT_NEAR(optics::exchanged_share(1000, 500), 1, 1e-12);
}

/// A ray from the front through a ball of radius 1, by two numbers in (0, 1).
Ray ray_to_unit_ball(double x, double y) {
    const Vec3 from(4 * x - 2, 3 * y, 20), to(0.9 * (x - y), 0.6 * (1 - 2 * x), 0);
    return {from, glm::normalize(to - from)};
}

RC_GTEST_PROP(Uniaxial, WithTwoEqualIndicesIsAnIsotropicBall, ()) {
    const double x = *rc::gen::inRange(1, 1000) / 1000.0, y = *rc::gen::inRange(1, 1000) / 1000.0;
    const Ray ray = ray_to_unit_ball(x, y);
    const optics::Uniaxial crystal{1.6, 1.6, {x, 1, y}};
    const auto ours = optics::extraordinary_ray(1, crystal, Vec3(0), ray);
    const auto plain = optics::transmitted_ray(optics::solid_ball(1.0, 1.6), Vec3(0), ray);
    RC_ASSERT(ours.has_value() == plain.has_value());
    if (!ours) return;
    RC_ASSERT(glm::length(ours->origin_mm - plain->origin_mm) < 1e-12);
    RC_ASSERT(glm::length(ours->direction - plain->direction) < 1e-12);
}

RC_GTEST_PROP(Uniaxial, LightTakesTheSameWayBack, ()) {
    const double x = *rc::gen::inRange(1, 1000) / 1000.0, y = *rc::gen::inRange(1, 1000) / 1000.0;
    const Ray ray = ray_to_unit_ball(x, y);
    const optics::Uniaxial calcite{1.658, 1.486, {y - 0.5, x, 0.3}};
    const auto there = optics::extraordinary_ray(1, calcite, Vec3(0), ray);
    if (!there) return;
    const Ray turned{there->origin_mm + 5.0 * there->direction, -there->direction};
    const auto back = optics::extraordinary_ray(1, calcite, Vec3(0), turned);
    RC_ASSERT(back.has_value());
    RC_ASSERT(glm::length(back->direction + ray.direction) < 1e-10);
    RC_ASSERT(glm::length(glm::cross(ray.origin_mm - back->origin_mm, ray.direction)) < 1e-9);
}

TEST(Uniaxial, AcrossItsAxisIsAnIsotropicBallOfTheExtraordinaryIndex) {
    const optics::Uniaxial calcite{1.658, 1.486, {0, 1, 0}};
    for (const double b : {0.0, 0.2, 0.6, 0.95}) { // in the plane y = 0 every direction lies across the axis
        const Ray ray{{b, 0, 10}, {0, 0, -1}};
        const auto e = optics::extraordinary_ray(1, calcite, Vec3(0), ray);
        const auto plain = optics::transmitted_ray(optics::solid_ball(1.0, 1.486), Vec3(0), ray);
        ASSERT_TRUE(e && plain);
        EXPECT_LT(glm::length(e->direction - plain->direction), 1e-12);
    }
}

TEST(Uniaxial, AlongTheSightLineTheRayWalksOffByTheKnownAngle) {
    const double o = 1.658, e = 1.486, walk_off = optics::greatest_walk_off_rad({o, e, {0, 0, 1}});
    EXPECT_NEAR(walk_off * 180 / std::numbers::pi, 6.26, 0.01);
    // The wave goes straight on through the middle, at the angle to the axis where walk-off is greatest: tan = e/o for
    // the wave normal. The ray leaves the sight line by it, over a chord of 2 cos(walk-off).
    const double angle = std::atan(e / o);
    const auto out =
        optics::extraordinary_ray(1, {o, e, {std::sin(angle), 0, -std::cos(angle)}}, Vec3(0), {{0, 0, 10}, {0, 0, -1}});
    ASSERT_TRUE(out);
    EXPECT_NEAR(std::abs(out->origin_mm.x), std::sin(2 * walk_off), 1e-9);
    EXPECT_NEAR(out->origin_mm.z, -std::cos(2 * walk_off), 1e-9);
}

TEST(ParallelPlanes, DeepBetweenThemEachReflectionAddsTheProductOfBothReflectances) {
    const auto extra = thrown_back({1, 80, 0.5, 0.4, -40, 120}, [](double) { return 2.0; });
    EXPECT_NEAR(extra(40), 2 * 0.2 / (1 - 0.2), 1e-3);
    EXPECT_LT(extra(-20), 0.02) << "far from the board hardly anything comes back";
}

// ---------------------------------------------------------------------------------------------------------------------
// One ray

/// Fresnel by the textbook's sines and tangents, and the product over four surfaces.
double share_by_angles(double outer, double wall, double n, double b, bool carried) {
    double mean = 1, s = 1, p = 1;
    for (const double radius : {outer, outer - wall}) {
        const double air = std::asin(b / radius), glass = std::asin(b / (n * radius));
        const double rs = std::pow(std::sin(air - glass) / std::sin(air + glass), 2),
                     rp = std::pow(std::tan(air - glass) / std::tan(air + glass), 2);
        for (int way = 0; way < 2; ++way) {
            mean *= 1 - (rs + rp) / 2;
            s *= 1 - rs;
            p *= 1 - rp;
        }
    }
    return carried ? (s + p) / 2 : mean;
}

TEST(ScopeRayTest, AtSixtyMillimetresPolarisationCarriesEightPercentMoreLight) {
    const std::optional<ScopeRay> ray = studied({"calibration"}).ray;
    ASSERT_TRUE(ray);
    EXPECT_EQ(ray->outer_mm, 68);
    EXPECT_EQ(ray->wall_mm, 1.36);
    EXPECT_EQ(ray->impact_mm, 60);
    EXPECT_NEAR(ray->polarised, 0.678, 1e-3);
    EXPECT_NEAR(ray->unpolarised, 0.627, 1e-3);
    EXPECT_NEAR(ray->polarised, share_by_angles(68, 1.36, 1.51714, 60, true), 1e-12);
    EXPECT_NEAR(ray->unpolarised, share_by_angles(68, 1.36, 1.51714, 60, false), 1e-12);
    EXPECT_NEAR(ray->polarised / ray->unpolarised, 1.08, 5e-3);
}

TEST(ScopeRayTest, FollowsWhatIsSetAndIsSilentWhereNothingGoesStraightThrough) {
    const std::optional<ScopeRay> ray =
        studied({"calibration"}, true, {{"orb.wall_mm", "2.72"}, {"glass.index", "1.6"}}).ray;
    ASSERT_TRUE(ray);
    EXPECT_NEAR(ray->polarised, share_by_angles(68, 2.72, 1.6, 60, true), 1e-12);
    EXPECT_FALSE(studied({"calibration"}, true, {{"orb.wall_mm", "9"}}).ray); // 60 mm is in the rim
}

// ---------------------------------------------------------------------------------------------------------------------
// Claims

TEST(Scope, EveryClaimAnswersEveryEffect) {
    for (const Claim &claim : built_in_claims()) {
        ASSERT_TRUE(claim.scope) << claim.name << " says nothing of what it leaves out";
        const auto numbers = claim.scope({scenes(), Preset::published, {}, true}, {});
        ASSERT_FALSE(numbers.empty()) << claim.name;
        for (const ScopeNumber &n : numbers) {
            EXPECT_TRUE(std::isfinite(n.value)) << claim.name << ": " << n.quantity;
            EXPECT_GT(n.margin, 0) << claim.name << ": " << n.quantity;
            EXPECT_FALSE(n.margin_is.empty());
            for (const EffectEntry &entry : effects()) {
                const Bound &bound = n.bounds.of(entry.effect);
                EXPECT_FALSE(bound.why.empty()) << claim.name << ", " << entry.name;
                if (bound.picture) {
                    EXPECT_FALSE(bound.picture->instead.empty());
                } else {
                    EXPECT_GE(bound.value, 0) << claim.name << ": " << n.quantity << ", " << entry.name;
                }
                if (!bound.depends) {
                    EXPECT_EQ(bound.value, 0);
                }
            }
        }
    }
}

TEST(Scope, EveryEffectHasANameOfItsOwnAndMovesSomeClaim) {
    std::set<std::string_view> names, moving;
    for (const EffectEntry &entry : effects()) names.insert(entry.name);
    EXPECT_EQ(names.size(), effects().size());
    for (const Claim &claim : built_in_claims())
        for (const ScopeNumber &n : claim.scope({scenes(), Preset::text, {}, true}, {}))
            for (const EffectEntry &entry : effects())
                if (n.bounds.of(entry.effect).depends) moving.insert(entry.name);
    EXPECT_EQ(moving, names);
}

TEST(Scope, DispersionIsTheClosedFormAtTheEndsOfTheSpectrum) {
    const ScopeNumber solid = scope_of("solid-vs-hollow").front();
    const auto slope = [](double n) { // paraxial, R 68, eye 900, plane 250
        return 1 - 2 * (n - 1) / (n * 68) * 900 * 250 / 1150;
    };
    EXPECT_NEAR(solid.value, slope(1.51714), 1e-12);
    const double violet = std::abs(slope(optics::index_at_wavelength(1.51714, 64.2, 400)) - slope(1.51714)),
                 red = std::abs(slope(optics::index_at_wavelength(1.51714, 64.2, 700)) - slope(1.51714));
    EXPECT_NEAR(solid.bounds.dispersion.value, std::max(violet, red), 1e-12);
    EXPECT_DOUBLE_EQ(solid.margin, std::abs(solid.value));
}

TEST(Scope, FollowsItsSettingsAndTheScenesParameters) {
    ScopeSettings none;
    none.abbe_number = 1e12;
    none.absorption_per_mm = none.strain_nm_per_cm = none.pupil_mm = none.light_deg = 0;
    for (const char *claim : {"solid-vs-hollow", "tint", "soft-light", "three-lines", "white-spots"})
        for (const ScopeNumber &n : scope_of(claim, none))
            for (const Effect effect :
                 {Effect::dispersion, Effect::absorption, Effect::birefringence, Effect::light_size, Effect::pupil})
                EXPECT_LT(n.bounds.of(effect).value, 1e-6 * n.margin)
                    << claim << ": " << n.quantity << ", " << to_string(effect);

    ScopeSettings flint;
    flint.abbe_number = 32.1; // half of 64.2: twice the spread
    const double crown = scope_of("solid-vs-hollow").front().bounds.dispersion.value;
    EXPECT_NEAR(scope_of("solid-vs-hollow", flint).front().bounds.dispersion.value / crown, 2, 0.05);
    EXPECT_NE(scope_of("solid-vs-hollow", {}, {{"glass.index", "1.7"}}).front().bounds.dispersion.value, crown);

    ScopeSettings wide;
    wide.light_deg = 10;
    const auto seen = [](const std::vector<ScopeNumber> &numbers) { return numbers[2].bounds.light_size.value; };
    EXPECT_GT(seen(scope_of("soft-light", wide)), 10 * seen(scope_of("soft-light")));
}

TEST(Scope, LightIsKeptByEitherPolarisationAndLostByAbsorption) {
    for (const ScopeNumber &n : scope_of("energy")) {
        EXPECT_LT(n.bounds.polarisation.value, 1e-7);
        EXPECT_FALSE(n.requires_effect(Effect::polarisation));
        EXPECT_TRUE(n.requires_effect(Effect::absorption));
    }
}

TEST(Scope, ThePenumbraWidensByTheVarianceOfADisc) {
    // 102 lights of one width: the variances add. The cluster's own spread is far larger than the sun's disc.
    ScopeSettings wide;
    wide.light_deg = 4;
    const ScopeNumber width = scope_of("soft-light", wide)[2];
    ASSERT_EQ(width.quantity, "width of the penumbra");
    EXPECT_GT(width.bounds.light_size.value, 0);
    EXPECT_LT(width.bounds.light_size.value, 0.2 * width.value);
}

TEST(Scope, WhatCouldNotBeToldIsRequired) {
    ScopeNumber n = scope_of("solid-vs-hollow").front();
    n.bounds.pupil.value = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(n.requires_effect(Effect::pupil));
    n.bounds.pupil.value = n.margin;
    EXPECT_FALSE(n.requires_effect(Effect::pupil)) << "as much as the margin is not more";
}

TEST(Scope, ASceneWithLitSurfacesIsNotTakenForOneWithout) {
    Scene scene;
    EXPECT_NO_THROW(nothing_is_lit(scene));
    scene.objects = {{"wall", Quad{}}}; // diffuse
    EXPECT_THROW(nothing_is_lit(scene), Error);
}

TEST(Scope, ALightBecomesADiscOfItsOwnStrength) {
    Scene scene;
    scene.lights = {{{0.3, -1, 0.2}, Rgb(2)}};
    const Scene discs = with_discs(scene, 2);
    double sum = 0;
    for (const Directional &light : discs.lights) {
        sum += light.irradiance.r;
        const double angle = std::acos(glm::dot(glm::normalize(light.travel), glm::normalize(scene.lights[0].travel)));
        EXPECT_LE(angle * 180 / std::numbers::pi, 1.0001);
    }
    EXPECT_NEAR(sum, 2, 1e-12);
}

TEST(PictureChangeTest, IsTheDifferenceOfTheTiles) {
    Scene dim, bright;
    dim.environment = Environment{Rgb(0.5)};
    bright.environment = Environment{Rgb(0.7)};
    dim.camera.width_px = bright.camera.width_px = dim.camera.height_px = bright.camera.height_px = 16;
    EXPECT_NEAR(picture_change({dim, {dim}, false, 8, 1}, 1), 0, 1e-15);
    EXPECT_NEAR(picture_change({dim, {dim, bright}, false, 8, 1}, 1), 0.2, 1e-12);
    EXPECT_NEAR(picture_change({dim, {dim, bright}, true, 8, 1}, 1), 0.1, 1e-12) << "of their mean";
}

// ---------------------------------------------------------------------------------------------------------------------
// What is said

TEST(Scope, TheStudyNamesWhatIsRequiredInEveryForm) {
    const ScopeResult result = studied({"tint", "hand-contact"});
    ASSERT_EQ(result.claims.size(), 2u);
    EXPECT_TRUE(std::ranges::count(result.claims[0].required(), Effect::polarisation));
    EXPECT_TRUE(result.claims[1].required().empty());
    const std::string text = to_text(result, false), page = to_markdown(result);
    EXPECT_NE(text.find("0.678"), std::string::npos) << text;
    EXPECT_NE(text.find("required"), std::string::npos);
    EXPECT_NE(page.find("**required**"), std::string::npos);
    const auto json = to_json(result);
    EXPECT_EQ(json["claims"][0]["claim"], "tint");
    EXPECT_EQ(json["claims"][0]["numbers"][0]["effects"].size(), effects().size());
    EXPECT_TRUE(json["claims"][1]["required"].empty());
}

TEST(Scope, AParameterThatNoSceneHasIsRefused) { EXPECT_THROW(studied({"tint"}, true, {{"orb.wal_mm", "2"}}), Error); }

TEST(Scope, CheckSaysThatAVerdictStandsWithinItsModelOnly) {
    const TemporaryFolder folder;
    CheckRequest r = quick_request<CheckRequest>(folder.path(), {"tint", "solid-vs-hollow"});
    RunResult result = check(r).result;
    ASSERT_EQ(result.claims.size(), 2u);
    EXPECT_EQ(result.verdict, Verdict::holds) << "it changes no verdict";
    const ClaimResult &tint = result.claims[0];
    const auto found = std::ranges::find(tint.scope, "polarisation", &ScopeFinding::effect);
    ASSERT_NE(found, tint.scope.end());
    EXPECT_GT(found->bound, found->margin);
    EXPECT_NE(found->sentence.find("polarisation could move"), std::string::npos);
    EXPECT_TRUE(result.claims[1].scope.empty());

    EXPECT_NE(to_text(result, false, 0).find(found->sentence), std::string::npos);
    EXPECT_NE(to_html(result).find("Within its model only"), std::string::npos);
    EXPECT_EQ(to_json(result)["claims"][0]["scope"][0]["effect"], tint.scope[0].effect);
}

TEST(Scope, GoesOnWithoutAClaimThatHasNoSceneAndTellsWhatItCouldNot) {
    const ScopeResult result = studied({"three-lines", "solid-vs-hollow"}, true, {{"orb.radius_mm", "160"}});
    ASSERT_EQ(result.claims.size(), 1u);
    EXPECT_EQ(result.claims.front().claim, "solid-vs-hollow");
    ASSERT_EQ(result.problems.size(), 1u);
    EXPECT_NE(to_text(result, false).find("Not asked: three-lines (text): a rectangle cuts"), std::string::npos);
    EXPECT_THROW(studied({"three-lines"}, true, {{"orb.radius_mm", "160"}}), Error);

    const ScopeResult blind = studied({"soft-light"}, true, {{"image.width_px", "8"}, {"image.height_px", "8"}});
    EXPECT_NE(to_text(blind, false).find("do not exist with these values, and of them nothing is said: soft-light"),
              std::string::npos)
        << to_text(blind, false);
}

} // namespace
} // namespace threefold
