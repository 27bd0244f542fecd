// SPDX-License-Identifier: MIT
// Users' meshes: good ones of several formats, and every kind of bad one, which must be answered and never end us.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <random>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "exporter/file_reader.h"
#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "exporter/mesh/mesh_file.h"
#include "scenes/error.h"
#include "tests/temporary_folder.h"

namespace threefold {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
namespace fs = std::filesystem;

constexpr const char *square_obj = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\n"
                                   "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";

fs::path write(const fs::path &path, std::string_view bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

template <class T>
std::string raw(std::initializer_list<T> numbers) {
    std::string bytes;
    for (const T n : numbers) bytes.append(reinterpret_cast<const char *>(&n), sizeof n);
    return bytes;
}

/// A triangle (0,0,0) (1,0,0) (0,1,0) whose texture's lower left corner is at its right angle, seen by `nodes`.
void write_gltf(const fs::path &path, const std::string &nodes, const std::string &scene_nodes) {
    write(path.parent_path() / "triangle.bin",
          raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, /* uv, v down */ 0, 1, 1, 1, 0, 0}) + raw<std::uint16_t>({0, 1, 2}));
    write(path,
          fmt::format(R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [{}]}}], "nodes": [{}],
 "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}}, "indices": 2}}]}}],
 "buffers": [{{"uri": "triangle.bin", "byteLength": 66}}],
 "bufferViews": [{{"buffer": 0, "byteOffset": 0, "byteLength": 36}}, {{"buffer": 0, "byteOffset": 36, "byteLength": 24}},
                 {{"buffer": 0, "byteOffset": 60, "byteLength": 6}}],
 "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0,0,0], "max": [1,1,0]}},
               {{"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}},
               {{"bufferView": 2, "componentType": 5123, "count": 3, "type": "SCALAR"}}]}})",
                      scene_nodes, nodes));
}

std::string refusal(const fs::path &path, Exit expected = Exit::bad_data) {
    try {
        read_mesh(path);
    } catch (const Error &error) {
        EXPECT_EQ(error.code(), expected) << error.what();
        EXPECT_THAT(error.what(), HasSubstr(path.filename().string()));
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        return error.what();
    }
    ADD_FAILURE() << path << " was read";
    return "";
}

TEST(MeshFile, APolygonIsCutIntoTrianglesAndSharedCornersAreOneVertex) {
    const tests::TemporaryFolder folder;
    const Mesh mesh = read_mesh(write(folder / "square.obj", square_obj));
    EXPECT_THAT(mesh.triangles, SizeIs(2));
    ASSERT_THAT(mesh.vertices_mm, SizeIs(4));
    ASSERT_THAT(mesh.uv, SizeIs(4));
    for (std::size_t i = 0; i < 4; ++i) // v is up: just the place, by the numbers above
        EXPECT_EQ(mesh.uv[i], Vec2(mesh.vertices_mm[i].x / 2, mesh.vertices_mm[i].y));
}

TEST(MeshFile, AnObjIsReadAsItIsWrittenWhateverTheSpelling) {
    const tests::TemporaryFolder folder;
    const auto read = [&](const std::string &text) { return read_mesh(write(folder / "t.obj", text)); };
    const std::string five = "v 0 0 0\nv .5 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 5\nf 1 3 4\n";
    EXPECT_THAT(read(five).vertices_mm, ElementsAre(Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)));
    EXPECT_THAT(read("v 0 0 0 2\nv 3 0 0 2\nv 0 4 0 2\nf 1 2 3\n").vertices_mm,
                ElementsAre(Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 4, 0)));
    EXPECT_THAT(
        read("v 0 0 0 1 0 0\r\nv +3 -0 0 0 1 0\r\nv 0 4e0 0. 0 0 1\r\nf -3//1 \\\r\n-2//1 -1//1 # end\r\n").vertices_mm,
        ElementsAre(Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 4, 0)));
    EXPECT_THAT(read("\xef\xbb\xbfmtllib bad.mtl\nusemtl none\no x\ns off\nl 1 2\nv 0.1 0 0\nv 3 0 0\nv 0 4 0\nf 1 2 3")
                    .vertices_mm,
                ElementsAre(Vec3(0.1, 0, 0), Vec3(3, 0, 0), Vec3(0, 4, 0)));
}

