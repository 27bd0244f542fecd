// SPDX-License-Identifier: MIT
#include "exporter/mesh/assimp_import.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <stdexcept>
#include <vector>

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/version.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include "exporter/mesh/mesh_file.h"

namespace threefold {
namespace {

glm::dmat4 to_glm(const aiMatrix4x4 &m) {
    return {m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4};
}

struct Placed {
    const aiMesh *mesh;
    glm::dmat4 transform;
};

/// Every mesh as often as a node names it. A few nodes can name one mesh without end, so triangles are counted first.
std::vector<Placed> placed_meshes(const aiScene &scene) {
    std::vector<Placed> placed;
    std::int64_t triangles = 0;
    std::vector<std::pair<const aiNode *, glm::dmat4>> open{{scene.mRootNode, glm::dmat4(1)}};
    while (!open.empty()) {
        const auto [node, above] = open.back();
        open.pop_back();
        const glm::dmat4 here = above * to_glm(node->mTransformation);
        for (unsigned i = 0; i < node->mNumMeshes; ++i) {
            const aiMesh *mesh = scene.mMeshes[node->mMeshes[i]];
            if (!(mesh->mPrimitiveTypes & aiPrimitiveType_TRIANGLE)) continue;
            placed.push_back({mesh, here});
            triangles += mesh->mNumFaces;
            if (triangles > most_triangles)
                throw std::runtime_error(
                    fmt::format("it has more than {} triangles, the most that Threefold takes", most_triangles));
        }
        for (unsigned i = node->mNumChildren; i-- > 0;) open.emplace_back(node->mChildren[i], here);
    }
    return placed;
}

/// Joins corners that are equal to the last bit. (Assimp's own joining is by a fixed distance, whatever the unit.)
class Joiner {
public:
    Joiner(std::size_t corners, bool with_uv)
        : with_uv_(with_uv), slots_(std::bit_ceil(std::max<std::size_t>(16, 2 * corners)), empty) {}

    std::uint32_t vertex(Vec3 place, Vec2 uv) {
        const Vec3 p = place + 0.0; // -0 is 0
        for (std::size_t slot = hash(p, uv) & (slots_.size() - 1);; slot = (slot + 1) & (slots_.size() - 1)) {
            if (slots_[slot] == empty) {
                slots_[slot] = static_cast<std::uint32_t>(mesh.vertices_mm.size());
                mesh.vertices_mm.push_back(p);
                if (with_uv_) mesh.uv.push_back(uv);
                return slots_[slot];
            }
            const std::uint32_t known = slots_[slot];
            if (mesh.vertices_mm[known] == p && (!with_uv_ || mesh.uv[known] == uv)) return known;
        }
    }

    Mesh mesh;

private:
    static constexpr std::uint32_t empty = std::numeric_limits<std::uint32_t>::max();

    static std::size_t hash(Vec3 p, Vec2 uv) {
        std::uint64_t h = 0;
        for (const double x : {p.x, p.y, p.z, uv.x, uv.y}) {
            h = (h ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15; // 2^64 over the golden ratio
            h ^= h >> 29;
        }
        return h;
    }

    bool with_uv_;
    std::vector<std::uint32_t> slots_;
};

Vec3 place_of(const Placed &placed, unsigned index) {
    const aiVector3D &v = placed.mesh->mVertices[index];
    const Vec3 own(v.x, v.y, v.z), place(placed.transform * glm::dvec4(own, 1));
    const auto finite = [](Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); };
    if (!finite(own) || !finite(place)) {
        const Vec3 bad = finite(own) ? place : own;
        throw std::runtime_error(fmt::format("a vertex is not finite: ({}, {}, {})", bad.x, bad.y, bad.z));
    }
    return place;
}

Vec2 uv_of(const Placed &placed, unsigned index) {
    const aiVector3D &t = placed.mesh->mTextureCoords[0][index];
    if (!std::isfinite(t.x) || !std::isfinite(t.y))
        throw std::runtime_error(fmt::format("a texture coordinate is not finite: ({}, {})", t.x, t.y));
    // What the rounding of the file's text puts beside the unit square is meant to lie in it.
    constexpr double rounding = 1e-6;
    const auto snapped = [](double x) { return x > -rounding && x < 1 + rounding ? std::clamp(x, 0.0, 1.0) : x; };
    return {snapped(t.x), snapped(t.y)};
}

bool covers_nothing(Vec3 a, Vec3 b, Vec3 c) { return glm::cross(b - a, c - a) == Vec3(0); }

} // namespace

Mesh import_with_assimp(const std::string &path) {
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                                            aiComponent_COLORS | aiComponent_BONEWEIGHTS |
                                                            aiComponent_ANIMATIONS | aiComponent_TEXTURES |
                                                            aiComponent_LIGHTS | aiComponent_CAMERAS);
    const aiScene *scene = importer.ReadFile(path, aiProcess_RemoveComponent | aiProcess_Triangulate);
    if (!scene) {
        const std::string reason = importer.GetErrorString();
        if (reason == "std::bad_alloc") throw std::bad_alloc();
        throw std::runtime_error(reason);
    }
    if (!scene->mRootNode) throw std::runtime_error("it holds no mesh");

    const std::vector<Placed> all = placed_meshes(*scene);
    const bool with_uv = std::ranges::all_of(all, [](const Placed &p) { return p.mesh->HasTextureCoords(0); });
    std::size_t corners = 0;
    for (const Placed &p : all) corners += std::size_t{3} * p.mesh->mNumFaces;
    Joiner joiner(corners, with_uv);
    bool any = false;
    for (const Placed &p : all)
        for (unsigned f = 0; f < p.mesh->mNumFaces; ++f) {
            const aiFace &face = p.mesh->mFaces[f];
            if (face.mNumIndices != 3) continue;
            any = true;
            std::array<Vec3, 3> place;
            std::array<Vec2, 3> uv{Vec2(0), Vec2(0), Vec2(0)};
            for (unsigned c = 0; c < 3; ++c) {
                const unsigned index = face.mIndices[c];
                if (index >= p.mesh->mNumVertices)
                    throw std::runtime_error("a triangle names a vertex that is not there");
                place[c] = place_of(p, index);
                if (with_uv) uv[c] = uv_of(p, index);
            }
            if (covers_nothing(place[0], place[1], place[2])) continue;
            const std::uint32_t x = joiner.vertex(place[0], uv[0]), y = joiner.vertex(place[1], uv[1]),
                                z = joiner.vertex(place[2], uv[2]);
            joiner.mesh.triangles.emplace_back(x, y, z);
        }
    if (!any) throw std::runtime_error("it has no triangles");
    if (joiner.mesh.triangles.empty()) throw std::runtime_error("none of its triangles has an area");
    return std::move(joiner.mesh);
}

std::string assimp_version() {
    return fmt::format("{}.{}.{}", aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch());
}

} // namespace threefold
