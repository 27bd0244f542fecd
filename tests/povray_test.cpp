// SPDX-License-Identifier: MIT
// What is written for POV-Ray, without running it. THREEFOLD_UPDATE_GOLDEN=1 rewrites povray_golden/*.pov.
#include "exporter/povray/povray.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exporter/recentre.h"
#include "scenes/error.h"

using namespace threefold;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

namespace {

Scene scene_of(std::vector<Object> objects) {
    Scene scene;
    scene.name = "test";
    scene.objects = std::move(objects);
    return scene;
}

const Quad card{
    .centre_mm = {0, 0, -200}, .half_u_mm = {150, 0, 0}, .half_v_mm = {0, 150, 0}, .surface = CoordinateCard{}};

RenderJob job_of(Scene scene) {
    RenderJob job;
    job.scene = std::move(scene);
    return job;
}

Quad painted(Surface surface) {
    Quad quad = card;
    quad.surface = std::move(surface);
    return quad;
}

void expect_refused(const RenderJob &job, const std::string &why) {
    try {
        compile_povray(job);
        FAIL() << "was not refused: " << why;
    } catch (const Error &error) {
        EXPECT_EQ(error.code(), Exit::bad_data);
        EXPECT_THAT(error.what(), HasSubstr(why));
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    }
}

std::string scene_text(const RenderJob &job) { return compile_povray(job).files.front().bytes; }

void expect_golden(const std::string &name, const RenderJob &job) {
    const std::string path = std::string(THREEFOLD_SOURCE_DIR "/tests/povray_golden/") + name + ".pov";
    const std::string text = scene_text(job);
    if (std::getenv("THREEFOLD_UPDATE_GOLDEN")) std::ofstream(path, std::ios::binary) << text;
    std::ostringstream golden;
    golden << std::ifstream(path, std::ios::binary).rdbuf();
    EXPECT_EQ(text, golden.str()) << path;
}

} // namespace

// ---------------------------------------------------------------------------------------------------------------------
// Frame

TEST(RenderFrame, stands_at_the_first_glass_and_finds_the_smallest_gap) {
    Scene scene = scene_of({{"card", card}, {"orb", GlassShell{.centre_mm = {0, 10, 0}, .glass = {}}}});
    const Frame frame = render_frame(scene);
    EXPECT_EQ(frame.origin_mm, Vec3(0, 10, 0));
    EXPECT_NEAR(frame.extent_mm, std::sqrt(900.0 * 900 + 10 * 10), 1e-9);
    EXPECT_EQ(frame.smallest_gap_mm, 1.36);

    scene.objects.back().shape = GlassBall{.centre_mm = {0, 0, -131.5}, .glass = {}};
    EXPECT_NEAR(render_frame(scene).smallest_gap_mm, 0.5, 1e-9);
    scene.objects.back().shape = GlassBall{.centre_mm = {0, 0, -132 - 1e-9}, .glass = {}}; // touches
    EXPECT_LT(render_frame(scene).smallest_gap_mm, 1e-8); // a backdrop that touches is a gap
    scene.objects.front().shape = Mesh{.vertices_mm = {{-150, -150, -200}, {150, -150, -200}, {0, 300, -200}},
                                       .triangles = {{0, 1, 2}},
                                       .uv = {},
                                       .surface = Emissive{}};
    EXPECT_EQ(render_frame(scene).smallest_gap_mm, 68); // a hand may
    scene.camera.eye_mm = {0, 0, -132 + 68 + 1e-6};
    EXPECT_NEAR(render_frame(scene).smallest_gap_mm, 1e-6, 2e-9); // an eye may not
    EXPECT_EQ(render_frame(scene).smallest_sphere_mm, 68);
}

TEST(RenderFrame, without_glass_stands_at_the_target) {
    Scene scene = scene_of({{"card", card}});
    scene.camera.target_mm = {1, 2, 3};
    EXPECT_EQ(render_frame(scene).origin_mm, Vec3(1, 2, 3));
    EXPECT_EQ(render_frame(scene).smallest_gap_mm, std::numeric_limits<double>::infinity());
}

// ---------------------------------------------------------------------------------------------------------------------
// Text

