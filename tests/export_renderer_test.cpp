// SPDX-License-Identifier: MIT
// Exports in the real programs: what an artist opens is what the adapters render.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "exporter/blender/blend_file.h"
#include "exporter/blender/cycles.h"
#include "exporter/blender/glb_file.h"
#include "exporter/blender/run_script.h"
#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "exporter/povray/povray.h"
#include "exporter/povray/povray_folder.h"
#include "exporter/process/child.h"
#include "exporter/run.h"
#include "scenes/catalogue/catalogue.h"
#include "tests/catalogue_scene.h"
#include "tests/temporary_folder.h"

namespace threefold {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

Scene hollow(const std::string &wall_mm, const std::string &index = "1.51714", const std::string &size_px = "64") {
    return catalogue_scene(
        "hollow",
        {{"orb.wall_mm", wall_mm}, {"glass.index", index}, {"image.width_px", size_px}, {"image.height_px", size_px}});
}

ExportJob job_of(const Scene &scene, int samples) {
    ExportJob job;
    job.job.scene = scene;
    job.job.samples_per_pixel = samples;
    job.provenance.scene = scene.name;
    return job;
}

/// Mean and greatest distance of two pictures' pixels.
struct Difference {
    double mean = 0, greatest = 0;
};

Difference difference(const Image &a, const Image &b) {
    Difference d;
    EXPECT_EQ(a.pixels.size(), b.pixels.size());
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double one = std::abs(a.pixels[i][c] - b.pixels[i][c]);
            d.mean += one / (3 * static_cast<double>(a.pixels.size()));
            d.greatest = std::max(d.greatest, one);
        }
    return d;
}

class BlenderExport : public testing::Test {
protected:
    void SetUp() override {
        installed = find_renderer(cycles_adapter());
        if (!installed) GTEST_SKIP() << "Blender is not installed";
    }

    void write(const std::vector<ExportedFile> &files) {
        for (const ExportedFile &file : files) write_file_atomically(folder / file.name, file.bytes);
    }

    Image render_by_adapter(const RenderJob &job) {
        RunOptions options;
        options.folder = folder / "adapter";
        return run_exported(cycles_adapter(), *installed, compile_cycles(job), job, options).images.front();
    }

    /// Runs Python in a Blender that has the file open, as an artist's would: scripts in files switched off. The lines
    /// that the script printed after "said: ".
    std::string run_python(const std::string &python, const std::string &file = "") {
        write_file_atomically(folder / "script.py", python);
        std::string said;
        ChildRequest request;
        request.program = installed->program;
        request.folder = folder.path();
        request.arguments = {"-b", "--factory-startup", "--disable-autoexec", "-noaudio"};
        if (!file.empty()) request.arguments.push_back(folder / file);
        request.arguments.insert(request.arguments.end(),
                                 {"--python-exit-code", "3", "--python", (folder / "script.py").string()});
        request.on_line = [&](std::string_view line) {
            if (line.starts_with("said: ")) said += std::string(line.substr(6)) + "\n";
            log += std::string(line) + "\n";
        };
        const ChildResult result = run_child(request);
        EXPECT_EQ(result.describe(), "exit code 0") << log;
        return said;
    }

    std::optional<InstalledRenderer> installed;
    tests::TemporaryFolder folder;
    std::string log;
};

// `group.inputs` until 3.6, `interface` since; where the values of a modifier are kept has changed as often.
constexpr const char *live_orb = R"(
import bpy, math
scene = bpy.context.scene
orb = next(thing for thing in bpy.data.objects if thing.get("threefold") == "orb")
modifier = orb.modifiers["Glass orb"]
mm = scene.unit_settings.scale_length * 1000
group = modifier.node_group
sockets = group.inputs if hasattr(group, "inputs") else [s for s in group.interface.items_tree if s.in_out == "INPUT"]
names = {socket.name: socket.identifier for socket in sockets}
def turn(**values):
    for name, value in values.items():
        key = names[name.replace("_", " ")]
        if hasattr(modifier, "properties") and hasattr(modifier.properties, "inputs"):
            getattr(modifier.properties.inputs, key).value = value
        else:
            modifier[key] = value
    orb.update_tag()
