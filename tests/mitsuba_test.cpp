// SPDX-License-Identifier: MIT
// Mitsuba scenes in and out. The files are written for these tests; Mitsuba itself is not asked: where its pictures are
// needed, our tracer makes them, which tries the way they take and says nothing of agreement.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "exporter/file_reader.h"
#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "exporter/mitsuba/pictures.h"
#include "exporter/mitsuba/read_mitsuba.h"
#include "exporter/mitsuba/write_mitsuba.h"
#include "exporter/scene_json.h"
#include "scenes/catalogue/catalogue.h"
#include "scenes/error.h"
#include "scenes/validate.h"
#include "tests/temporary_folder.h"
#include "verifier/check/check.h"
#include "verifier/check/plan.h"
#include "verifier/tracer/tracer.h"

namespace threefold {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

constexpr const char *camera = R"(<sensor type="perspective"><float name="fov" value="10"/><transform name="toWorld">
<lookat target="0,0,0" origin="90,0,0" up="0,1,0"/></transform><film type="hdrfilm"><integer name="width" value="64"/>
<integer name="height" value="48"/></film></sensor><emitter type="constant"><spectrum name="radiance" value="1"/></emitter>)";

Scene read(const tests::TemporaryFolder &folder, const std::string &body, const std::vector<Assignment> &set = {},
           const std::string &version = "0.5.0", std::vector<std::string> *notes = nullptr,
           std::vector<std::string> *changes = nullptr) {
    std::ofstream(folder / "scene.xml") << "<scene version=\"" << version << "\">\n" << body << "</scene>";
    const SceneRecipe recipe = mitsuba_scene(
        folder / "scene.xml",
        [notes](const std::string &note) {
            if (notes) notes->push_back(note);
        },
        [changes](const std::string &change) {
            if (changes) changes->push_back(change);
        });
    Parameters p(recipe.parameters, Preset::text, file_reader());
    for (const Assignment &a : set) p.set(a.name, a.value);
    return recipe.make(p);
}

std::string refusal(const tests::TemporaryFolder &folder, const std::string &body,
                    const std::string &version = "0.5.0") {
    try {
        read(folder, body, {}, version);
    } catch (const Error &error) {
        EXPECT_EQ(error.code(), Exit::bad_data);
        return error.what();
    }
    return "was read";
}

std::string sphere(double radius, const std::string &more) {
    return fmt::format("<shape type=\"sphere\"><float name=\"radius\" value=\"{}\"/>{}</shape>", radius, more);
}

std::string glass(const std::string &inside, const std::string &outside) {
    return fmt::format(
        "<bsdf type=\"dielectric\"><float name=\"intIOR\" value=\"{}\"/><float name=\"extIOR\" value=\"{}\"/></bsdf>",
        inside, outside);
}

const std::string flipped = "<boolean name=\"flipNormals\" value=\"true\"/>";

TEST(Mitsuba, TwoConcentricSpheresAreOneHollowOrbHoweverTheInnerOneIsSaid) {
    const tests::TemporaryFolder folder;
    for (const std::string &inner : {flipped + glass("1.5", "1.0"), glass("1.0", "1.5")}) {
        const Scene scene = read(folder, camera + sphere(6.5, inner) + sphere(6.8, glass("1.5", "1.0")));
        ASSERT_EQ(scene.objects.size(), 1u);
        const auto &shell = std::get<GlassShell>(scene.objects[0].shape);
        EXPECT_NEAR(shell.outer_radius_mm, 68, 1e-12);
        EXPECT_NEAR(shell.wall_mm, 3, 1e-12);
        EXPECT_DOUBLE_EQ(shell.glass.index, 1.5);
    }
}

TEST(Mitsuba, SpheresInOneAnotherThatAreNoHollowOrbAreRefused) {
    const tests::TemporaryFolder folder;
    EXPECT_THAT(refusal(folder, camera + sphere(6.8, glass("1.5", "1")) + sphere(6, glass("1.5", "1"))),
                HasSubstr("not the one hollow"));
    EXPECT_THAT(refusal(folder, camera + sphere(6.8, glass("1.0", "1.5"))), HasSubstr("less dense"));
}