TEST(PovRayText, is_the_golden_one_for_a_card_behind_a_ball) {
    RenderJob job =
        job_of(scene_of({{"orb", GlassBall{.glass = {.coating = Coating::antireflective}}}, {"card", card}}));
    job.sampling = Sampling::pixel_centres;
    job.replicates = {{1, {0.25, -0.25}}};
    expect_golden("ball_and_card", job);
}

TEST(PovRayText, is_the_golden_one_for_a_lit_shell_with_a_grey_shadow) {
    Scene scene = scene_of({{"orb", GlassShell{.centre_mm = {10, 0, 0}, .wall_mm = 1.36, .glass = {1.51714, 0.89}}},
                            {"wall", painted(Diffuse{Rgb(0.25, 0.5, 0.75)})}});
    scene.lights = {{{1, -2, -2}, Rgb(3)}};
    scene.glass_shadow = {GlassShadow::Rule::constant, 0.25};
    scene.camera.crop = Crop{10, 20, 64, 32};
    RenderJob job = job_of(scene);
    job.replicates = {{1}, {2}, {3}};
    expect_golden("lit_shell", job);
}

TEST(PovRayText, is_the_golden_one_for_a_mesh_and_a_texture_seen_in_parallel) {
    const auto texture = std::make_shared<const Texture>(Texture{2, 1, {0, 1, 2, 30000, 40000, 50000}});
    const Mesh mesh{.vertices_mm = {{0, 0, 0}, {30, 0, 0}, {0, 30, 3}},
                    .triangles = {{0, 1, 2}},
                    .uv = {{0, 0}, {1, 0}, {0, 1}},
                    .surface = Emissive{texture}};
    Scene scene = scene_of({{"relief", mesh}, {"picture", painted(Emissive{texture})}});
    scene.environment = Environment{Rgb(0.1, 0.2, 2)};
    scene.camera.projection = Projection::orthographic;
    expect_golden("parallel_view", job_of(scene));
}