def say_radii():
    mesh = orb.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    lengths = [math.hypot(*vertex.co) * mm for vertex in mesh.vertices]
    print("said: %d %.3f %.3f" % (len(lengths), min(lengths), max(lengths)), flush=True)
def render(name):
    if not hasattr(scene.cycles, "use_sample_subset"):  # the adapter's random numbers
        scene.cycles.sample_offset = 1 << (scene.cycles.samples - 1).bit_length()
    scene.render.filepath = name
    bpy.ops.render.render(write_still=True)
)";

TEST_F(BlenderExport, RendersWhatTheAdapterRenders) {
    ExportJob job = job_of(hollow("1.36"), 64);
    write(make_blend_file(job, *installed));
    run_python(std::string(live_orb) + fmt::format("render('{}')\n", (folder / "saved.exr").string()), "hollow.blend");
    const Difference d = difference(read_image(folder / "saved.exr"), render_by_adapter(job.job));
    // The same rays and random numbers; at the inner surface single precision rounds otherwise in one path of some.
    EXPECT_LT(d.mean, 5e-5);
    RecordProperty("mean", fmt::format("{:.3g}", d.mean));
}

TEST_F(BlenderExport, FollowsTheNumbersOfItsPanel) {
    write(make_blend_file(job_of(hollow("1.36"), 64), *installed));
    const std::string said =
        run_python(std::string(live_orb) + fmt::format(R"(
say_radii()
turn(Wall=2.72 / mm)
say_radii()
render('{}')
turn(Outer_radius=50 / mm, Wall=50 / mm)
say_radii()
turn(Outer_radius=68 / mm, Wall=1.36 / mm, Index=1.2)
render('{}')
turn(Hollow=False)
say_radii()
)",
                                                       (folder / "wall.exr").string(), (folder / "index.exr").string()),
                   "hollow.blend");
    EXPECT_EQ(said, "327684 66.641 68.001\n327684 65.281 68.001\n163842 50.000 50.000\n163842 68.001 68.001\n")
        << "vertices, least and greatest distance from the centre in mm: the triangles lie half inside the sphere";
    const Image wall = render_by_adapter(job_of(hollow("2.72"), 64).job);
    const Difference turned = difference(read_image(folder / "wall.exr"), wall);
    EXPECT_LT(turned.mean, 5e-5);
    RecordProperty("mean", fmt::format("{:.3g}", turned.mean));
    EXPECT_GT(difference(render_by_adapter(job_of(hollow("1.36"), 64).job), wall).mean, 1e-2);
    EXPECT_LT(
        difference(read_image(folder / "index.exr"), render_by_adapter(job_of(hollow("1.36", "1.2"), 64).job)).mean,
        5e-5);
}