TEST(MeshFile, AnMtlThatCannotBeReadIsOfNoConcern) {
    const tests::TemporaryFolder folder;
    write(folder / "bad.mtl", "newmtl a\nKd none of these\nmap_Kd\n\xff\xfe\n");
    const Mesh mesh =
        read_mesh(write(folder / "t.obj", "mtllib bad.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    EXPECT_THAT(mesh.triangles, SizeIs(1));
}

TEST(MeshFile, ALineOfAnObjThatCannotBeReadIsRefusedWithItsNumber) {
    const tests::TemporaryFolder folder;
    const std::string good = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (const char *bad : {"v 1 2", "v 1 2 x", "v 1 2 3,4", "vt", "vt x", "f 1 2 x", "f 1 2 0", "f 1 2 -4", "f 1 2 4",
                            "f 1/1 2/1 3/1", "f 1 2 3.5", "surf 0 1 0 1 1 2", "f 1 2 99999999999999999999"})
        EXPECT_THAT(refusal(write(folder / "t.obj", good + bad + "\nf 1 2 3\n")), HasSubstr("line 4: ")) << bad;
}

double area_of(const Mesh &mesh) {
    double area = 0;
    for (const glm::uvec3 &t : mesh.triangles)
        area += glm::length(glm::cross(mesh.vertices_mm[t.y] - mesh.vertices_mm[t.x],
                                       mesh.vertices_mm[t.z] - mesh.vertices_mm[t.x])) /
                2;
    return area;
}

TEST(MeshFile, AConcavePolygonWithCornersOnALineHasItsOwnAreaInObjAndPly) {
    const tests::TemporaryFolder folder;
    const char *places[] = {"4 0", "4 5", "6 5", "6 0", "10 0", "10 10", "0 10", "0 5", "0 0"};
    std::string obj, face = "f",
                     ply = "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nproperty float y\n"
                           "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                           "end_header\n";
    for (int k = 0; k < 9; ++k) {
        obj += fmt::format("v {} 0\n", places[k]);
        face += fmt::format(" {}", k + 1);
        ply += fmt::format("{} 0\n", places[k]);
    }
    EXPECT_NEAR(area_of(read_mesh(write(folder / "u.obj", obj + face + "\n"))), 90, 1e-9);
    EXPECT_NEAR(area_of(read_mesh(write(folder / "u.ply", ply + "9 0 1 2 3 4 5 6 7 8\n"))), 90, 1e-9);
}

TEST(MeshFile, ABinaryPlyMayBeginItsDataWithTheByteOfALinesEnd) {
    const tests::TemporaryFolder folder;
    const std::string head =
        "ply\nformat binary_little_endian 1.0\ncomment x\nelement vertex 3\nproperty float x\nproperty float "
        "y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for (const std::uint32_t bits : {0x3f80000au, 0x3f80000du, 0x3f800000u}) {
        const auto x = std::bit_cast<float>(bits);
        const Mesh mesh = read_mesh(write(folder / "t.ply", head + raw<float>({x, 0, 0, 3, 0, 0, 0, 4, 0}) + "\3" +
                                                                raw<std::int32_t>({0, 1, 2})));
        EXPECT_THAT(mesh.vertices_mm, ElementsAre(Vec3(x, 0, 0), Vec3(3, 0, 0), Vec3(0, 4, 0))) << bits;
    }
}

TEST(MeshFile, ABinaryPlyWithElementsBeforeItsVerticesIsRefused) {
    const tests::TemporaryFolder folder;
    const std::string head =
        "ply\nformat binary_little_endian 1.0\nelement camera 1\nproperty float f\nelement vertex 3\n"
        "property float x\nproperty float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n";
    EXPECT_THAT(refusal(write(folder / "t.ply",
                              head + raw<float>({7, 0, 0, 0, 3, 0, 0, 0, 4, 0}) + "\3" + raw<std::int32_t>({0, 1, 2}))),
                HasSubstr("'camera' before its vertices"));
}

TEST(MeshFile, TransformsOfNodesAreAppliedAndVIsUpInGltfToo) {
    const tests::TemporaryFolder folder;
    const fs::path path = folder / "two.gltf";
    // The second one is a child: twice as large, then moved by 10 along x.
    write_gltf(path, R"({"mesh": 0}, {"translation": [10, 0, 0], "children": [2]}, {"mesh": 0, "scale": [2, 2, 2]})",
               "0, 1");
    const Mesh mesh = read_mesh(path);
    EXPECT_THAT(mesh.triangles, SizeIs(2));
    EXPECT_THAT(mesh.vertices_mm, testing::UnorderedElementsAre(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0),
                                                                Vec3(10, 0, 0), Vec3(12, 0, 0), Vec3(10, 2, 0)));
    ASSERT_THAT(mesh.uv, SizeIs(6));
    for (std::size_t i = 0; i < 6; ++i) {
        const bool first = mesh.vertices_mm[i].x < 5;
        const Vec3 p = first ? mesh.vertices_mm[i] : (mesh.vertices_mm[i] - Vec3(10, 0, 0)) / 2.0;
        EXPECT_EQ(mesh.uv[i], Vec2(p.x, p.y));
    }
}

