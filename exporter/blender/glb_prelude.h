// SPDX-License-Identifier: MIT
// The Python that writes a scene as glTF, after cycles_prelude().
#pragma once

#include <string_view>

namespace threefold {

/// Defines `write_glb(scene, delivery)`.
std::string_view glb_prelude();

} // namespace threefold
