// SPDX-License-Identifier: MIT
// The Blender script as text: what it says, what it refuses. Blender itself is not needed.
// THREEFOLD_UPDATE_GOLDEN=1 rewrites tests/cycles_golden.
#include "exporter/blender/cycles.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "exporter/blender/grazing.h"
#include "exporter/blender/icosphere.h"
#include "exporter/files.h"
#include "scenes/error.h"

using namespace threefold;
using testing::HasSubstr;

namespace {

constexpr std::string_view start_of_data = "SCENE = json.loads(r'''";

Quad card(Surface surface = CoordinateCard{}) {
    return {.centre_mm = {0, 0, -250}, .half_u_mm = {136, 0, 0}, .half_v_mm = {0, 136, 0}, .surface = surface};
}

RenderJob job_of(std::vector<Object> objects) {
    RenderJob job;
    job.scene.name = "test";
    job.scene.objects = std::move(objects);
    job.surface_tolerance_mm = 0.1; // small meshes
    return job;
}

RenderJob shell_before_card() { return job_of({{"orb", GlassShell{}}, {"card", card()}}); }

std::string generated(const RenderJob &job) {
    const std::string script = compile_cycles(job).files.front().bytes;
    return script.substr(script.find(start_of_data));
}

nlohmann::json data_of(const RenderJob &job) {
    std::string text = generated(job).substr(start_of_data.size());
    return nlohmann::json::parse(text.substr(0, text.find("'''")));
}

std::string refusal(const RenderJob &job) {
    try {
        compile_cycles(job);
    } catch (const Error &error) {
        EXPECT_EQ(error.code(), Exit::bad_data);
        return error.what();
    }
    return "";
}

void expect_golden(const std::string &name, const RenderJob &job) {
    const std::filesystem::path path = std::filesystem::path(THREEFOLD_SOURCE_DIR) / "tests/cycles_golden" / name;
    if (std::getenv("THREEFOLD_UPDATE_GOLDEN")) write_file_atomically(path, generated(job));
    EXPECT_EQ(generated(job), read_file(path));
}

TEST(CyclesScript, says_a_hollow_orb_before_the_coordinate_card) {
    RenderJob job = shell_before_card();
    std::get<GlassShell>(job.scene.objects[0].shape).glass.coating = Coating::antireflective;
    job.sampling = Sampling::pixel_centres;
    expect_golden("hollow_before_card.py", job);
}

TEST(CyclesScript, says_a_lit_robe_behind_a_ball_off_the_origin) {
    auto texture = std::make_shared<Texture>();
    *texture = {2, 1, {0, 1, 2, 3, 4, 65535}};
    Mesh hand;
    hand.vertices_mm = {{100, 0, 0}, {110, 0, 0}, {100, 10, 0}};
    hand.triangles = {{0, 1, 2}};
    hand.surface = Diffuse{Rgb(0.5, 0.25, 0.125)};
    RenderJob job = job_of({{"ball", GlassBall{{5, 6, 7}, 68, {1.6, 0.89, Coating::fresnel}}},
                            {"robe", card(Diffuse{std::shared_ptr<const Texture>(texture)})},
                            {"copy", card(Emissive{std::shared_ptr<const Texture>(texture)})},
                            {"hand", hand}});
    job.scene.lights = {{Vec3(1, -2, -2), Rgb(4, 2, 1)}, {Vec3(0, 0, -1), Rgb(0)}};
    job.scene.glass_shadow = {GlassShadow::Rule::constant, 0.64};
    job.scene.camera.crop = Crop{10, 20, 64, 32};
    job.scene.camera.film_offset_px = {0.25, 0};
    job.replicates = {{7, {0, 0}}, {std::uint64_t{1} << 33, {0, -0.5}}};
    job.threads = 2;
    expect_golden("lit_robe.py", job);
    const Exported exported = compile_cycles(job);
    std::vector<std::string> names;
    for (const ExportedFile &file : exported.files) names.push_back(file.name);
    EXPECT_THAT(names, testing::ElementsAre("scene.py", "icosphere_4.bin", "texture_1.png", "mesh_1.bin"));
    EXPECT_THAT(exported.outputs, testing::ElementsAre("render_0001.exr", "render_0002.exr"));
}

TEST(CyclesScript, says_a_bright_emitter_in_parallel_projection_without_glass) {
    RenderJob job = job_of({{"lamp", card(Emissive{Rgb(5, 2.5, 0)})}});
    job.scene.camera.projection = Projection::orthographic;
    job.scene.environment = Environment{Rgb(0.1, 0.2, 0.3)};
    expect_golden("bright_emitter.py", job);
}

TEST(CyclesScript, is_a_pure_function_of_the_job) {
    EXPECT_EQ(compile_cycles(shell_before_card()).files.front().bytes,
              compile_cycles(shell_before_card()).files.front().bytes);
}

TEST(CyclesScript, keeps_every_name_inside_its_string) {
    for (const std::string name :
         {"'''); import os #", "\\'''\\", "a\nb\rc", "\xff\xfe", "\u7403\u2028", "\x7f\x01", "{}%s"}) {
        RenderJob job = shell_before_card();
        job.scene.name = job.scene.objects[0].name = name;
        const std::string script = generated(job);
        EXPECT_EQ(script.find("'''", start_of_data.size()), script.find("\n}''')\n\nmain(SCENE)\n") + 2);
        for (const char c : script) EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '\x7f')) << static_cast<int>(c);
        if (name != "\xff\xfe") {
            EXPECT_EQ(data_of(job)["objects"][0]["name"], name);
        }
    }
}