TEST(MeshFile, OtherFormatsGiveTheSameShapeWithoutTextureCoordinates) {
    const tests::TemporaryFolder folder;
    const fs::path ply = write(folder / "t.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty "
                                                 "float y\nproperty float z\nelement face 1\nproperty list uchar int "
                                                 "vertex_indices\nend_header\n0 0 0\n3 0 0\n0 4 0\n3 0 1 2\n");
    const fs::path stl = write(folder / "t.stl", "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 3 0 0\n"
                                                 "vertex 0 4 0\nendloop\nendfacet\nendsolid t\n");
    for (const fs::path &path : {ply, stl}) {
        const Mesh mesh = read_mesh(path);
        EXPECT_THAT(mesh.vertices_mm, ElementsAre(Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 4, 0))) << path;
        EXPECT_THAT(mesh.triangles, ElementsAre(glm::uvec3(0, 1, 2))) << path;
        EXPECT_THAT(mesh.uv, IsEmpty()) << path;
    }
}

TEST(MeshFile, TrianglesWithoutAreaAreLeftOut) {
    const tests::TemporaryFolder folder;
    const Mesh mesh = read_mesh(write(folder / "t.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 4\n"));
    EXPECT_THAT(mesh.triangles, SizeIs(1));
    EXPECT_THAT(mesh.vertices_mm, SizeIs(3));
    EXPECT_THAT(refusal(write(folder / "line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")), HasSubstr("area"));
}

TEST(MeshFile, WhatIsNoReadableFileIsAnsweredAsSuch) {
    const tests::TemporaryFolder folder;
    EXPECT_THAT(refusal(folder / "missing.obj", Exit::input_output), HasSubstr("No such file"));
    fs::create_directory(folder / "folder.obj");
    EXPECT_THAT(refusal(folder / "folder.obj", Exit::input_output), HasSubstr("directory"));
    EXPECT_THAT(refusal(write(folder / "empty.obj", "")), HasSubstr("empty"));
}

TEST(MeshFile, WhatIsNoMeshIsRefused) {
    const tests::TemporaryFolder folder;
    refusal(write(folder / "notes.txt", "This is no mesh.\n"));
    refusal(write(folder / "words.obj", "This is no mesh.\n"));
    EXPECT_THAT(refusal(write(folder / "points.obj", "v 0 0 0\nv 1 0 0\np 1 2\n")), HasSubstr("no"));
    write_image(folder / "picture.png", Image(8, 8, Rgb(0.5)));
    fs::rename(folder / "picture.png", folder / "picture.obj");
    refusal(folder / "picture.obj");
    fs::copy(folder / "picture.obj", folder / "picture.ply");
    refusal(folder / "picture.ply");

    std::mt19937 random(1);
    for (const char *name : {"noise.obj", "noise.ply", "noise.stl", "noise.gltf", "noise.glb", "noise.dae", "noise.fbx",
                             "noise.3ds", "noise.off", "noise.blend"}) {
        std::string bytes(3000, '\0');
        for (char &c : bytes) c = static_cast<char>(random());
        refusal(write(folder / name, bytes));
    }
}

TEST(MeshFile, NumbersThatAreNotFiniteAreRefused) {
    const tests::TemporaryFolder folder;
    EXPECT_THAT(refusal(write(folder / "nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n")), HasSubstr("not finite"));
    EXPECT_THAT(refusal(write(folder / "inf.obj", "v 0 0 0\nv inf 0 0\nv 0 1 0\nf 1 2 3\n")), HasSubstr("not finite"));
    const std::string head =
        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float "
        "y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
        EXPECT_THAT(refusal(write(folder / "bad.ply", head + raw<float>({0, 0, 0, 1, bad, 0, 0, 1, 0}) + "\3" +
                                                          raw<std::int32_t>({0, 1, 2}))),
                    HasSubstr("not finite"));
}

