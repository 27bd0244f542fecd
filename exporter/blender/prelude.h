// SPDX-License-Identifier: MIT
// The fixed part of every exported Blender script.
#pragma once

#include <string_view>

namespace threefold {

/// Python for Blender 3.4 to 5.2, ASCII, standard library and `bpy` only (Debian's Blender comes without numpy).
/// It defines `main(scene)`; the generated part that follows it holds data, and calls just that.
std::string_view cycles_prelude();

} // namespace threefold