TEST(PovRayText, holds_names_as_one_line_of_ascii_in_a_comment) {
    RenderJob job = job_of(scene_of({{"a\"\n#include \"x\"\r*/\u2028\xff", card}}));
    job.scene.name = "\n#declare";
    const std::string text = scene_text(job);
    EXPECT_THAT(text, HasSubstr(R"(// "a\"\n#include \"x\"\r*/\u2028\ufffd")"));
    EXPECT_THAT(text, HasSubstr(R"(// "\n#declare")"));
    for (const char c : text) EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~'));
}

TEST(PovRayText, is_the_same_for_the_same_job) {
    RenderJob job = job_of(scene_of({{"card", card}}));
    job.replicates = {{7}, {8}};
    const std::string first = scene_text(job);
    EXPECT_EQ(first, scene_text(job));
    job.replicates[1].seed = 9;
    EXPECT_NE(first, scene_text(job));
}

// ---------------------------------------------------------------------------------------------------------------------
// Files, arguments, accuracy

TEST(PovRayExport, writes_a_texture_once) {
    const auto texture = std::make_shared<const Texture>(Texture{1, 1, {1, 2, 3}});
    const Exported exported =
        compile_povray(job_of(scene_of({{"a", painted(Emissive{texture})}, {"b", painted(Emissive{texture})}})));
    ASSERT_EQ(exported.files.size(), 2u);
    EXPECT_EQ(exported.files[1].name, "texture-0.png");
}

TEST(PovRayExport, names_the_pictures_as_povray_does) {
    RenderJob job = job_of(scene_of({{"card", card}}));
    job.sampling = Sampling::pixel_centres;
    EXPECT_THAT(compile_povray(job).outputs, ElementsAre("picture.png"));
    job.replicates.resize(10);
    const std::vector<std::string> names = compile_povray(job).outputs;
    EXPECT_EQ(names.front(), "picture01.png");
    EXPECT_EQ(names.back(), "picture10.png");
}

TEST(PovRayExport, takes_two_mirrored_pictures_for_a_mean_over_the_pixel) {
    RenderJob job = job_of(scene_of({{"card", card}}));
    job.replicates.resize(3);
    const Exported exported = compile_povray(job);
    EXPECT_EQ(exported.pictures_per_replicate, 2);
    EXPECT_EQ(exported.outputs.size(), 6u);
    EXPECT_THAT(exported.arguments, Contains("Final_Frame=6"));
}

TEST(PovRayExport, renders_a_square_of_samples_and_no_antialiasing) {
    RenderJob job = job_of(scene_of({{"card", card}}));
    job.samples_per_pixel = 10, job.threads = 3;
    job.scene.camera.width_px = 20, job.scene.camera.height_px = 30;
    const Exported exported = compile_povray(job);
    EXPECT_EQ(exported.supersampling, 3) << "two pictures of nine samples are the ten or more";
    for (const char *argument : {"Width=60", "Height=90", "Antialias=off", "File_Gamma=1.0"})
        EXPECT_THAT(exported.arguments, Contains(argument));
    EXPECT_THAT(exported.thread_arguments, testing::ElementsAre("Work_Threads=3"));
    EXPECT_THAT(exported.arguments, Contains("Final_Frame=2"));
}

TEST(PovRayExport, keeps_every_radiance_under_one) {
    Scene scene = scene_of({{"a", painted(Emissive{Rgb(1, 40, 3)})}});
    scene.environment = Environment{Rgb(7)};
    const Exported exported = compile_povray(job_of(scene));
    EXPECT_NEAR(exported.radiance_scale * 40, 65534.0 / 65535, 1e-15);
    EXPECT_DOUBLE_EQ(exported.accuracy.radiance_step, 0.5 / 65535 / exported.radiance_scale);
    EXPECT_EQ(exported.accuracy.cut_weight, 1e-6);
    EXPECT_EQ(compile_povray(job_of(scene_of({{"black", painted(Emissive{Rgb(0)})}}))).radiance_scale, 1);
}

// ---------------------------------------------------------------------------------------------------------------------
// Refusals

TEST(PovRayRefusals, name_a_wall_that_is_too_thin) {
    expect_refused(job_of(scene_of({{"orb", GlassShell{.wall_mm = 1e-6, .glass = {}}}})), "1e-06 mm");
    EXPECT_NO_THROW(compile_povray(job_of(scene_of({{"orb", GlassShell{.wall_mm = 2e-5, .glass = {}}}}))));
}

TEST(PovRayRefusals, name_a_radiance_that_is_lost_beside_the_brightest) {
    Scene scene = scene_of({{"lamp", painted(Emissive{Rgb(2e5)})}});
    scene.environment = Environment{Rgb(1)};
    expect_refused(job_of(scene), "a radiance of 1, which is in the scene too, would be wrong by up to 1.5");
    scene.objects = {{"lamp", painted(Emissive{Rgb(2e3)})}};
    EXPECT_NO_THROW(compile_povray(job_of(scene)));
    scene.environment = Environment{Rgb(0)};
    scene.objects = {{"lamp", painted(Emissive{Rgb(2e5)})}};
    EXPECT_NO_THROW(compile_povray(job_of(scene))) << "black stays black";
    // A surface that its light leaves dim beside a lamp.
    scene.objects.push_back({"wall", painted(Diffuse{.reflectance = Rgb(0.5)})});
    scene.lights = {{}};
    expect_refused(job_of(scene), "which is in the scene too");
}

TEST(PovRayRefusals, name_light_that_would_be_missing) {
    Scene scene = scene_of({{"orb", GlassBall{}}, {"wall", painted(Diffuse{})}});
    scene.lights = {{}};
    scene.glass_shadow.rule = GlassShadow::Rule::caustic;
    expect_refused(job_of(scene), "bends onto a diffuse surface");
    scene.glass_shadow.rule = GlassShadow::Rule::none;
    EXPECT_NO_THROW(compile_povray(job_of(scene)));
    scene.environment = Environment{Rgb(0.02)};
    expect_refused(job_of(scene), "environment's light on the diffuse surface \"wall\"");
    scene.environment->dome_directions = 48;
    EXPECT_NO_THROW(compile_povray(job_of(scene)));
}

TEST(PovRay, shares_many_lights_among_pictures_whose_mean_has_all) {
    Scene scene = scene_of({{"wall", painted(Diffuse{})}});
    scene.environment = Environment{Rgb(0.02), 400};
    scene.camera.width_px = scene.camera.height_px = 512;
    RenderJob job = job_of(scene);
    job.sampling = Sampling::box;
    job.samples_per_pixel = 16;
    const Exported exported = compile_povray(job);
    EXPECT_GT(exported.pictures_per_replicate, 2);
    EXPECT_EQ(exported.pictures_per_replicate % 2, 0) << "shifts come in mirrored pairs";
    EXPECT_GE(exported.pictures_per_replicate * exported.supersampling * exported.supersampling, 16);
    std::size_t lights = 0;
    const std::string &text = exported.files.front().bytes;
    for (std::size_t at = text.find("light_source"); at != std::string::npos; at = text.find("light_source", at + 1))
        ++lights;
    EXPECT_EQ(lights, 400u) << "each light is in one picture";
}

TEST(PovRayRefusals, name_a_uv_that_would_be_repeated) {
    expect_refused(job_of(scene_of({{"m", Mesh{.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                               .triangles = {{0, 1, 2}},
                                               .uv = {{0, 0}, {2, 0}, {0, 1}},
                                               .surface = CoordinateCard{}}}})),
                   "uv (2, 0)");
}

TEST(PovRayRefusals, name_a_number_that_is_not_finite) {
    Scene scene = scene_of({{"card", card}});
    scene.camera.film_offset_px.x = std::numeric_limits<double>::quiet_NaN();
    expect_refused(job_of(scene), "not finite");
}

// ---------------------------------------------------------------------------------------------------------------------
// What POV-Ray says

TEST(PovRayProgress, counts_pixels_within_the_replicate_that_was_last_begun) {
    Exported exported;
    exported.outputs = {"picture1.png", "picture2.png"};
    const auto progress = povray_adapter().progress;
    EXPECT_EQ(progress("Rendering frame 1 of 2", 0, exported), 0.0);
    EXPECT_EQ(progress("Rendered 25 of 100 pixels (25%)", 0, exported), 0.125);
    EXPECT_NEAR(*progress("Rendered 100 of 100 pixels (100%)", 0.125, exported), 0.5, 1e-3);
    EXPECT_NEAR(*progress("Rendered 100 of 100 pixels (100%)", 0.4995, exported), 0.5, 1e-3); // said twice
    EXPECT_EQ(progress("Rendering frame 2 of 2 (#2)", 0.4995, exported), 0.5);
    EXPECT_EQ(progress("Rendered 50 of 100 pixels (50%)", 0.5, exported), 0.75);
    EXPECT_EQ(progress("Rendered 100 of 100 pixels (100%)", 0.75, exported), 1.0);
    EXPECT_EQ(progress("Rendered 100 of 100 pixels (100%)", 1.0, exported), 1.0);
    for (const char *line : {"", "Rendered", "Rendered x of y", "Rendered 5 of 0 pixels", "Rendered 7 of 5 pixels",
                             "Rendering frame 0 of 2", "Rendered 99999999999999999999999 of 5", "Parse Time: 0"})
        EXPECT_EQ(progress(line, 0.3, exported), std::nullopt) << line;
}

TEST(PovRayMessages, tell_the_version_and_why_it_failed) {
    const Adapter adapter = povray_adapter();
    EXPECT_EQ(
        adapter.parse_version("povray: cannot open the user configuration file x\nPOV-Ray 3.7.0.10.unofficial\n\nThis"),
        "3.7.0.10.unofficial");
    EXPECT_EQ(adapter.parse_version("The POV-Ray Team"), "");
    EXPECT_EQ(adapter.explain_failure(
                  "==== [Parsing...] ====\nFile 'scene.pov' line 4: Parse Error: No matching } in 'x',\n"
                  " undeclared identifier 'y' found instead\nFatal error in parser: Cannot parse input.\n"),
              "File 'scene.pov' line 4: Parse Error: No matching } in 'x', undeclared identifier 'y' found instead");
    EXPECT_EQ(adapter.explain_failure("Rendered 5 of 7 pixels\rSegmentation fault"), "");
}
