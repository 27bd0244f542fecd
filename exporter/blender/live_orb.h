// SPDX-License-Identifier: MIT
// The Python that makes a file of Blender's own out of a scene, after cycles_prelude(): the same scene, with orbs whose
// radius, wall and glass are inputs of a modifier.
#pragma once

#include <string_view>

namespace threefold {

/// Defines `deliver(scene, delivery)`, which builds and saves, and `inspect(scene, delivery)`, which says in another
/// Blender whether the saved file holds what was asked. Geometry Nodes alone: no driver, no script in the file.
std::string_view live_orb_prelude();

} // namespace threefold
