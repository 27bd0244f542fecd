// SPDX-License-Identifier: MIT
#include "exporter/mesh/assimp_import.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
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

#include "exporter/files.h"
#include "exporter/mesh/mended_ply.h"
#include "exporter/mesh/mesh_file.h"
#include "exporter/mesh/mesh_maker.h"

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
            if (!(mesh->mPrimitiveTypes & (aiPrimitiveType_TRIANGLE | aiPrimitiveType_POLYGON))) continue;
            placed.push_back({mesh, here});
            for (unsigned f = 0; f < mesh->mNumFaces; ++f)
                triangles += std::max<std::int64_t>(std::int64_t{mesh->mFaces[f].mNumIndices} - 2, 0);
            if (triangles > most_triangles)
                throw std::runtime_error(
                    fmt::format("it has more than {} triangles, the most that Threefold takes", most_triangles));
        }
        for (unsigned i = node->mNumChildren; i-- > 0;) open.emplace_back(node->mChildren[i], here);
    }
    return placed;
}

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
    return uv_in_file(t.x, t.y);
}

} // namespace

Mesh import_with_assimp(const std::string &path) {
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS |
                                                            aiComponent_COLORS | aiComponent_BONEWEIGHTS |
                                                            aiComponent_ANIMATIONS | aiComponent_TEXTURES |
                                                            aiComponent_LIGHTS | aiComponent_CAMERAS);
    const std::string mended = mended_ply(read_file(path));
    const aiScene *scene =
        mended.empty() ? importer.ReadFile(path, aiProcess_RemoveComponent)
                       : importer.ReadFileFromMemory(mended.data(), mended.size(), aiProcess_RemoveComponent, "ply");
    if (!scene) {
        const std::string reason = importer.GetErrorString();
        if (reason == "std::bad_alloc") throw std::bad_alloc();
        throw std::runtime_error(reason);
    }
    if (!scene->mRootNode) throw std::runtime_error("it holds no mesh");

    const std::vector<Placed> all = placed_meshes(*scene);
    const bool with_uv = std::ranges::all_of(all, [](const Placed &p) { return p.mesh->HasTextureCoords(0); });
    std::size_t corners = 0;
    for (const Placed &p : all)
        for (unsigned f = 0; f < p.mesh->mNumFaces; ++f) corners += p.mesh->mFaces[f].mNumIndices;
    MeshMaker maker(corners, with_uv);
    std::vector<Vec3> place;
    std::vector<Vec2> uv;
    for (const Placed &p : all)
        for (unsigned f = 0; f < p.mesh->mNumFaces; ++f) {
            const aiFace &face = p.mesh->mFaces[f];
            place.clear();
            uv.clear();
            for (unsigned c = 0; c < face.mNumIndices; ++c) {
                const unsigned index = face.mIndices[c];
                if (index >= p.mesh->mNumVertices)
                    throw std::runtime_error("a triangle names a vertex that is not there");
                place.push_back(place_of(p, index));
                if (with_uv) uv.push_back(uv_of(p, index));
            }
            maker.add(place, uv);
        }
    return maker.take();
}

std::string assimp_version() {
    return fmt::format("{}.{}.{}", aiGetVersionMajor(), aiGetVersionMinor(), aiGetVersionPatch());
}

} // namespace threefold