TEST(Mitsuba, ACameraLooksFromItsEyeWithImageRightWhereMitsubaHasIt) {
    const tests::TemporaryFolder folder;
    const Camera c = read(folder, camera + sphere(1, glass("1.5", "1"))).camera;
    EXPECT_EQ(c.eye_mm, Vec3(900, 0, 0));
    EXPECT_EQ(c.target_mm, Vec3(0));
    EXPECT_DOUBLE_EQ(c.horizontal_fov_deg, 10);
    EXPECT_EQ(c.width_px, 64);
    // A mirrored one is another picture.
    std::string mirrored = camera;
    mirrored.replace(mirrored.find("<lookat"), 0, "<scale x=\"-1\"/>");
    EXPECT_THAT(refusal(folder, mirrored), HasSubstr("mirrors the picture"));
}

TEST(Mitsuba, ALightTurnsWithItsTransform) {
    const tests::TemporaryFolder folder;
    const Scene scene =
        read(folder, std::string(camera) + R"(<emitter type="directional"><spectrum name="irradiance" value="0.3"/>
<transform name="toWorld"><rotate x="1" angle="90"/><rotate x="1" angle="40"/><rotate y="1" angle="55"/></transform></emitter>)");
    const double el = 40 * M_PI / 180, az = 55 * M_PI / 180;
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_LT(glm::distance(scene.lights[0].travel,
                            Vec3(-std::sin(el) * std::sin(az), -std::cos(el), -std::sin(el) * std::cos(az))),
              1e-12);
    EXPECT_EQ(scene.lights[0].irradiance, Rgb(0.3));
}

TEST(Mitsuba, ARectangleSeenFromBehindIsBlackAndFromBothSidesRefused) {
    const tests::TemporaryFolder folder;
    const auto rectangle = [](double angle, double x) {
        return fmt::format(
            R"(<shape type="rectangle"><transform name="toWorld"><rotate y="1" angle="{}"/><translate x="{}"/>
</transform></shape>)",
            angle, x);
    };
    const auto reflectance = [](const Scene &s) {
        return std::get<Rgb>(std::get<Diffuse>(std::get<Quad>(s.objects.back().shape).surface).reflectance);
    };
    EXPECT_EQ(reflectance(read(folder, camera + rectangle(90, -10))), Rgb(0.5));
    EXPECT_EQ(reflectance(read(folder, camera + rectangle(-90, -10))), Rgb(0));
    EXPECT_THAT(refusal(folder, camera + sphere(1, glass("1.5", "1")) + rectangle(90, 10) + rectangle(90, 0.5)),
                HasSubstr("make it twosided"));
}

TEST(Mitsuba, AGridCoversItsRectangleOnceWithLinesOfTheStatedWidth) {
    const tests::TemporaryFolder folder;
    const Scene scene =
        read(folder, std::string(camera) + R"(<shape type="rectangle"><bsdf type="diffuse"><texture name="reflectance"
type="gridtexture"><spectrum name="color0" value="0.4"/><spectrum name="color1" value="0.8"/><float name="uscale" value="4"/>
<float name="vscale" value="2"/><float name="lineWidth" value="0.1"/></texture></bsdf><transform name="toWorld">
<rotate y="1" angle="90"/></transform></shape>)");
    ASSERT_EQ(scene.objects.size(), 2u);
    const auto area = [](const Mesh &mesh) {
        double sum = 0;
        for (const glm::uvec3 &t : mesh.triangles)
            sum += glm::length(glm::cross(mesh.vertices_mm[t.y] - mesh.vertices_mm[t.x],
                                          mesh.vertices_mm[t.z] - mesh.vertices_mm[t.x])) /
                   2;
        return sum;
    };
    const double field = area(std::get<Mesh>(scene.objects[0].shape)),
                 lines = area(std::get<Mesh>(scene.objects[1].shape));
    EXPECT_NEAR(field, 400 * 0.8 * 0.8, 1e-9);
    EXPECT_NEAR(field + lines, 400, 1e-9);
}

