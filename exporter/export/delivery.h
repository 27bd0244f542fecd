// SPDX-License-Identifier: MIT
// What every export has in common: what it is made from, what it tells of itself, and a folder that is complete or not
// there.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "exporter/job.h"

namespace threefold {

/// How a file came to be, for whoever finds it later.
struct Provenance {
    std::string scene; ///< any text
    std::string preset;
    std::vector<std::pair<std::string, std::string>> parameters; ///< all of the scene's, as `--set` takes them
    std::string scene_hash;
    std::string version; ///< of Threefold
    std::string export_command;
    std::string render_command; ///< that gives the picture of the renderer the export is for
};

/// Lines of printable text; control characters of a name are replaced.
std::string to_text(const Provenance &provenance);

struct ExportJob {
    RenderJob job;
    Provenance provenance;
    std::chrono::milliseconds time_limit{std::chrono::minutes(10)};

    /// The scene's name as a plain file name: letters, digits, '-' and '_', at most 60 of them.
    std::string stem() const;
};

/// Throws Error(input_output) unless `folder` is an empty folder, or one that can be made.
void require_fresh_folder(const std::filesystem::path &folder);

/// Makes the folder and writes all files into it; when one cannot be written, removes what was made and throws.
void write_fresh_folder(const std::filesystem::path &folder, const std::vector<ExportedFile> &files);

} // namespace threefold
