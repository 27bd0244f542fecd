// SPDX-License-Identifier: MIT
// Wavefront OBJ: places, texture coordinates and polygons, as the file says them and in double precision. Materials,
// groups, normals, colours, lines and points change no shape here and are passed over; what cannot be read in a line
// that does is an error with its number, never passed over.
#pragma once

#include <string>

#include "scenes/scene.h"

namespace threefold {

/// As read_mesh (mesh_file.h), but throws std::runtime_error with the reason alone.
Mesh import_obj(const std::string &path);

} // namespace threefold