TEST(Mitsuba, AllThatCannotBeReadIsNamedInOneErrorWithWhereItStands) {
    const tests::TemporaryFolder folder;
    const std::string what =
        refusal(folder, std::string(camera) + "\n<emitter type=\"spot\"/>\n  <shape type=\"cube\"/>\n" +
                            sphere(std::nan(""), glass("unobtainium", "1")) +
                            "<shape type=\"obj\"><string name=\"filename\" value=\"none.obj\"/><float name=\"odd\" "
                            "value=\"1\"/></shape>");
    for (const char *part :
         {"scene.xml:5:2: <emitter type=\"spot\">", "scene.xml:6:4: <shape type=\"cube\">", "'nan' is no number",
          "'unobtainium' is no index", "there is no mesh none.obj", "name=\"odd\">: is not understood"})
        EXPECT_THAT(what, HasSubstr(part));
    EXPECT_EQ(what.find('\n'), std::string::npos);
}

TEST(Mitsuba, ASceneWithoutLightIsRefusedAndCanBeGivenOne) {
    const tests::TemporaryFolder folder;
    std::string dark = camera;
    dark.resize(dark.find("<emitter"));
    const std::string body = dark + sphere(1, glass("1.5", "1"));
    EXPECT_THAT(refusal(folder, body), HasSubstr("environment.radiance=1"));
    EXPECT_EQ(read(folder, body, {{"environment.radiance", "1"}}).environment->radiance, Rgb(1));
}

TEST(Mitsuba, ASizeThatNeedsAFilmBeyondAllNumbersIsRefused) {
    const tests::TemporaryFolder folder;
    const std::string cropped = R"(<sensor type="perspective"><float name="fov" value="10"/><transform name="toWorld">
<lookat target="0,0,0" origin="90,0,0" up="0,1,0"/></transform><film type="hdrfilm"><integer name="width" value="100000"/>
<integer name="height" value="100"/><integer name="crop_width" value="1"/><integer name="crop_height" value="1"/>
</film></sensor><emitter type="constant"><spectrum name="radiance" value="1"/></emitter>)";
    EXPECT_EQ(read(folder, cropped, {{"image.width_px", "2"}}).camera.width_px, 200000);
    for (const std::vector<Assignment> &size :
         {std::vector<Assignment>{{"image.width_px", "30000"}, {"image.height_px", "10"}},
          {{"image.height_px", "1e6"}}})
        try {
            read(folder, cropped, size);
            ADD_FAILURE() << "was read";
        } catch (const Error &error) {
            EXPECT_EQ(error.code(), Exit::bad_data);
            EXPECT_THAT(error.what(), HasSubstr("the whole film would have"));
        }
}

/// What is told of a file that is read otherwise, on one line.
std::string changes_of(const tests::TemporaryFolder &folder, const std::string &body) {
    std::vector<std::string> changes;
    read(folder, body, {}, "0.5.0", nullptr, &changes);
    return fmt::format("{}", fmt::join(changes, "; "));
}

std::string sensor_of(const std::string &transform) {
    return R"(<sensor type="perspective"><float name="fov" value="10"/><transform name="toWorld">)" + transform +
           R"(</transform></sensor><emitter type="constant"><spectrum name="radiance" value="1"/></emitter>)";
}

TEST(Mitsuba, ATransformBeforeALookAtTurnsTheCamerasUpAndMovesTheEyeAlone) {
    const tests::TemporaryFolder folder;
    const std::string look = R"(<lookat target="0,0,0" origin="90,0,0" up="0,1,0"/>)";
    const Camera turned = read(folder, sensor_of(R"(<rotate z="1" angle="90"/>)" + look)).camera;
    const Vec3 forward = glm::normalize(turned.target_mm - turned.eye_mm), up = glm::normalize(turned.up);
    EXPECT_LT(glm::distance(forward, Vec3(-1, 0, 0)), 1e-12);
    // Forward is -x and up was y, so that left, their cross product, is z; a quarter turn takes up to -left or left.
    EXPECT_NEAR(std::abs(up.z), 1, 1e-12);
    EXPECT_LT(glm::distance(turned.eye_mm, Vec3(900, 0, 0)), 1e-9);
    const Camera moved = read(folder, sensor_of(R"(<translate y="1"/>)" + look)).camera;
    EXPECT_LT(glm::distance(moved.eye_mm, Vec3(900, 10, 0)), 1e-9);
    EXPECT_LT(glm::distance(glm::normalize(moved.target_mm - moved.eye_mm), Vec3(-1, 0, 0)), 1e-12);
    const Camera after = read(folder, sensor_of(look + R"(<translate y="1"/>)")).camera;
    EXPECT_LT(glm::distance(after.target_mm, Vec3(0, 10, 0)), 1e-9);
}

