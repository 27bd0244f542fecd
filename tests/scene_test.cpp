// SPDX-License-Identifier: MIT
// The vocabulary: parameters, validation, camera, catalogue.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "exporter/scene_json.h"
#include "scenes/camera.h"
#include "scenes/catalogue/catalogue.h"
#include "scenes/error.h"
#include "scenes/texture.h"
#include "scenes/validate.h"
#include "tests/catalogue_scene.h"

namespace threefold {
namespace {

using testing::HasSubstr;

std::string error_of(auto action, Exit expected = Exit::bad_data) {
    try {
        action();
    } catch (const Error &error) {
        EXPECT_EQ(error.code(), expected) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    ADD_FAILURE() << "no error";
    return "";
}

Scene good() { return catalogue_scene("hollow"); }

std::string refused(auto change) {
    Scene s = good();
    change(s);
    return error_of([&] { validate(s); });
}

GlassShell &shell(Scene &s) { return std::get<GlassShell>(s.objects[0].shape); }
Quad &card(Scene &s) { return std::get<Quad>(s.objects[1].shape); }

TEST(Catalogue, EverySceneIsValidUnderBothPresets) {
    for (const SceneRecipe &recipe : built_in_scenes())
        for (const Preset preset : {Preset::text, Preset::published})
            EXPECT_NO_THROW(validate(recipe.make(Parameters(recipe.parameters, preset)))) << recipe.name;
}

TEST(Catalogue, ThePresetsDifferWhereTheStudyDoes) {
    const auto scenes = built_in_scenes();
    const auto &specs = find_scene(scenes, "hollow").parameters;
    const Parameters text(specs, Preset::text), published(specs, Preset::published);
    EXPECT_EQ(text.number("eye.distance_mm"), 900);
    EXPECT_EQ(published.number("eye.distance_mm"), 1200);
    EXPECT_EQ(published.number("card.distance_mm"), 297.5);
    EXPECT_EQ(published.number("orb.radius_mm"), 67.98);
    EXPECT_EQ(text.number("orb.wall_mm"), 1.3);
}

TEST(Parameters, AnUnknownNameIsAnsweredWithTheNearestAndAllValidOnes) {
    const auto scenes = built_in_scenes();
    Parameters p(find_scene(scenes, "hollow").parameters, Preset::text);
    const std::string error = error_of([&] { p.set("orb.wal_mm", "1"); }, Exit::usage);
    EXPECT_THAT(error, HasSubstr("did you mean 'orb.wall_mm'"));
    EXPECT_THAT(error, HasSubstr("eye.distance_mm"));
    EXPECT_THAT(error_of([&] { find_scene(scenes, "holow"); }, Exit::usage), HasSubstr("did you mean 'hollow'"));
}

TEST(Parameters, ValuesThatAreNoGoodAreRefused) {
    const auto scenes = built_in_scenes();
    Parameters p(find_scene(scenes, "hollow").parameters, Preset::text);
    for (const char *bad : {"nan", "inf", "-inf", "", "1mm", "1,5", "0x", "--1", "-1", "0"})
        error_of([&] { p.set("orb.radius_mm", bad); });
    error_of([&] { p.set("glass.index", "0.9"); });
    error_of([&] { p.set("image.width_px", "10.5"); });
    error_of([&] { p.set("image.width_px", "0"); });
    EXPECT_THAT(error_of([&] { p.set("card.surface", "texture"); }), HasSubstr("did you mean 'textured'"));
    EXPECT_EQ(p.number("orb.radius_mm"), 68) << "a refused value changes nothing";
}

TEST(Parameters, APathIsAnyTextAndItsFileIsReadOnlyByTheReaderThatWasGiven) {
    const std::vector<ParameterSpec> specs{{.name = "hand.mesh", .description = "a mesh", .path = true}};
    Parameters p(specs, Preset::text);
    EXPECT_EQ(p.word("hand.mesh"), "");
    EXPECT_EQ(p.text("hand.mesh"), "");
    p.set("hand.mesh", "my \"hand\"; rm -rf.obj");
    EXPECT_EQ(p.word("hand.mesh"), "my \"hand\"; rm -rf.obj");
    EXPECT_THAT(error_of([&] { p.set("hand.mesh", 1); }), HasSubstr("name of a file"));
    EXPECT_THAT(error_of([&] { p.files().mesh(p.word("hand.mesh")); }, Exit::internal), HasSubstr("rm -rf.obj"));

    FileReader reader = no_files();
    reader.mesh = [](const std::string &path) { return Mesh{{Vec3(double(path.size()))}, {}, {}, {}}; };
    EXPECT_EQ(Parameters(specs, Preset::text, reader).files().mesh("four").vertices_mm[0].x, 4);
}

TEST(Parameters, AnAssignmentNeedsANameAndAnEqualsSign) {
    EXPECT_EQ(parse_assignment("a=b=c").value, "b=c");
    error_of([] { parse_assignment("a"); }, Exit::usage);
    error_of([] { parse_assignment("=1"); }, Exit::usage);
}

TEST(Validate, RefusesRectanglesThatOverlapInOnePlane) {
    const Quad a{{0, 0, -5}, {2, 0, 0}, {0, 1, 0}, Emissive{Rgb(1)}};
    const auto verdict = [&](const Quad &b) {
        Scene s = good();
        s.objects = {{"wall", a}, {"picture", b}};
        try {
            validate(s);
        } catch (const Error &error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const auto moved = [&](Vec3 by) {
        Quad b = a;
        b.centre_mm += by;
        return b;
    };
    EXPECT_THAT(verdict(moved({1, 0.5, 0})), testing::HasSubstr("wall and picture lie in one plane and overlap"));
    EXPECT_THAT(verdict(moved({0, 0, 1e-8})), testing::HasSubstr("overlap")) << "nearer than single precision tells";
    EXPECT_THAT(verdict({{3.2, 0, -5}, {1, 1, 0}, {-1, 1, 0}, Emissive{Rgb(1)}}), testing::HasSubstr("overlap"));
    EXPECT_EQ(verdict({{4.1, 0, -5}, {1, 1, 0}, {-1, 1, 0}, Emissive{Rgb(1)}}), "")
        << "turned by 45 degrees, beside it";
    EXPECT_EQ(verdict({{3.2, 2.2, -5}, {1, 1, 0}, {-1, 1, 0}, Emissive{Rgb(1)}}), "") << "off its corner";
    EXPECT_EQ(verdict(moved({4, 0, 0})), "") << "they share an edge";
    EXPECT_EQ(verdict(moved({0, 0, -1e-3})), "") << "one behind the other";
    EXPECT_EQ(verdict({{0, 0, -5}, {2, 0, 0}, {0, 0, 1}, Emissive{Rgb(1)}}), "") << "they cross";
}

TEST(Validate, AcceptsTheCatalogue) { EXPECT_NO_THROW(validate(good())); }

TEST(Validate, RefusesGlassWithoutMeaning) {
    EXPECT_THAT(refused([](Scene &s) { shell(s).outer_radius_mm = 0; }), HasSubstr("radius"));
    EXPECT_THAT(refused([](Scene &s) { shell(s).outer_radius_mm = NAN; }), HasSubstr("radius"));
    EXPECT_THAT(refused([](Scene &s) { shell(s).wall_mm = -1; }), HasSubstr("wall"));
    EXPECT_THAT(refused([](Scene &s) { shell(s).wall_mm = 68; }), HasSubstr("thinner"));
    EXPECT_THAT(refused([](Scene &s) { shell(s).wall_mm = 1e-18; }), HasSubstr("vanishes"));
    EXPECT_THAT(refused([](Scene &s) { shell(s).glass.index = 0.9; }), HasSubstr("index"));
    EXPECT_THAT(refused([](Scene &s) { shell(s).glass.index = NAN; }), HasSubstr("index"));
    EXPECT_THAT(refused([](Scene &s) { shell(s).glass.interface_transmittance = 1.5; }), HasSubstr("transmittance"));
    EXPECT_THAT(refused([](Scene &s) { shell(s).centre_mm.x = INFINITY; }), HasSubstr("centre"));
}

TEST(Validate, RefusesAnEyeInTheGlassAndBodiesThatOverlap) {
    EXPECT_THAT(refused([](Scene &s) { s.camera.eye_mm = {0, 0, 67.5}; }), HasSubstr("eye"));
    EXPECT_THAT(refused([](Scene &s) { s.camera.eye_mm = {0, 0, 10}; }), HasSubstr("eye"));
    EXPECT_THAT(refused([](Scene &s) { card(s).centre_mm = {0, 0, -60}; }), HasSubstr("cuts"));
    EXPECT_THAT(refused([](Scene &s) {
                    s.objects.push_back({"twin", GlassBall{{100, 0, 0}, 68, {}}});
                }),
                HasSubstr("overlap"));
    Scene touching = good();
    card(touching).centre_mm = {0, 0, -68};
    EXPECT_NO_THROW(validate(touching));
}

TEST(Validate, RefusesPicturesThatCannotBe) {
    EXPECT_THAT(refused([](Scene &s) { s.camera.width_px = 0; }), HasSubstr("no size"));
    EXPECT_THAT(refused([](Scene &s) { s.camera.width_px = s.camera.height_px = 100000; }), HasSubstr("GB"));
    EXPECT_THAT(refused([](Scene &s) { s.camera.crop = Crop{250, 0, 10, 10}; }), HasSubstr("crop"));
    EXPECT_THAT(refused([](Scene &s) { s.camera.horizontal_fov_deg = 180; }), HasSubstr("field of view"));
    EXPECT_THAT(refused([](Scene &s) { s.camera.target_mm = s.camera.eye_mm; }), HasSubstr("coincide"));
    EXPECT_THAT(refused([](Scene &s) { s.camera.up = {0, 0, 1}; }), HasSubstr("up"));
}

TEST(Validate, RefusesSurfacesWithoutMeaningAndTheDark) {
    EXPECT_THAT(refused([](Scene &s) { card(s).half_u_mm = {0, 0, 0}; }), HasSubstr("half width"));
    EXPECT_THAT(refused([](Scene &s) { card(s).half_v_mm = {1, 1, 0}; }), HasSubstr("perpendicular"));
    EXPECT_THAT(refused([](Scene &s) { card(s).surface = Emissive{Rgb(-1)}; }), HasSubstr("negative"));
    EXPECT_THAT(refused([](Scene &s) { card(s).surface = Emissive{std::make_shared<const Texture>()}; }),
                HasSubstr("image"));
    EXPECT_THAT(refused([](Scene &s) { s.objects.push_back({"m", Mesh{}}); }), HasSubstr("empty"));
    EXPECT_THAT(refused([](Scene &s) {
                    s.objects.push_back({"m", Mesh{{{0, 0, -200}}, {{0, 0, 7}}, {}, Diffuse{}}});
                }),
                HasSubstr("vertex"));
    EXPECT_THAT(refused([](Scene &s) {
                    s.environment.reset();
                    card(s).surface = Emissive{Rgb(0)};
                }),
                HasSubstr("dark"));
}

TEST(Needs, FollowFromTheScene) {
    Scene s = good();
    EXPECT_TRUE(needs(s).ray_tree);
    shell(s).glass.coating = Coating::antireflective;
    EXPECT_FALSE(needs(s).ray_tree);
    EXPECT_TRUE(needs(s).glass);
    EXPECT_FALSE(needs(s).direct_light);
    card(s).surface = Diffuse{Rgb(0.5)};
    s.lights = {{{0, -1, -1}, Rgb(2)}};
    EXPECT_TRUE(needs(s).direct_light);
    EXPECT_TRUE(needs(s).environment_on_diffuse);
    EXPECT_FALSE(needs(s).glass_shadow);
    s.glass_shadow = {GlassShadow::Rule::caustic, 1};
    EXPECT_TRUE(needs(s).caustics);
}

TEST(Camera, LooksAtItsTargetThroughTheMiddleAndUpIsUp) {
    Camera c;
    c.eye_mm = {100, 200, 300};
    c.target_mm = {-50, 20, -10};
    const Ray middle = camera_ray(c, {c.width_px / 2.0, c.height_px / 2.0});
    EXPECT_LT(glm::length(middle.direction - glm::normalize(c.target_mm - c.eye_mm)), 1e-15);
    EXPECT_GT(camera_ray(c, {128, 0}).direction.y, middle.direction.y);
    const auto [right, up, forward] = camera_frame(c);
    EXPECT_LT(glm::length(glm::cross(right, up) + forward), 1e-15) << "right-handed: right x up points at the viewer";
}

TEST(Camera, ACropSeesWhatTheFullFilmSeesThere) {
    Camera full;
    full.width_px = 200;
    full.height_px = 100;
    Camera crop = full;
    crop.crop = Crop{30, 40, 20, 10};
    EXPECT_EQ(camera_ray(crop, {1.5, 2.5}).direction, camera_ray(full, {31.5, 42.5}).direction);
}

TEST(Texture, IsBilinearBetweenTexelCentresAndClamped) {
    const Texture t{2, 2, {0, 0, 0, 65535, 0, 0, 0, 65535, 0, 65535, 65535, 0}}; // row 0 is the top
    EXPECT_EQ(sample(t, {0.25, 0.75}), Rgb(0, 0, 0));
    EXPECT_EQ(sample(t, {0.75, 0.75}), Rgb(1, 0, 0));
    EXPECT_EQ(sample(t, {0.25, 0.25}), Rgb(0, 1, 0));
    EXPECT_EQ(sample(t, {0.5, 0.5}), Rgb(0.5, 0.5, 0));
    EXPECT_EQ(sample(t, {-1, 2}), Rgb(0, 0, 0));
}

TEST(SceneHash, ChangesWithEveryPartOfAScene) {
    const std::string hash = scene_hash(good());
    EXPECT_EQ(hash, scene_hash(good()));
    Scene s = good();
    shell(s).wall_mm = std::nextafter(shell(s).wall_mm, 2);
    EXPECT_NE(hash, scene_hash(s));
    s = good();
    s.name = "a\nb\"\xff";
    EXPECT_NE(hash, scene_hash(s));
    s = good();
    s.camera.film_offset_px.x = 0.25;
    EXPECT_NE(hash, scene_hash(s));
}

} // namespace
} // namespace threefold
