// SPDX-License-Identifier: MIT
// A scene as Mitsuba 3 XML: the study's renderer, so that a fourth one can be asked. Millimetres, analytic spheres, a
// pixel is the mean over its own area, paths are followed to their end. Values that Mitsuba has no word for stand in an
// instruction `<?threefold ...?>`, which it passes over and our reader (read_mitsuba.h) understands.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "exporter/job.h"

namespace threefold {

/// What the format cannot say, in words for people. `changes_picture`: Mitsuba's picture of the file is then another
/// one than the scene's.
struct MitsubaLoss {
    std::string what;
    bool changes_picture = true;
};

struct MitsubaFiles {
    std::vector<ExportedFile> files; ///< NAME.xml first; pictures and meshes are named by their content
    std::vector<MitsubaLoss> losses;
};

/// Pure. `name` is a plain file name without ending. The file's parameters spp and seed can be given on Mitsuba's own
/// command line.
MitsubaFiles to_mitsuba(const Scene &scene, const std::string &name, int samples_per_pixel = 64,
                        std::uint64_t seed = 1);

/// Writes scene.xml with its pictures and meshes into the folder; returns the losses. Throws Error(input_output).
std::vector<MitsubaLoss> write_mitsuba(const Scene &scene, const std::filesystem::path &folder,
                                       int samples_per_pixel = 64, std::uint64_t seed = 1);

} // namespace threefold
