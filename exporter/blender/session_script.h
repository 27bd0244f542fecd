// SPDX-License-Identifier: MIT
// Blender as a program that renders one exported scene after another (exporter/session.h).
#pragma once

#include <string>
#include <vector>

namespace threefold {

/// As Adapter::session_arguments. Each scene begins with Blender's factory settings, as in a Blender of its own.
std::vector<std::string> blender_session_arguments();

} // namespace threefold
