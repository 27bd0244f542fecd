// SPDX-License-Identifier: MIT
// The module that reads and writes pictures, loaded at the first call.
#pragma once

#include <filesystem>
#include <vector>

#include "exporter/image/picture_module.h"

namespace threefold {

struct LoadedPictures {
    const PictureModule *module;
    std::filesystem::path path;
};

/// Beside the program; where it is installed with the program (lib/threefold in the program's prefix, wherever that was
/// moved to); by the program's own library path (no folder); in the prefix that Threefold was built for.
std::vector<std::filesystem::path> picture_module_places();

/// The first that is whole and of our version. Throws Error(input_output) with all places and what is wrong there.
LoadedPictures load_pictures(const std::vector<std::filesystem::path> &places);

/// That of picture_module_places(), once a process.
const LoadedPictures &loaded_pictures();

} // namespace threefold