TEST(CyclesScript, puts_the_orb_at_the_origin_wherever_it_was) {
    RenderJob near_origin = shell_before_card(), far_off = near_origin;
    const Vec3 offset(4096, -8192, 1024); // exact in binary
    std::get<GlassShell>(far_off.scene.objects[0].shape).centre_mm += offset;
    std::get<Quad>(far_off.scene.objects[1].shape).centre_mm += offset;
    far_off.scene.camera.eye_mm += offset;
    far_off.scene.camera.target_mm += offset;
    auto a = data_of(near_origin), b = data_of(far_off);
    b["origin_mm"] = a["origin_mm"];
    EXPECT_EQ(a, b);
}

TEST(CyclesScript, folds_seeds_into_31_bits_and_leaves_small_ones) {
    RenderJob job = shell_before_card();
    job.replicates = {{1, {}}, {0x7fffffff, {}}, {~std::uint64_t{0}, {}}, {std::uint64_t{5} << 40, {}}};
    const auto replicates = data_of(job)["replicates"];
    EXPECT_EQ(replicates[0]["seed"], 1);
    EXPECT_EQ(replicates[1]["seed"], 0x7fffffff);
    for (const auto &replicate : replicates) EXPECT_LE(replicate["seed"], 0x7fffffff);
    EXPECT_NE(replicates[3]["seed"], 0);
}

TEST(CyclesScript, takes_one_sample_at_pixel_centres_where_nothing_is_random) {
    RenderJob job = shell_before_card();
    job.sampling = Sampling::pixel_centres;
    EXPECT_EQ(data_of(job)["sampling"]["samples"], 16);
    EXPECT_GT(compile_cycles(job).accuracy.filter_px, 0);
    std::get<GlassShell>(job.scene.objects[0].shape).glass.coating = Coating::antireflective;
    EXPECT_EQ(data_of(job)["sampling"]["samples"], 1);
    EXPECT_EQ(compile_cycles(job).accuracy.filter_px, 0);
}

TEST(CyclesScript, refuses_a_wall_too_thin_for_single_precision) {
    RenderJob job = shell_before_card();
    GlassShell &shell = std::get<GlassShell>(job.scene.objects[0].shape);
    shell.wall_mm = 1e-3;
    EXPECT_EQ(refusal(job), "");
    shell.wall_mm = 1e-4;
    EXPECT_EQ(refusal(job),
              "Cycles: the thinnest wall or gap of the glass is 0.0001 mm; at 68 mm from the orb's centre "
              "single precision needs at least 0.000811 mm");
}

