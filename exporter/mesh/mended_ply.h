// SPDX-License-Identifier: MIT
// What Assimp reads wrongly in a binary PLY: data that begin with the byte of a line's end are taken for more of the
// header, and elements before the vertices for vertices.
#pragma once

#include <string>

namespace threefold {

/// The same mesh as Assimp reads it rightly; empty where the file can stay as it is. Throws std::runtime_error for
/// elements before the vertices.
std::string mended_ply(const std::string &bytes);

} // namespace threefold
