// SPDX-License-Identifier: MIT
// The objects of a scene as data for the Blender script, with the mesh and texture files that the data names.
#pragma once

#include <vector>

#include <nlohmann/json.hpp>

#include "exporter/blender/to_blender.h"
#include "exporter/job.h"

namespace threefold {

struct CyclesObjects {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    std::vector<ExportedFile> files;
    double surface_mm = 0; ///< greatest distance of a glass mesh from its sphere
};

/// `linear16`: exact. `srgb8`: for formats whose textures are that.
enum class TextureEncoding { linear16, srgb8 };

CyclesObjects describe_objects(const RenderJob &job, const ToBlender &to_blender,
                               TextureEncoding encoding = TextureEncoding::linear16);

} // namespace threefold
