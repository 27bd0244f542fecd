// SPDX-License-Identifier: MIT
// A scene as Wavefront OBJ: geometry in the scene's own frame and millimetres, materials beside it (.mtl), textures as
// 8-bit sRGB PNG. Spheres are icospheres with exact normals; a shell's inner surface looks to the centre.
#pragma once

#include <vector>

#include "exporter/export/delivery.h"

namespace threefold {

/// Pure. NAME.obj, NAME.mtl, textures and README.txt. Throws Error(bad_data) for a coordinate card.
std::vector<ExportedFile> make_obj_files(const ExportJob &job);

} // namespace threefold
