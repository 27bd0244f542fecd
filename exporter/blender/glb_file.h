// SPDX-License-Identifier: MIT
// A scene as binary glTF 2.0, written by Blender's own exporter: metres, +y up, the first orb's centre (else the
// camera's target) at the origin; glass by KHR_materials_transmission, _ior and _volume, lights by KHR_lights_punctual.
#pragma once

#include <vector>

#include "exporter/export/delivery.h"
#include "exporter/run.h"

namespace threefold {

/// NAME.glb and README.txt. Throws Error(bad_data) for a coordinate card, and as run_in_blender does.
std::vector<ExportedFile> make_glb_file(const ExportJob &job, const InstalledRenderer &blender);

} // namespace threefold
