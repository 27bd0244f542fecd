// SPDX-License-Identifier: MIT
// Scenes of Mitsuba 0.5 to 3, read into the vocabulary: glass spheres (two of them for a hollow orb), rectangles and
// meshes that are diffuse, black or emitting, bitmap and grid textures, parallel and constant light, one camera.
// A file declares no unit of length; its frame is right-handed, as ours. What the vocabulary cannot say is refused with
// where it stands, all of it in one error; what only concerns how a picture is made is told as a note.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "scenes/parameters.h"

namespace threefold {

/// The file as a scene like those of the catalogue: its parameters are listed by `show`, changed by `--set`. `tell`
/// gets the notes, and `warn` what is read otherwise so that the picture may be another, each time that the scene is
/// built. Throws Error(input_output) for a file that is not there and
/// Error(bad_data) for one that is no scene; building throws Error(bad_data) that names all that cannot be read.
SceneRecipe mitsuba_scene(
    const std::filesystem::path &file, std::function<void(const std::string &note)> tell = [](const std::string &) {},
    std::function<void(const std::string &change)> warn = [](const std::string &) {});

} // namespace threefold
