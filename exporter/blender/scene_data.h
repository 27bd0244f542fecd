// SPDX-License-Identifier: MIT
// A scene as the data that the Blender script reads. Blender's frame: right-handed, +z up, the orb at the origin, and a
// unit in which single precision does no harm.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "exporter/job.h"

namespace threefold {

struct CyclesScene {
    nlohmann::ordered_json data;     ///< what the script's functions take
    std::vector<ExportedFile> files; ///< meshes and textures that the data names
    std::vector<std::string> outputs;
    Accuracy accuracy;
};

CyclesScene describe_for_cycles(const RenderJob &job);

/// `NAME = ...`: an object as data for a script, and no code made from it. One line for each member, and for each
/// element of a list of objects.
std::string to_python(std::string_view name, const nlohmann::ordered_json &data);

} // namespace threefold