TEST_F(BlenderExport, IsAFileThatAnArtistLikesToOpen) {
    Scene scene = hollow("1.36", "1.51714", "8");
    scene.name = scene.objects[1].name = "\"'''\\\n\0; import os; os.system('touch pwned')";
    scene.objects[1].name += "\xff";
    ExportJob job = job_of(scene, 1);
    job.job.surface_tolerance_mm = 1;
    const auto files = make_blend_file(job, *installed);
    write(files);
    const std::string said = run_python(R"(
import bpy
scene = bpy.context.scene
assert {"Orb", "Figure", "Cameras"} <= set(bpy.data.collections.keys()), bpy.data.collections.keys()
assert {"Glass, outer surface", "Glass, inner surface"} <= set(bpy.data.materials.keys())
assert scene.unit_settings.system == "METRIC" and scene.unit_settings.length_unit == "MILLIMETERS"
assert abs(scene.unit_settings.scale_length - 0.068) < 1e-8
assert scene.view_settings.view_transform == "Standard" and scene.view_settings.look == "None"
pictures = [image for image in bpy.data.images if image.source == "FILE"]
assert len(pictures) == 1 and pictures[0].packed_file and pictures[0].filepath.startswith("//")
assert "Made by Threefold" in bpy.data.texts["Threefold"].as_string()
assert scene.cycles.sample_offset == 0 or scene.cycles.use_sample_subset  # 4.5 and later render no samples otherwise
assert scene.camera.data.type == "PERSP" and scene.camera.data.lens == 50
assert not any(owner.animation_data for owner in list(bpy.data.objects) + list(bpy.data.materials))
views = [space.region_3d.view_perspective for screen in bpy.data.screens for area in screen.areas
         for space in area.spaces if space.type == "VIEW_3D"]
assert views and set(views) == {"CAMERA"}
print("said: good")
)",
                                        files.front().name);
    EXPECT_EQ(said, "good\n");
    EXPECT_FALSE(fs::exists(folder / "pwned"));
    EXPECT_FALSE(fs::exists("pwned"));
}

TEST_F(BlenderExport, GlbComesBackWithGlassCameraLightsAndTextures) {
    Scene scene = hollow("1.36");
    scene.lights = {{{0, -1, -1}, {2, 1, 0.5}}};
    scene.objects.push_back({"floor", Quad{{0, -100, 0}, {100, 0, 0}, {0, 0, -100}, Diffuse{}}});
    const auto files = make_glb_file(job_of(scene, 1), *installed);
    const std::string &glb = files.front().bytes;
    std::uint32_t length = 0;
    ASSERT_GT(glb.size(), 20u);
    std::copy_n(glb.data() + 12, 4, reinterpret_cast<char *>(&length));
    const auto json = nlohmann::json::parse(glb.substr(20, length));
    const auto &materials = json.at("materials"); // in an order that differs between versions
    const auto orb = std::ranges::find_if(materials, [](const auto &m) { return m.at("name") == "orb"; });
    ASSERT_NE(orb, materials.end());
    const auto &glass = orb->at("extensions");
    EXPECT_EQ(glass.at("KHR_materials_transmission").at("transmissionFactor"), 1);
    EXPECT_NEAR(glass.at("KHR_materials_ior").at("ior").get<double>(), 1.51714, 1e-6);
    EXPECT_NEAR(glass.at("KHR_materials_volume").at("thicknessFactor").get<double>(), 1.36e-3, 1e-9);
    const auto &light = json.at("extensions").at("KHR_lights_punctual").at("lights").at(0);
    EXPECT_EQ(light.at("type"), "directional");
    EXPECT_NEAR(light.at("intensity").get<double>(), 2, 1e-6);
    EXPECT_NEAR(light.at("color").at(2).get<double>(), 0.25, 1e-6);
    EXPECT_EQ(json.at("images").size(), 1u);
    EXPECT_EQ(json.at("cameras").at(0).at("type"), "perspective");
    EXPECT_NEAR(json.at("cameras").at(0).at("perspective").at("yfov").get<double>(),
                scene.camera.horizontal_fov_deg * M_PI / 180, 1e-6);
    write(files);
    EXPECT_EQ(run_python(fmt::format(R"(
import bpy, numpy
for old, new in (("bool", bool), ("int", int), ("float", float), ("object", object)):
    if old not in numpy.__dict__:
        setattr(numpy, old, new)
for thing in list(bpy.data.objects):
    bpy.data.objects.remove(thing)
bpy.ops.import_scene.gltf(filepath='{}')
kinds = sorted(thing.type for thing in bpy.data.objects)
size = next(thing for thing in bpy.data.objects if thing.name.startswith("orb")).dimensions
print("said:", kinds, ["%.5f" % x for x in size])
)",
                                     (folder / "hollow.glb").string())),
              "['CAMERA', 'LIGHT', 'MESH', 'MESH', 'MESH', 'MESH'] ['0.13600', '0.13600', '0.13600']\n");
}

