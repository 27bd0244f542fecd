// SPDX-License-Identifier: MIT
// How a scene gets at a user's own files. Scenes are plain values and read none themselves: who makes the parameters
// brings the reader (exporter/file_reader.h).
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "scenes/scene.h"

namespace threefold {

struct FileReader {
    /// All meshes of the file as one, with their transforms applied: lengths and axes as the file has them, `uv` if all
    /// of its meshes have texture coordinates, the default surface. Throws Error(input_output) or Error(bad_data).
    std::function<Mesh(const std::string &path)> mesh;
    /// `gamma` 0: what the file declares (sRGB is undone). Else each sample, 0 to 1 as it stands, to this power.
    std::function<std::shared_ptr<const Texture>(const std::string &path, double gamma)> texture;
};

/// Throws Error(internal) for every file.
FileReader no_files();

} // namespace threefold
