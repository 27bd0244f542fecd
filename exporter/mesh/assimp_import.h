// SPDX-License-Identifier: MIT
// Assimp itself. Called only in a child process (mesh_file.cpp): a bad file may end the process.
#pragma once

#include <string>

#include "scenes/scene.h"

namespace threefold {

/// As read_mesh (mesh_file.h), but throws std::runtime_error with the reason alone.
Mesh import_with_assimp(const std::string &path);

} // namespace threefold