TEST_F(BlenderExport, GlbIsWithoutErrorsByKhronosValidator) {
    const auto node = find_program("node");
    if (!node || !fs::exists(fs::path(THREEFOLD_NODE_FOLDER) / "node_modules/gltf-validator"))
        GTEST_SKIP() << "the Node package gltf-validator is not there; tools/test installs it";
    const std::vector<SceneRecipe> scenes = built_in_scenes();
    std::vector<std::string> names{"hollow", "solid", "salvator", "setup", "three-lines-bent"};
    for (const std::string &name : names) {
        const SceneRecipe &recipe = find_scene(scenes, name);
        Parameters values(recipe.parameters, Preset::text);
        if (values.has("robe.relief_resolution")) values.set("robe.relief_resolution", 50);
        const auto files = make_glb_file(job_of(recipe.make(values), 1), *installed);
        ASSERT_EQ(files.front().name, name + ".glb");
        write(files);
    }
    // The validator finds what is wrong in one that is.
    std::string broken = read_file(folder / "hollow.glb");
    const std::string factor = "\"transmissionFactor\":";
    ASSERT_NE(broken.find(factor), std::string::npos);
    broken[broken.find(factor) + factor.size()] = '9';
    write_file_atomically(folder / "broken.glb", broken);
    names.emplace_back("broken");

    ChildRequest request;
    request.program = *node;
    request.folder = folder.path();
    request.arguments = {"-e", R"(
const validator = require(require.resolve('gltf-validator', {paths: [process.argv[1]]}));
(async () => {
    for (const name of process.argv.slice(2)) {
        const bytes = new Uint8Array(require('fs').readFileSync(name + '.glb'));
        const issues = (await validator.validateBytes(bytes)).issues;
        for (const m of issues.messages) console.log(name, 'severity', m.severity, m.code, m.pointer);
        console.log(name + ': ' + issues.numErrors);
    }
})();)",
                         THREEFOLD_NODE_FOLDER};
    request.arguments.insert(request.arguments.end(), names.begin(), names.end());
    std::map<std::string, std::string> errors;
    request.on_line = [&](std::string_view line) {
        log += std::string(line) + "\n";
        if (const std::size_t colon = line.find(": "); colon != line.npos)
            errors[std::string(line.substr(0, colon))] = line.substr(colon + 2);
    };
    EXPECT_EQ(run_child(request).describe(), "exit code 0") << log;
    ASSERT_EQ(errors.size(), names.size()) << log;
    EXPECT_EQ(errors.at("broken"), "1");
    errors.erase("broken");
    for (const auto &[name, count] : errors) EXPECT_EQ(count, "0") << name << "\n" << log;
}

TEST(PovrayExport, PlainCommandGivesTheAdaptersPicture) {
    const auto installed = find_renderer(povray_adapter());
    if (!installed) GTEST_SKIP() << "POV-Ray is not installed";
    const tests::TemporaryFolder folder;
    const ExportJob job = job_of(hollow("1.36", "1.51714", "32"), 8);
    for (const ExportedFile &file : make_povray_folder(job)) write_file_atomically(folder / file.name, file.bytes);
    ChildRequest request;
    request.program = installed->program;
    request.folder = folder.path();
    request.arguments = {"scene.ini"};
    ASSERT_EQ(run_child(request).describe(), "exit code 0");
    RunOptions options;
    options.folder = folder / "adapter";
    const Exported exported = compile_povray(job.job);
    run_exported(povray_adapter(), *installed, exported, job.job, options);
    for (const std::string &name : exported.outputs)
        EXPECT_EQ(read_image(folder / name).pixels, read_image(options.folder / name).pixels) << name;
}

} // namespace
} // namespace threefold