TEST(Mitsuba, APerspectiveCameraWithAScaleIsRefused) {
    const tests::TemporaryFolder folder;
    EXPECT_THAT(refusal(folder, sensor_of(R"(<scale value="2"/><translate z="5"/>)")), HasSubstr("has a scale"));
    EXPECT_EQ(refusal(folder, sensor_of(R"(<rotate y="1" angle="30"/><translate z="5"/>)")), "was read");
}

TEST(Mitsuba, TwoElementsOfOneIdAreRefused) {
    const tests::TemporaryFolder folder;
    EXPECT_THAT(refusal(folder, std::string(camera) + R"(<bsdf type="diffuse" id="a"/><bsdf type="diffuse" id="a"/>)"),
                HasSubstr("has the id of another"));
}

TEST(Mitsuba, ATwoSidedRectangleWithABlackFrontShowsItsBack) {
    const tests::TemporaryFolder folder;
    const auto seen = [&](double angle) {
        const Scene s = read(
            folder, camera + fmt::format(R"(<shape type="rectangle"><transform name="toWorld"><rotate y="1" angle="{}"/>
<translate x="-10"/></transform><bsdf type="twosided"><bsdf type="diffuse"><spectrum name="reflectance" value="0"/></bsdf>
<bsdf type="diffuse"><spectrum name="reflectance" value="0.8"/></bsdf></bsdf></shape>)",
                                         angle));
        return std::get<Rgb>(std::get<Diffuse>(std::get<Quad>(s.objects.back().shape).surface).reflectance);
    };
    EXPECT_EQ(seen(90), Rgb(0));
    EXPECT_EQ(seen(-90), Rgb(0.8));
}

TEST(Mitsuba, AnEmittingCardSeenFromBehindNeedsNoLight) {
    const tests::TemporaryFolder folder;
    const Scene s = read(folder, std::string(camera) + R"(<shape type="rectangle"><transform name="toWorld">
<rotate y="1" angle="-90"/><translate x="-10"/></transform><emitter type="area"><spectrum name="radiance" value="1"/>
</emitter></shape>)");
    EXPECT_FALSE(needs(s).environment_on_diffuse);
    RenderJob job;
    job.scene = s;
    job.scene.camera.width_px = job.scene.camera.height_px = 1;
    job.sampling = Sampling::pixel_centres;
    EXPECT_EQ(trace(job).images.front().pixels.front(), Rgb(0));
}

TEST(Mitsuba, WhatChangesThePictureIsToldAsAChange) {
    const tests::TemporaryFolder folder;
    const std::string lit = std::string(camera) + R"(<shape type="rectangle"><transform name="toWorld">
<rotate y="1" angle="90"/><translate x="-10"/></transform></shape>)";
    EXPECT_EQ(changes_of(folder, camera), "");
    const std::string dome = changes_of(folder, lit);
    EXPECT_THAT(dome, HasSubstr("as 48 parallel lights"));
    EXPECT_THAT(dome, Not(HasSubstr("stops at glass")));
    EXPECT_THAT(changes_of(folder, lit + sphere(1, glass("1.5", "1"))), HasSubstr("stops at glass"));
    EXPECT_THAT(changes_of(folder, lit + lit.substr(lit.find("<shape"))), HasSubstr("throw on each other"));
    const auto integrator = [&](const char *inside) {
        return changes_of(folder, std::string(camera) + "<integrator type=\"path\">" + inside + "</integrator>");
    };
    EXPECT_EQ(integrator(""), "");
    EXPECT_EQ(integrator(R"(<integer name="maxDepth" value="-1"/>)"), "");
    EXPECT_THAT(integrator(R"(<integer name="maxDepth" value="4"/>)"), HasSubstr("maxDepth 4"));
    EXPECT_THAT(integrator(R"(<boolean name="hideEmitters" value="true"/>)"), HasSubstr("hideEmitters"));
}

