// SPDX-License-Identifier: MIT
// The generated figure: hand, relief, folds, light, camera.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include <glm/geometric.hpp>

#include "scenes/catalogue/composition.h"
#include "scenes/catalogue/painted_robe.h"
#include "scenes/error.h"
#include "scenes/figure/film_camera.h"
#include "scenes/figure/hand.h"
#include "scenes/figure/hand_shape.h"
#include "scenes/figure/light.h"
#include "scenes/figure/painted_relief.h"
#include "scenes/figure/relief.h"
#include "scenes/figure/stored_figure.h"
#include "scenes/geometry.h"
#include "scenes/validate.h"
#include "tests/catalogue_scene.h"

namespace threefold {
namespace {

using namespace figure;

const Mesh &mesh_of(const Scene &scene, std::string_view name) {
    return std::get<Mesh>(std::ranges::find(scene.objects, name, &Object::name)->shape);
}

TEST(Contact, IsMeasuredToTheInsideOfTrianglesNotOnlyToTheirCorners) {
    Mesh mesh;
    mesh.vertices_mm = {{-3, -3, 2}, {3, -3, 2}, {0, 5, 2}};
    mesh.triangles = {{0, 1, 2}};
    EXPECT_DOUBLE_EQ(distance_to(mesh, Vec3(0)), 2);
    EXPECT_DOUBLE_EQ(distance_to(mesh, Vec3(0, -5, 2)), 2); // an edge
    EXPECT_DOUBLE_EQ(distance_to(mesh, Vec3(6, -7, 2)), 5); // a corner
    mesh.vertices_mm[2] = mesh.vertices_mm[1];              // degenerate
    EXPECT_DOUBLE_EQ(distance_to(mesh, Vec3(0, 0, 2)), 3);
}

TEST(Hand, TouchesTheOrbAndIsNowhereInsideIt) {
    for (const double base : {68.0, 67.98})
        for (const double factor : {0.2, 0.5, 1.0, 1.7, 5.0}) {
            const double radius = base * factor;
            const Vec3 centre(12, -3, 5);
            const double gap = distance_to(holding_hand(centre, radius), centre) - radius;
            EXPECT_GT(gap, 0) << radius;
            EXPECT_LT(gap, 0.5) << radius;
            EXPECT_GE(gap, 0.49 * contact_gap_mm(radius)) << radius;
            EXPECT_LE(gap, 4 * contact_gap_mm(radius)) << radius;
        }
}

TEST(Hand, HoldsTheOrbFromBelowWithFingersInFrontAndThePalmBehind) {
    const Mesh hand = holding_hand(Vec3(0), 1);
    double top = -9, nearest = -9, farthest = 9;
    for (const Vec3 v : hand.vertices_mm) {
        top = std::max(top, v.y);
        nearest = std::max(nearest, v.z);
        farthest = std::min(farthest, v.z);
    }
    EXPECT_LT(top, 0);
    EXPECT_GT(nearest, 0.5);
    EXPECT_LT(farthest, -1);
}

TEST(Hand, StaysInContactInTheScenesWhereverTheOrbIs) {
    for (const Preset preset : {Preset::text, Preset::published})
        for (const char *shift : {"0", "20"}) {
            const Scene scene =
                catalogue_scene("salvator", {{"orb.shift_mm", shift}, {"robe.relief_resolution", "20"}}, preset);
            const GlassShell &orb = std::get<GlassShell>(scene.objects.front().shape);
            const double gap = distance_to(mesh_of(scene, "hand"), orb.centre_mm) - orb.outer_radius_mm;
            EXPECT_GT(gap, 0);
            EXPECT_LT(gap, 0.5);
        }
}

/// Angle about the orb's centre, in degrees, at which the crest near `from_deg` lies at a distance from it.
double crest_deg(double distance, double from_deg) {
    double best = from_deg, height = -1;
    for (double angle = from_deg - 5; angle <= from_deg + 5; angle += 0.02) {
        const double a = angle * std::numbers::pi / 180;
        if (const double h = fold_height(orb_place + distance * Vec2(std::cos(a), std::sin(a))); h > height) {
            height = h;
            best = angle;
        }
    }
    EXPECT_GT(height, 0.3);
    return best;
}

TEST(Folds, FourAreAimedAtTheOrbsCentreAndTheLeftmostIsNot) {
    const auto folds = five_folds();
    double before = 180;
    for (std::size_t i = 0; i < folds.size(); ++i) {
        EXPECT_EQ(folds[i].aimed, i > 0);
        // Where it crosses the boundary: the upper right, from left to right.
        const Vec2 along = glm::normalize(folds[i].outer - folds[i].inner), to = orb_place - folds[i].inner;
        const double miss = along.x * to.y - along.y * to.x;
        const double back = std::sqrt(orb_size * orb_size - miss * miss);
        const Vec2 crossing = folds[i].inner + along * (glm::dot(along, to) + back) - orb_place;
        EXPECT_NEAR(glm::length(crossing), orb_size, 1e-12);
        const double at_deg = std::atan2(crossing.y, crossing.x) * 180 / std::numbers::pi;
        EXPECT_LT(at_deg, before);
        before = at_deg;
        if (folds[i].aimed)
            EXPECT_NEAR(miss, 0, 1e-12);
        else
            EXPECT_GT(std::abs(miss), 0.3 * orb_size);
        // The relief's own crest, inside and outside the boundary.
        const double inside = crest_deg(0.92 * orb_size, at_deg), outside = crest_deg(1.08 * orb_size, at_deg);
        if (folds[i].aimed)
            EXPECT_NEAR(inside, outside, 0.5);
        else
            EXPECT_GT(std::abs(inside - outside), 3);
    }
}

TEST(Relief, IsRaisedAlongTheLinesOfSightSoThatThePictureStaysAsDrawn) {
    const Standpoint from{{-143.4, 234.12, 1200}, 0.1878, -297.5};
    const Mesh mesh = relief(from, 40);
    for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
        const Vec2 drawn = (2.0 * mesh.uv[i] - 1.0) * Vec2(1, picture_height);
        EXPECT_NEAR(from.place(mesh.vertices_mm[i]).x, drawn.x, 1e-12);
        EXPECT_NEAR(from.place(mesh.vertices_mm[i]).y, drawn.y, 1e-12);
        EXPECT_GE(mesh.vertices_mm[i].z, -297.5 - 1e-9);
        EXPECT_LT(mesh.vertices_mm[i].z, -297.5 + 120);
    }
}

TEST(Relief, HasTheSamePictureUnderBothPresets) {
    for (const Preset preset : {Preset::text, Preset::published}) {
        const Scene scene = catalogue_scene("salvator", {{"robe.relief_resolution", "20"}}, preset);
        const Standpoint from{scene.camera.eye_mm, std::tan(scene.camera.horizontal_fov_deg * std::numbers::pi / 360),
                              preset == Preset::text ? -250.0 : -297.5};
        const Mesh &robe = mesh_of(scene, "robe");
        EXPECT_NEAR(from.place(robe.vertices_mm.front()).x, relief_low.x, 1e-9);
        EXPECT_NEAR(from.place(robe.vertices_mm.back()).y, relief_high.y, 1e-9);
        EXPECT_NEAR(from.place(Vec3(0)).x, orb_place.x, 1e-3);
        EXPECT_NEAR(from.place(Vec3(0)).y, orb_place.y, 1e-3);
    }
}

TEST(Figure, IsTheSameEveryTime) {
    const Standpoint from{{-143.4, 234.12, 1200}, 0.1878, -297.5};
    const Mesh a = relief(from, 30), b = relief(from, 30);
    EXPECT_EQ(a.vertices_mm, b.vertices_mm);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(holding_hand(Vec3(0), 68).vertices_mm, holding_hand(Vec3(0), 68).vertices_mm);
    EXPECT_EQ(noise({1.25, -3.5}, 3, 7), noise({1.25, -3.5}, 3, 7));
}

TEST(Figure, IsStoredAsItIsMade) {
    const Mesh stored = stored_hand_shape(), made = make_hand_shape();
    EXPECT_TRUE(stored.vertices_mm == made.vertices_mm);
    EXPECT_TRUE(stored.triangles == made.triangles);
    EXPECT_TRUE(stored_heights() == paint_heights(ReliefGrid(usual_relief_columns)));
    EXPECT_TRUE(stored_relief_texture() == paint_relief_texture());
    EXPECT_TRUE(stored_robe_texture() == paint_robe_texture());
    const std::vector<SceneRecipe> scenes = built_in_scenes();
    const Parameters usual(find_scene(scenes, "salvator").parameters, Preset::text);
    EXPECT_EQ(usual.number("robe.relief_resolution"), usual_relief_columns);
}

TEST(Figure, ScenesAreMeaningfulUnderBothPresetsPaintedOrInColoursOfIdentity) {
    for (const char *name : {"salvator", "setup"})
        for (const Preset preset : {Preset::text, Preset::published})
            for (const char *surface : {"painted", "identity"})
                for (const char *kind : {"hollow", "solid"})
                    EXPECT_NO_THROW(validate(catalogue_scene(
                        name, {{"figure.surface", surface}, {"orb.kind", kind}, {"robe.relief_resolution", "20"}},
                        preset)));
}

TEST(Figure, RefusesWhatSaysHowToTakeAFileThatIsNotGiven) {
    for (const char *name : {"hand.mesh_x_mm", "robe.mesh_unit_mm", "robe.texture_gamma"}) try {
            catalogue_scene("salvator", {{"robe.relief_resolution", "9"}, {name, "9"}});
            FAIL() << name;
        } catch (const Error &error) {
            EXPECT_NE(std::string(error.what()).find("means nothing without"), std::string::npos) << error.what();
        }
    EXPECT_NO_THROW(catalogue_scene("salvator", {{"robe.relief_resolution", "9"}, {"hand.mesh_unit_mm", "10"}}))
        << "its usual value";
}

TEST(Figure, InColoursOfIdentityEachThingHasItsOwn) {
    const Scene scene = catalogue_scene("salvator", {{"figure.surface", "identity"}, {"robe.relief_resolution", "9"}});
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_FALSE(scene.environment);
    EXPECT_EQ(std::get<Rgb>(std::get<Emissive>(mesh_of(scene, "hand").surface).radiance), Rgb(1, 0, 0));
    EXPECT_EQ(std::get<Rgb>(std::get<Emissive>(mesh_of(scene, "robe").surface).radiance), Rgb(0, 1, 0));
}

TEST(Figure, ARobeThatReachesIntoTheOrbIsRefused) {
    EXPECT_THROW(catalogue_scene("salvator", {{"orb.radius_mm", "240"}}), Error);
    EXPECT_NO_THROW(catalogue_scene("salvator", {{"orb.radius_mm", "340"}, {"card.distance_mm", "900"}}));
}

TEST(Lights, OfTheStudySumToItsIrradiances) {
    double sum = 0;
    for (const Directional &light : study_lights()) sum += light.irradiance.g;
    EXPECT_NEAR(sum, 100 * 0.0416 + 0.3 + 0.6, 1e-12);
    EXPECT_EQ(study_lights().size(), 102u);
    // The main light comes from above, a little from the picture's left and from the eye's side.
    for (const Directional &light : key_lights()) {
        EXPECT_LT(light.travel.y, -0.7);
        EXPECT_GT(light.travel.x, 0);
        EXPECT_LT(light.travel.z, 0);
    }
}

TEST(FilmCamera, StandsBehindItsLens) {
    const Mesh camera = film_camera({1, 2, 3}, 100);
    for (const Vec3 v : camera.vertices_mm) EXPECT_GE(v.z, 3);
    for (const glm::uvec3 t : camera.triangles) EXPECT_LT(std::max({t.x, t.y, t.z}), camera.vertices_mm.size());
}

} // namespace
} // namespace threefold