TEST(CyclesScript, refuses_what_it_cannot_say_exactly) {
    RenderJob job = shell_before_card();
    job.surface_tolerance_mm = 1e-5;
    EXPECT_THAT(refusal(job), HasSubstr("cannot be meshed to 1e-05 mm: its finest mesh strays by 0.000"));

    job = shell_before_card();
    job.scene.objects.push_back({"second", GlassBall{{700, 0, 0}, 10, {}}});
    EXPECT_THAT(refusal(job), HasSubstr("lies 700 mm from the first one"));

    job = job_of({{"orb", GlassBall{}}, {"wall", card(Diffuse{})}});
    job.scene.environment = Environment{Rgb(1)};
    EXPECT_THAT(refusal(job), HasSubstr("environment's light on a diffuse surface would be an integral"));
    job.scene.environment->dome_directions = 48;
    EXPECT_NO_THROW(compile_cycles(job));
    job.scene.environment.reset();
    job.scene.lights = {Directional{}};
    job.scene.glass_shadow.rule = GlassShadow::Rule::caustic;
    EXPECT_THAT(refusal(job), HasSubstr("caustics through glass are not supported"));

    job = shell_before_card();
    job.sampling = Sampling::box;
    job.samples_per_pixel = (1 << 24) + 1;
    EXPECT_THAT(refusal(job), HasSubstr("16777217 samples per pixel are more than the 16777216"));

    Mesh bare;
    bare.vertices_mm = {{0, 0, -100}, {1, 0, -100}, {0, 1, -100}};
    bare.triangles = {{0, 1, 2}};
    bare.surface = CoordinateCard{};
    EXPECT_THAT(refusal(job_of({{"bare", bare}})), HasSubstr("\"bare\" needs texture coordinates"));

    job = shell_before_card();
    job.scene.camera.horizontal_fov_deg = 0.01;
    EXPECT_THAT(refusal(job), HasSubstr("beyond Blender's lenses"));
}

TEST(CyclesScript, refuses_a_film_smaller_than_blenders) {
    RenderJob job = shell_before_card();
    job.scene.camera.width_px = 3;
    job.scene.camera.height_px = 64;
    EXPECT_THAT(refusal(job), HasSubstr("3 x 64 pixels"));
    job.scene.camera.width_px = 4;
    EXPECT_EQ(refusal(job), "");
}

TEST(Icosphere, stays_as_near_to_the_sphere_as_it_says) {
    for (int level = 0; level <= 5; ++level) {
        const Icosphere sphere = make_icosphere(level);
        const IcosphereFit fit = fit_icosphere(level);
        EXPECT_EQ(sphere.triangles.size(), 20u << (2 * level));
        EXPECT_EQ(sphere.vertices.size(), (10u << (2 * level)) + 2);
        double nearest = 1, volume = 0;
        for (const glm::uvec3 &t : sphere.triangles) {
            const Vec3 a = sphere.vertices[t.x], b = sphere.vertices[t.y], c = sphere.vertices[t.z];
            const double six_volumes = glm::dot(a, glm::cross(b, c));
            volume += six_volumes / 6;
            nearest = std::min(nearest, six_volumes / glm::length(glm::cross(b - a, c - a)));
        }
        EXPECT_NEAR(fit.scale * nearest, 1 - fit.distance, 1e-12); // the deepest triangle ...
        EXPECT_NEAR(fit.scale, 1 + fit.distance, 1e-12);           // ... is as far inside as the corners are outside
        EXPECT_NEAR(volume, 4 * M_PI / 3, 20 * fit.distance);      // and every triangle faces outwards
        EXPECT_GT(volume, 0);
    }
    EXPECT_EQ(coarsest_icosphere(1e-3 / 68)->level, 7);
    EXPECT_FALSE(coarsest_icosphere(1e-7));
}

