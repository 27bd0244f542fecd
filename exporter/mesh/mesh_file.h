// SPDX-License-Identifier: MIT
// A mesh from a user's own file, OBJ, or any other format that Assimp reads (PLY, STL, glTF, COLLADA, FBX ...).
// Lengths are the numbers of the file, in COLLADA metres (Assimp goes by the unit that the file declares); v is up.
// Normals, materials, bones and animations of the file are left out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "scenes/scene.h"

namespace threefold {

inline constexpr std::int64_t most_triangles = 4'000'000;

/// All meshes of the file as one, with the transforms of their nodes; polygons are cut into triangles; corners that are
/// equal in place and uv are one vertex. `uv` is empty unless each mesh has it. Lines, points and triangles of no area
/// are left out: they cover nothing. Read in a child process. Throws Error(input_output) when the file is missing or
/// cannot be read, Error(bad_data) when it is no mesh, has no triangle, more than `most_triangles`, or a corner that is
/// not finite; the message names the file.
Mesh read_mesh(const std::filesystem::path &path);

/// Of the library that reads.
std::string assimp_version();

} // namespace threefold