TEST(MeshFile, DamagedFilesAreRefusedWhateverTheyDoToTheirReader) {
    const tests::TemporaryFolder folder;
    refusal(write(folder / "index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99\n"));
    refusal(write(folder / "negative.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -99\n"));
    // Four thousand million vertices, none of them there.
    refusal(
        write(folder / "huge.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float "
                                   "x\nproperty float y\nproperty float z\nelement face 4000000000\nproperty list "
                                   "uchar int vertex_indices\nend_header\n" +
                                       raw<float>({0, 0, 0})));
    std::string stl(80, ' ');
    refusal(write(folder / "huge.stl", stl + raw<std::uint32_t>({4'000'000'000u}) + raw<float>({0, 0, 1, 0, 0, 0})));

    write_gltf(folder / "good.gltf", R"({"mesh": 0})", "0");
    const std::string good = read_file(folder / "good.gltf");
    EXPECT_NO_THROW(read_mesh(folder / "good.gltf"));
    for (const double share : {0.2, 0.5, 0.9, 0.99})
        refusal(write(folder / "cut.gltf", good.substr(0, static_cast<std::size_t>(share * double(good.size())))));
    write(folder / "triangle.bin", "short");
    refusal(folder / "good.gltf");
    fs::remove(folder / "triangle.bin");
    refusal(folder / "good.gltf");
}

TEST(MeshFile, AFileThatRepeatsItsMeshWithoutEndIsRefused) {
    const tests::TemporaryFolder folder;
    // Nodes times primitives of one triangle: 4.25 million from a small file.
    std::string nodes, names;
    for (int i = 0; i < 2500; ++i) {
        nodes += (i ? ", " : "") + std::string(R"({"mesh": 0})");
        names += (i ? ", " : "") + std::to_string(i);
    }
    write_gltf(folder / "many.gltf", nodes, names);
    std::string text = read_file(folder / "many.gltf");
    const std::string primitive = R"({"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2})";
    std::string primitives = primitive;
    for (int i = 1; i < 1700; ++i) primitives += ", " + primitive;
    text.replace(text.find(primitive), primitive.size(), primitives);
    EXPECT_THAT(refusal(write(folder / "many.gltf", text)), HasSubstr("4000000"));
}

TEST(MeshFile, AMillionTrianglesAreRead) {
    const tests::TemporaryFolder folder;
    constexpr int side = 708; // 1,002,528 triangles
    std::string text;
    for (int y = 0; y <= side; ++y)
        for (int x = 0; x <= side; ++x)
            text += fmt::format("v {} {} {:.4f}\nvt {:.6f} {:.6f}\n", x, y, std::sin(0.05 * x) * std::cos(0.07 * y),
                                double(x) / side, double(y) / side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const int a = y * (side + 1) + x + 1, b = a + 1, c = b + side + 1, d = a + side + 1;
            text += fmt::format("f {}/{} {}/{} {}/{}\nf {}/{} {}/{} {}/{}\n", a, a, b, b, c, c, a, a, c, c, d, d);
        }
    const Mesh mesh = read_mesh(write(folder / "million.obj", text));
    EXPECT_EQ(mesh.triangles.size(), 2u * side * side);
    EXPECT_EQ(mesh.vertices_mm.size(), (side + 1u) * (side + 1u));
    EXPECT_EQ(mesh.uv.size(), mesh.vertices_mm.size());
}

TEST(MeshFile, AnyNameOfAFileIsOnlyAName) {
    const tests::TemporaryFolder folder;
    for (const char *name : {"a \"quoted\"; touch pwned #.obj", "line\nbreak.obj", "'$(touch pwned)'.obj", "%s%n.obj",
                             "na\xc3\xafve \xff.obj", "-rf.obj"}) {
        const Mesh mesh = read_mesh(write(folder / name, square_obj));
        EXPECT_THAT(mesh.triangles, SizeIs(2)) << name;
    }
    EXPECT_FALSE(fs::exists(folder / "pwned"));
}

TEST(FileReader, AFileIsReadOnceAndAgainWhenItHasChanged) {
    const tests::TemporaryFolder folder;
    const std::string path = write(folder / "square.obj", square_obj).string();
    const fs::file_time_type first = fs::last_write_time(path);
    EXPECT_THAT(file_reader().mesh(path).triangles, SizeIs(2));

    // As large and as old as before: only a cache can still know what it was.
    std::string other = square_obj;
    other.replace(other.find("v 2 1"), 5, "v 3 1");
    write(path, other);
    fs::last_write_time(path, first);
    EXPECT_THAT(file_reader().mesh(path).vertices_mm, testing::Contains(Vec3(2, 1, 0)));
    fs::last_write_time(path, first + std::chrono::seconds(1));
    EXPECT_THAT(file_reader().mesh(path).vertices_mm, testing::Contains(Vec3(3, 1, 0)));

    fs::remove(path);
    EXPECT_THROW(file_reader().mesh(path), Error);
}

} // namespace
} // namespace threefold