TEST(Mitsuba, AMeshOfOneSideIsReadAsItIsSeen) {
    const tests::TemporaryFolder folder;
    // Before the eye at x = 900, in the plane x = -100: once round in either sense.
    std::ofstream(folder / "front.obj") << "v -10 -1 -1\nv -10 1 -1\nv -10 0 1\nf 1 2 3\n";
    std::ofstream(folder / "back.obj") << "v -10 -1 -1\nv -10 1 -1\nv -10 0 1\nf 1 3 2\n";
    const auto body = [&](const std::string &file, const std::string &more) {
        return camera + fmt::format(R"(<shape type="obj"><string name="filename" value="{}"/>{}</shape>)", file, more);
    };
    const std::string shines = R"(<emitter type="area"><spectrum name="radiance" value="1"/></emitter>)";
    const std::string flipped = R"(<boolean name="flipNormals" value="true"/>)";
    const auto is_seen = [&](const std::string &text) {
        const Surface &s = std::get<Mesh>(read(folder, text).objects.back().shape).surface;
        const auto *e = std::get_if<Emissive>(&s);
        return e && std::get<Rgb>(e->radiance) == Rgb(1);
    };
    EXPECT_TRUE(is_seen(body("front.obj", shines)));
    EXPECT_FALSE(is_seen(body("back.obj", shines)));
    EXPECT_FALSE(is_seen(body("front.obj", shines + flipped)));
    EXPECT_TRUE(is_seen(body("back.obj", shines + flipped)));
    EXPECT_EQ(changes_of(folder, body("back.obj", shines)), "");
    const std::string orbs = sphere(1, glass("1.5", "1"));
    EXPECT_EQ(changes_of(folder, body("front.obj", shines) + orbs), "");
    std::ofstream(folder / "both.obj") << "v 10 -2 -2\nv 10 3 -2\nv 10 0 3\nf 1 2 3\n";
    EXPECT_THAT(changes_of(folder, body("both.obj", shines) + orbs), HasSubstr("may be seen from both"));
    std::ofstream(folder / "bent.obj") << "v -10 -1 -1\nv -10 1 -1\nv -10 0 1\nv -12 1 1\nf 1 2 3\nf 2 4 3\n";
    EXPECT_THAT(changes_of(folder, body("bent.obj", "")), HasSubstr("is flat shaded"));
    EXPECT_THAT(changes_of(folder, body("bent.obj", R"(<boolean name="faceNormals" value="true"/>)")),
                Not(HasSubstr("is flat shaded")));
}

TEST(Mitsuba, ARepeatedPictureWhoseEdgesDifferIsToldAsAChange) {
    const tests::TemporaryFolder folder;
    const auto told = [&](std::vector<Rgb> pixels, const std::string &wrap) {
        Image image(2, 2);
        image.pixels = std::move(pixels);
        write_image(folder / "p.png", image);
        return changes_of(folder, camera + fmt::format(R"(<shape type="rectangle"><transform name="toWorld">
<rotate y="1" angle="90"/><translate x="-10"/></transform><bsdf type="diffuse"><texture type="bitmap" name="reflectance">
<string name="filename" value="p.png"/>{}</texture></bsdf></shape>)",
                                                       wrap));
    };
    const std::vector<Rgb> uneven{Rgb(0), Rgb(1), Rgb(0), Rgb(1)}, even(4, Rgb(0.5));
    EXPECT_THAT(told(uneven, ""), HasSubstr("is repeated in the file"));
    EXPECT_THAT(told(uneven, R"(<string name="wrapMode" value="clamp"/>)"), Not(HasSubstr("is repeated")));
    EXPECT_THAT(told(even, ""), Not(HasSubstr("is repeated")));
}

