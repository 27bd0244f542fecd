// SPDX-License-Identifier: MIT
// A scene as the data that the Blender script reads. Blender's frame: right-handed, +z up, the orb at the origin, and a
// unit in which single precision does no harm.
#pragma once

#include <string>
#include <vector>

#include "exporter/job.h"

namespace threefold {

struct CyclesScene {
    std::string python;              ///< `SCENE = ...` and the call of main(): data, and no code made from it
    std::vector<ExportedFile> files; ///< meshes and textures that the data names
    std::vector<std::string> outputs;
    Accuracy accuracy;
};

CyclesScene describe_for_cycles(const RenderJob &job);

} // namespace threefold
