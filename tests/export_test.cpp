// SPDX-License-Identifier: MIT
// Exports that need no other program: OBJ, POV-Ray's folder, STMap, lists of losses, and the folder they go to.
#include "exporter/export/delivery.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exporter/export/losses.h"
#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "exporter/mesh/mesh_file.h"
#include "exporter/mesh/obj_file.h"
#include "exporter/povray/povray_folder.h"
#include "scenes/error.h"
#include "tests/catalogue_scene.h"
#include "tests/temporary_folder.h"
#include "verifier/optics/transmitted_ray.h"
#include "verifier/stmap/stmap.h"

namespace threefold {
namespace {

using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
namespace fs = std::filesystem;

ExportJob job_of(Scene scene) {
    ExportJob job;
    job.provenance.scene = scene.name;
    job.job.scene = std::move(scene);
    return job;
}

void write_all(const tests::TemporaryFolder &folder, const std::vector<ExportedFile> &files) {
    for (const ExportedFile &file : files) write_file_atomically(folder / file.name, file.bytes);
}

std::string bytes_of(const std::vector<ExportedFile> &files, const std::string &name) {
    for (const ExportedFile &file : files)
        if (file.name == name) return file.bytes;
    ADD_FAILURE() << name << " is missing";
    return {};
}

Error refusal(const std::function<void()> &call) {
    try {
        call();
    } catch (const Error &error) {
        return error;
    }
    ADD_FAILURE() << "nothing was refused";
    return Error(Exit::holds, "");
}

// ---------------------------------------------------------------------------------------------------------------------

TEST(ObjExport, ReadsBackWithTheBoundsOfTheScene) {
    Scene scene = catalogue_scene("hollow", {{"orb.shift_mm", "12.5"}, {"card.half_width_mm", "60"}});
    const tests::TemporaryFolder folder;
    write_all(folder, make_obj_files(job_of(scene)));
    const Mesh mesh = read_mesh(folder / "hollow.obj");
    Vec3 least(1e300), greatest(-1e300);
    for (const Vec3 &v : mesh.vertices_mm) {
        least = glm::min(least, v);
        greatest = glm::max(greatest, v);
    }
    // The card to the left, below and behind; the orb to the right and before.
    EXPECT_NEAR(least.x, -60, 60e-5);
    EXPECT_NEAR(least.y, -68, 68 * 1e-4 + 68e-5); // facets stray by a tenth of a thousandth of the radius
    EXPECT_NEAR(least.z, -250, 250e-5);
    EXPECT_NEAR(greatest.x, 12.5 + 68, 68 * 1e-4 + 68e-5);
    EXPECT_NEAR(greatest.z, 68, 68 * 1e-4 + 68e-5);
    EXPECT_EQ(mesh.triangles.size(), 2u * 81920 + 2);
}

TEST(ObjExport, IsReadBackToSinglePrecision) {
    Scene scene = catalogue_scene("calibration");
    Mesh triangle;
    triangle.vertices_mm = {{-123.456789, 7.25, -1e4 / 3}, {1e-3 / 7, 99.999, 0}, {3, -4, 5.0 / 7}};
    triangle.triangles = {{0, 1, 2}};
    scene.objects = {{"t", triangle}};
    const tests::TemporaryFolder folder;
    write_all(folder, make_obj_files(job_of(scene)));
    const Mesh mesh = read_mesh(folder / "calibration.obj");
    ASSERT_EQ(mesh.vertices_mm.size(), 3u);
    for (const Vec3 &wanted : triangle.vertices_mm) {
        double nearest = 1e300;
        for (const Vec3 &v : mesh.vertices_mm) nearest = std::min(nearest, glm::distance(v, wanted));
        EXPECT_LE(nearest, 1e-6 * glm::length(wanted));
    }
}

TEST(ObjExport, SaysGlassLightAndTexturesOfItsMaterials) {
    Scene scene = catalogue_scene("hollow", {{"glass.index", "1.6"}, {"glass.interface_transmittance", "0.5"}});
    const auto files = make_obj_files(job_of(scene));
    const std::string mtl = bytes_of(files, "hollow.mtl");
    EXPECT_THAT(mtl, HasSubstr("Ni 1.6\nTf 0.5 0.5 0.5\nd 1\nillum 7"));
    EXPECT_THAT(mtl, HasSubstr("Ke 1 1 1\nmap_Ke hollow-texture-1.png"));
    EXPECT_EQ(bytes_of(files, "hollow-texture-1.png").substr(1, 3), "PNG");
}

TEST(ObjExport, KeepsAHostileNameInOneWord) {
    Scene scene = catalogue_scene("calibration");
    const Quad quad{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Diffuse{}};
    scene.objects = {{"a\nmtllib /etc/passwd\n#", quad}, {"a\nmtllib /etc/passwd\n#", quad}, {"", quad}};
    ExportJob job = job_of(scene);
    job.provenance.scene = "../..//x\n\"$(touch y)";
    const auto files = make_obj_files(job);
    for (const ExportedFile &file : files) {
        EXPECT_EQ(file.name.find_first_of("/\n\"$ "), std::string::npos) << file.name;
        EXPECT_FALSE(file.name.starts_with("."));
        EXPECT_THAT(file.bytes, Not(HasSubstr("\nmtllib /etc")));
    }
    const std::string obj = bytes_of(files, job.stem() + ".obj");
    EXPECT_THAT(obj, HasSubstr("o a_mtllib__etc_passwd___1\n"));
    EXPECT_THAT(obj, HasSubstr("o object_3\n"));
}

TEST(ObjExport, RefusesTheProbe) {
    const Error error = refusal([] {
        make_obj_files(job_of(catalogue_scene("hollow", {{"card.surface", "coordinate"}})));
    });
    EXPECT_EQ(error.code(), Exit::bad_data);
    EXPECT_THAT(error.what(), HasSubstr("coordinate card \"card\""));
    EXPECT_THAT(error.hint(), HasSubstr("stmap"));
}

// ---------------------------------------------------------------------------------------------------------------------

TEST(PovrayExport, HasTheOptionsInAFileAndTheCommandInAnother) {
    const auto files = make_povray_folder(job_of(catalogue_scene("hollow")));
    const std::string ini = bytes_of(files, "scene.ini"), readme = bytes_of(files, "README.txt");
    for (const char *option : {"Input_File_Name=scene.pov\n", "File_Gamma=1.0\n", "Antialias=off\n", "Final_Frame=2\n"})
        EXPECT_THAT(ini, HasSubstr(option));
    EXPECT_THAT(readme, HasSubstr("povray scene.ini"));
    EXPECT_THAT(readme, HasSubstr("oiiotool picture1.png -d float picture2.png -d float --add"));
}

// ---------------------------------------------------------------------------------------------------------------------

TEST(StmapExport, SaysWhereTheClosedFormLands) {
    Scene scene = catalogue_scene("hollow", {{"image.width_px", "40"}, {"image.height_px", "30"}});
    RenderJob job;
    job.scene = scene;
    const Image map = stmap(job, stmap_target(scene, ""));
    const GlassShell &shell = std::get<GlassShell>(scene.objects[0].shape);
    const Quad &card = std::get<Quad>(scene.objects[1].shape);
    const auto orb = optics::shell(shell.outer_radius_mm, shell.wall_mm, shell.glass.index);
    int inside = 0, outside = 0;
    for (int row = 0; row < map.height; ++row)
        for (int column = 0; column < map.width; ++column) {
            Ray ray = camera_ray(scene.camera, {column + 0.5, row + 0.5});
            const double impact_mm = glm::length(glm::cross(ray.origin_mm - shell.centre_mm, ray.direction));
            if (impact_mm < 0.95 * shell.outer_radius_mm) {
                ray = optics::transmitted_ray(orb, shell.centre_mm, ray).value();
                ++inside;
            } else if (impact_mm > shell.outer_radius_mm) {
                ++outside;
            } else {
                continue;
            }
            const double t = (card.centre_mm.z - ray.origin_mm.z) / ray.direction.z;
            const Vec3 at = ray.origin_mm + t * ray.direction;
            EXPECT_EQ(map.at(column, row).b, 1);
            EXPECT_NEAR(map.at(column, row).r, (at.x / card.half_u_mm.x + 1) / 2, 1e-9); // right
            EXPECT_NEAR(map.at(column, row).g, (at.y / card.half_v_mm.y + 1) / 2, 1e-9); // up
        }
    EXPECT_GT(inside, 300);
    EXPECT_GT(outside, 300);
}

TEST(StmapExport, IsTheSameFileInFloatAndIn16Bits) {
    Scene scene =
        catalogue_scene("hollow", {{"image.width_px", "24"}, {"image.height_px", "16"}, {"card.half_width_mm", "70"}});
    const tests::TemporaryFolder folder;
    write_all(folder, make_stmap_files(job_of(scene), "card"));
    const Image exr = read_image(folder / "hollow-stmap.exr"), png = read_image(folder / "hollow-stmap.png");
    int on = 0, off = 0;
    for (std::size_t i = 0; i < exr.pixels.size(); ++i) {
        (exr.pixels[i].b == 1 ? on : off) += 1;
        if (exr.pixels[i].b == 0) {
            EXPECT_EQ(exr.pixels[i], Rgb(0)) << "nothing lands there";
        }
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(exr.pixels[i][c], png.pixels[i][c], 0.6 / 65535);
    }
    EXPECT_GT(on, 100);
    EXPECT_GT(off, 50);
}

TEST(StmapExport, AsksForASurfaceWhereThereAreSeveral) {
    const Scene scene = catalogue_scene("salvator", {{"robe.relief_resolution", "20"}});
    const Error error = refusal([&] { stmap_target(scene, ""); });
    EXPECT_EQ(error.code(), Exit::usage);
    EXPECT_THAT(error.what(), HasSubstr("hand, robe"));
    EXPECT_THAT(error.hint(), HasSubstr("--onto"));
    EXPECT_THAT(refusal([&] { stmap_target(scene, "rob"); }).what(), HasSubstr("did you mean 'robe'"));
    EXPECT_EQ(stmap_target(scene, "robe"), "robe");
    EXPECT_EQ(refusal([] { stmap_target(catalogue_scene("furnace"), ""); }).code(), Exit::bad_data);
}

// ---------------------------------------------------------------------------------------------------------------------

TEST(Losses, AreThoseOfTheSceneAtHand) {
    const Scene plain = catalogue_scene("hollow"),
                figure = catalogue_scene("salvator", {{"robe.relief_resolution", "20"}});
    EXPECT_THAT(losses(plain, ExportFormat::glb), Each(Not(HasSubstr("shadow"))));
    EXPECT_THAT(losses(figure, ExportFormat::glb), testing::Contains(HasSubstr("rule for shadows of glass")));
    EXPECT_THAT(losses(figure, ExportFormat::glb), testing::Contains(HasSubstr("dome of lights")));
    EXPECT_THAT(losses(figure, ExportFormat::obj), testing::Contains(HasSubstr("102 parallel")));
    EXPECT_THAT(losses(catalogue_scene("tint"), ExportFormat::glb),
                testing::Contains(HasSubstr("on light at each surface")));
    EXPECT_THAT(losses(catalogue_scene("hollow", {{"glass.coating", "antireflective"}}), ExportFormat::glb),
                testing::Contains(HasSubstr("antireflective coating of \"orb\"")));
    Scene cropped = plain;
    cropped.camera.crop = Crop{1, 2, 3, 4};
    EXPECT_THAT(losses(cropped, ExportFormat::glb), testing::Contains(HasSubstr("window of the film")));
    for (const ExportFormat exact : {ExportFormat::blender, ExportFormat::povray}) {
        EXPECT_THAT(losses(figure, exact), IsEmpty());
        EXPECT_THAT(losses_text({}, exact), HasSubstr("Nothing is lost"));
    }
}

TEST(Losses, KeepAHostileNameOnOneLine) {
    Scene scene = catalogue_scene("hollow", {{"glass.coating", "antireflective"}});
    scene.objects[0].name = "orb\n- nothing is lost\x1b[2J";
    for (const std::string &loss : losses(scene, ExportFormat::glb))
        EXPECT_EQ(loss.find_first_of("\n\x1b"), std::string::npos) << loss;
}

// ---------------------------------------------------------------------------------------------------------------------

TEST(Provenance, KeepsEveryValueOnItsLine) {
    const std::string text = to_text({"x\nexport_command: rm",
                                      "text",
                                      {{"robe.texture", "a\nb"}, {"hand.mesh", ""}},
                                      "hash",
                                      "1",
                                      "threefold export x",
                                      "threefold render x"});
    EXPECT_THAT(text, HasSubstr("scene        x export_command: rm\n"));
    EXPECT_THAT(text, HasSubstr("  robe.texture = a b\n"));
    EXPECT_THAT(text, HasSubstr("  hand.mesh = (generated)\n"));
}

TEST(FreshFolder, IsMadeWithItsFilesOrNotAtAll) {
    const tests::TemporaryFolder folder;
    write_fresh_folder(folder / "a/b/", {{"one.txt", "1"}, {"two.txt", "2"}});
    EXPECT_EQ(read_file(folder / "a/b/two.txt"), "2");
    // The second cannot be written: its name is longer than names can be.
    EXPECT_EQ(refusal([&] {
                  write_fresh_folder(folder / "c/d", {{"one", "1"}, {std::string(300, 'x'), "2"}});
              }).code(),
              Exit::input_output);
    EXPECT_FALSE(fs::exists(folder / "c"));
    fs::create_directory(folder / "e");
    EXPECT_EQ(refusal([&] {
                  write_fresh_folder(folder / "e", {{"one", "1"}, {"../two", "2"}});
              }).code(),
              Exit::internal);
    EXPECT_TRUE(fs::is_empty(folder / "e")) << "it was there before, and stays";
}

TEST(FreshFolder, RefusesWhatIsNotEmptyOrNoFolder) {
    const tests::TemporaryFolder folder;
    write_file_atomically(folder / "mine.txt", "mine");
    EXPECT_THAT(refusal([&] { require_fresh_folder(folder.path()); }).what(), HasSubstr("not empty"));
    EXPECT_THAT(refusal([&] { require_fresh_folder(folder / "mine.txt"); }).what(), HasSubstr("is not a folder"));
    EXPECT_THAT(refusal([&] { require_fresh_folder(folder / "mine.txt/x"); }).what(), HasSubstr("is not a folder"));
    EXPECT_EQ(refusal([] { write_fresh_folder("/proc/threefold/x", {{"one", "1"}}); }).code(), Exit::input_output);
    EXPECT_EQ(read_file(folder / "mine.txt"), "mine");
    EXPECT_NO_THROW(require_fresh_folder(folder / "new/one"));
    EXPECT_FALSE(fs::exists(folder / "new"));
}

} // namespace
} // namespace threefold