TEST(Mitsuba, OffersTheShadowsOfGlassThatRenderersCanDoAndNoOther) {
    const tests::TemporaryFolder folder;
    std::ofstream(folder / "scene.xml") << "<scene version=\"0.5.0\">" << camera << "</scene>";
    const SceneRecipe recipe = mitsuba_scene(folder / "scene.xml", [](const std::string &) {});
    const auto shadow = std::ranges::find(recipe.parameters, "glass.shadow", &ParameterSpec::name);
    ASSERT_NE(shadow, recipe.parameters.end());
    EXPECT_THAT(shadow->choices, ElementsAre("opaque", "none", "constant"));
}

TEST(Mitsuba, WhatOurOwnInstructionSaysAndCannotBeDoneIsRefused) {
    const auto refused = [](const std::string &instruction) {
        const tests::TemporaryFolder folder;
        std::ofstream(folder / "scene.xml")
            << "<?threefold " << instruction << "?><scene version=\"0.5.0\">" << camera << "</scene>";
        try {
            mitsuba_scene(folder / "scene.xml", [](const std::string &) {});
        } catch (const Error &error) {
            EXPECT_EQ(error.code(), Exit::bad_data);
            return std::string(error.what());
        }
        return std::string("was read");
    };
    EXPECT_THAT(refused("glass_shadow=\"caustic\""), HasSubstr("glass_shadow=\"caustic\"?>: no renderer can do this"));
    EXPECT_THAT(refused("glass_shadow=\"\""), HasSubstr("glass_shadow=\"\"?>"));
    EXPECT_THAT(refused("unit_mm=\"-1\""), HasSubstr("must be a number from 1e-09"));
    EXPECT_THAT(refused("dome_directions=\"many\""), HasSubstr("must be a number from 0 to 10000"));
    EXPECT_THAT(refused("unit_mm=10"), HasSubstr("cannot be read"));
    EXPECT_EQ(refused("unit_mm=\"10\" glass_shadow=\"none\""), "was read");
}

TEST(Mitsuba, HostileFilesAreAnsweredNotFollowed) {
    const tests::TemporaryFolder folder;
    EXPECT_THAT(refusal(folder, "<include filename=\"scene.xml\"/>"), HasSubstr("is it a loop?"));
    std::string deep, end;
    for (int i = 0; i < 5000; ++i) {
        deep += "<bsdf type=\"twosided\">";
        end += "</bsdf>";
    }
    EXPECT_THAT(refusal(folder, deep + end), HasSubstr("nested more than"));
    std::string longer = "<default name=\"a0\" value=\"xxxxxxxxxxxxxxxx\"/>";
    for (int i = 1; i < 20; ++i) longer += fmt::format("<default name=\"a{0}\" value=\"$a{1}$a{1}\"/>", i, i - 1);
    EXPECT_THAT(refusal(folder, longer), HasSubstr("longer than 4096"));
    EXPECT_THAT(refusal(folder, camera + std::string("<bsdf type=\"twosided\" id=\"x\"><ref id=\"x\"/></bsdf><shape "
                                                     "type=\"rectangle\"><ref id=\"x\"/></shape>")),
                HasSubstr("cannot be read"));
    EXPECT_THAT(refusal(folder, "<sensor"), HasSubstr("scene.xml:2:"));
    EXPECT_THAT(refusal(folder, "", "9.9"), HasSubstr("version"));
}

