// SPDX-License-Identifier: MIT
// A scene for POV-Ray as a folder to keep: the adapter's own files, an .ini with the command's options, and a README.
#pragma once

#include <vector>

#include "exporter/export/delivery.h"

namespace threefold {

/// Pure. `povray scene.ini` in the folder then writes the pictures that our adapter reads. Throws Error(bad_data) for
/// what POV-Ray cannot say exactly.
std::vector<ExportedFile> make_povray_folder(const ExportJob &job);

} // namespace threefold