// A camera along an axis has its middle row of pixels in such a plane.
TEST(Icosphere, has_no_edge_in_a_plane_of_two_axes) {
    const Icosphere sphere = make_icosphere(5);
    for (const glm::uvec3 &t : sphere.triangles)
        for (int corner = 0; corner < 3; ++corner)
            for (int axis = 0; axis < 3; ++axis) {
                const double a = sphere.vertices[t[corner]][axis], b = sphere.vertices[t[(corner + 1) % 3]][axis];
                EXPECT_GT(std::max(std::abs(a), std::abs(b)), 1e-5);
            }
}

TEST(Grazing, is_told_by_the_share_of_rays_and_refused) {
    RenderJob job;
    job.scene.objects = {{"orb", GlassBall{Vec3(0), 68, {}}}};
    job.scene.environment = Environment{Rgb(1)};
    Camera &c = job.scene.camera;
    c.projection = Projection::orthographic;
    c.width_px = c.height_px = 10;
    const auto look_at = [&](double from_mm, double to_mm) {
        c.eye_mm = {(from_mm + to_mm) / 2, 0, 900};
        c.target_mm = {(from_mm + to_mm) / 2, 0, 0};
        c.orthographic_width_mm = to_mm - from_mm;
    };
    EXPECT_DOUBLE_EQ(grazing_mm(68, 1e-3), 0.0108);
    // Of ten columns the band to either side of the edge holds six.
    look_at(68 - 0.02, 68 + 0.02);
    EXPECT_NEAR(grazing_share(job.scene, 1e-3), 0.6, 1e-12);
    EXPECT_THROW(compile_cycles(job), Error);
    look_at(68 - 0.06, 68 - 0.02);
    EXPECT_EQ(grazing_share(job.scene, 1e-3), 0);
    EXPECT_NO_THROW(compile_cycles(job));
}

TEST(CyclesLog, tells_the_share_done) {
    const auto progress = cycles_adapter().progress;
    Exported exported;
    exported.outputs = {"1", "2"};
    EXPECT_EQ(progress("threefold replicate 2 of 2", 0.4, exported), 0.5);
    EXPECT_EQ(progress("threefold done", 0.9, exported), 1.0);
    EXPECT_NEAR(*progress("Fra:1 Mem:9.5M | Scene | Sample 32/64", 0.5, exported), 0.75, 1e-3);
    const auto full = progress("Fra:1 Mem:9.5M | Scene | Sample 64/64", 0.2, exported);
    EXPECT_LT(*full, 0.5);
    EXPECT_EQ(progress("Fra:1 Mem:9.5M | Scene | Sample 64/64", *full, exported), full); // said twice
    for (const char *line :
         {"", "Sample", "Sample 1", "Sample 3/0", "Sample x/2", "threefold replicate", "Blender quit"})
        EXPECT_EQ(progress(line, 0, exported), std::nullopt) << line;
}

TEST(CyclesLog, finds_version_and_failure) {
    const Adapter adapter = cycles_adapter();
    EXPECT_EQ(adapter.parse_version("Blender 3.4.1\n\tbuild date: 2022"), "3.4.1");
    EXPECT_EQ(adapter.parse_version("Blender 5.2.2 LTS"), "5.2.2");
    EXPECT_EQ(adapter.parse_version("nothing"), "");
    EXPECT_EQ(adapter.explain_failure("Traceback (most recent call last):\n  File \"x\", line 1\n"
                                      "RuntimeError: Blender did not build what was asked: the radius of a sphere\n"
                                      "Error: script failed, expr: 'import', exiting.\n"),
              "RuntimeError: Blender did not build what was asked: the radius of a sphere");
    EXPECT_EQ(adapter.explain_failure("Error: Cannot write to file\r\nBlender quit\n"), "Error: Cannot write to file");
    EXPECT_EQ(adapter.explain_failure("all is well: really"), "");
}

} // namespace