TEST(Mitsuba, EveryCatalogueSceneComesBackAsItWas) {
    for (const SceneRecipe &recipe : built_in_scenes()) {
        const tests::TemporaryFolder folder;
        const Scene scene = recipe.make(Parameters(recipe.parameters, Preset::published, file_reader()));
        write_mitsuba(scene, folder.path());
        const SceneRecipe back = mitsuba_scene(folder / "scene.xml");
        const Scene again = back.make(Parameters(back.parameters, Preset::text, file_reader()));
        validate(again);
        auto one = to_json(scene), two = to_json(again);
        ASSERT_EQ(one["objects"].size(), two["objects"].size()) << recipe.name;
        // Glass first: the reader puts orbs before what stands round them, and meshes come back in single precision.
        std::map<std::string, nlohmann::ordered_json> first, second;
        for (auto &o : one["objects"]) first[o["name"]] = o["shape"];
        for (auto &o : two["objects"]) second[o["name"]] = o["shape"];
        for (auto &[name, shape] : first) {
            ASSERT_TRUE(second.contains(name)) << recipe.name << " " << name;
            auto &other = second[name];
            if (shape.contains("mesh")) {
                EXPECT_EQ(shape["mesh"]["surface"], other["mesh"]["surface"]) << recipe.name << " " << name;
                EXPECT_GE(other["mesh"]["triangles"].get<int>(), shape["mesh"]["triangles"].get<int>() * 99 / 100);
                continue;
            }
            if (shape.contains("shell")) {
                EXPECT_NEAR(shape["shell"]["wall_mm"].get<double>(), other["shell"]["wall_mm"].get<double>(), 1e-12);
                other["shell"]["wall_mm"] = shape["shell"]["wall_mm"];
            }
            EXPECT_EQ(shape, other) << recipe.name << " " << name;
        }
        for (const char *key : {"name", "lights", "environment", "glass_shadow", "camera"})
            EXPECT_EQ(one[key], two[key]) << recipe.name;
        EXPECT_EQ(one.contains("dome_directions"), two.contains("dome_directions")) << recipe.name;
    }
}

TEST(Mitsuba, WhatItCannotSayIsALossAndNamesAreEscaped) {
    Scene scene;
    scene.name = "?><evil a=\"1\"/>";
    scene.objects = {{"a\"><b.$c", GlassBall{{0, 0, 0}, 60, {1.5, 1, Coating::antireflective}}},
                     {"a\"><b.$c", Quad{{0, 0, -200}, {50, 0, 0}, {0, 50, 0}, CoordinateCard{}}}};
    scene.environment = Environment{Rgb(1), 0};
    const tests::TemporaryFolder folder;
    const auto losses = write_mitsuba(scene, folder.path());
    EXPECT_TRUE(std::ranges::any_of(
        losses, [](const MitsubaLoss &l) { return l.changes_picture && l.what.find("coating") != std::string::npos; }));
    const SceneRecipe back = mitsuba_scene(folder / "scene.xml");
    const Scene again = back.make(Parameters(back.parameters, Preset::text, file_reader()));
    EXPECT_EQ(again.name, scene.name);
    EXPECT_EQ(again.objects.at(0).name, "a\"><b__c");
    EXPECT_TRUE(std::holds_alternative<CoordinateCard>(std::get<Quad>(again.objects.at(1).shape).surface));
}

class Elsewhere : public testing::Test {
protected:
    Elsewhere() {
        request.claims = {find_claim(built_in_claims(), "calibration")};
        request.scenes = built_in_scenes();
        request.quick = true;
        request.folder = folder / "run";
        for (const PlannedJob &planned : planned_jobs(request)) {
            const MitsubaJob asked = to_mitsuba_job(planned.job, planned.label);
            for (const ExportedFile &file : asked.files) write_file_atomically(pictures / file.name, file.bytes);
            const SceneRecipe back = mitsuba_scene(pictures / asked.files.front().name);
            RenderJob job;
            job.scene = back.make(Parameters(back.parameters, Preset::text, file_reader()));
            job.sampling = Sampling::pixel_centres;
            const Image image = trace(job, {}).images.front();
            for (const std::string &name : asked.pictures) write_image(pictures / name, image);
            names.insert(names.end(), asked.pictures.begin(), asked.pictures.end());
        }
        request.witnesses = {find_witnesses({"tracer"}).front(), witness_elsewhere("mitsuba", pictures.path())};
    }

    const tests::TemporaryFolder folder, pictures;
    CheckRequest request;
    std::vector<std::string> names;
};

TEST_F(Elsewhere, PicturesAreJudgedLikeThoseOfAnyRenderer) {
    const CheckOutcome outcome = check(request);
    EXPECT_EQ(outcome.exit, Exit::holds) << outcome.result.summary;
    EXPECT_EQ(std::ranges::count(outcome.result.claims.front().rows, "mitsuba", &Row::witness) > 0, true);
}

