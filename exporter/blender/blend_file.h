// SPDX-License-Identifier: MIT
// A scene as a file of Blender's own, made by the installed Blender from the very data that our Cycles adapter renders.
#pragma once

#include <vector>

#include "exporter/export/delivery.h"
#include "exporter/run.h"

namespace threefold {

/// NAME.blend and README.txt. The file is opened again in a second Blender, which compares settings and evaluated radii
/// with what was asked. Throws Error(bad_data) for what Cycles cannot say exactly, and as run_in_blender does.
std::vector<ExportedFile> make_blend_file(const ExportJob &job, const InstalledRenderer &blender);

} // namespace threefold