/// Surroundings of 1 seen through clear glass, but for one path in 1e8, which is lost in single precision.
TEST(MitsubaElsewhere, EnergyIsDecidedThoughOnePathInAHundredMillionIsLost) {
    const tests::TemporaryFolder folder, pictures;
    CheckRequest request;
    request.claims = {find_claim(built_in_claims(), "energy")};
    request.scenes = built_in_scenes();
    request.quick = true;
    request.folder = folder / "run";
    double paths = 0, lost = 0;
    std::vector<MitsubaJob> jobs;
    for (const PlannedJob &planned : planned_jobs(request)) {
        const MitsubaJob asked = to_mitsuba_job(planned.job, planned.label);
        jobs.push_back(asked);
        const bool calibration = planned.claim == "calibration";
        RenderJob finer = planned.job;
        if (calibration) {
            const SceneRecipe back = [&] {
                for (const ExportedFile &file : asked.files) write_file_atomically(pictures / file.name, file.bytes);
                return mitsuba_scene(pictures / asked.files.front().name);
            }();
            finer.scene = back.make(Parameters(back.parameters, Preset::text, file_reader()));
            finer.replicates = {{1, {0, 0}}};
        }
        Image image = calibration ? trace(finer, {}).images.front() : Image(asked.width_px, asked.height_px, Rgb(1));
        for (const std::string &name : asked.pictures) {
            if (!calibration) {
                paths += static_cast<double>(image.pixels.size()) * asked.samples_per_pixel;
                // Where the ring is thin and the middle part of a pixel is taken: the worst place that there is.
                for (; lost < paths / 1e8; ++lost)
                    image.at(asked.width_px / 2, asked.height_px / 2) -= Rgb(1.0 / asked.samples_per_pixel);
            }
            write_image(pictures / name, image);
            if (!calibration) image = Image(asked.width_px, asked.height_px, Rgb(1));
        }
    }
    EXPECT_GT(lost, 2);
    EXPECT_NEAR(samples_to_render(jobs), paths, 0.01 * paths);
    request.witnesses = {find_witnesses({"tracer"}).front(), witness_elsewhere("mitsuba", pictures.path())};
    const CheckOutcome outcome = check(request);
    EXPECT_EQ(outcome.exit, Exit::holds) << outcome.result.summary;
    EXPECT_GT(std::ranges::count(outcome.result.claims.back().rows, "mitsuba", &Row::witness), 0);

    request.least_replicates = 12; // these were not exported
    const CheckOutcome other = check(request);
    EXPECT_THAT(other.result.summary, HasSubstr("which was exported with other options"));
}

TEST(MitsubaElsewhere, MoreReplicatesAreExportedWhereTheyAreWanted) {
    CheckRequest request;
    request.claims = {find_claim(built_in_claims(), "energy")};
    request.scenes = built_in_scenes();
    request.quick = true;
    request.least_replicates = 46;
    for (const PlannedJob &planned : planned_jobs(request))
        EXPECT_EQ(planned.job.replicates.size(), 46u) << planned.label;
}

TEST_F(Elsewhere, WrongPicturesFailAndAMissingOrSmallOneIsNamed) {
    Image image = read_image(pictures / names.front(), Encoding::linear);
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width / 2; ++column)
            std::swap(image.at(column, row), image.at(image.width - 1 - column, row));
    for (const std::string &name : names) write_image(pictures / name, image);
    const CheckOutcome mirrored = check(request);
    EXPECT_EQ(mirrored.exit, Exit::fails);
    EXPECT_THAT(mirrored.result.claims.front().blamed, ElementsAre("mitsuba"));

    write_image(pictures / names[1], Image(5, 4));
    EXPECT_THAT(check(request).result.summary, testing::AllOf(HasSubstr(names[1]), HasSubstr("is 5 x 4 px, not")));
    fs::remove(pictures / names[1]);
    const CheckOutcome missing = check(request);
    EXPECT_EQ(missing.exit, Exit::undecided);
    EXPECT_THAT(missing.result.summary, HasSubstr(names[1] + " is missing"));
}

} // namespace
} // namespace threefold
