// SPDX-License-Identifier: MIT
// The programs that Threefold can ask for a picture, each behind the same few functions.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "exporter/job.h"

namespace threefold {

struct Adapter {
    std::string_view name;    ///< on the command line and in results: "povray"
    std::string_view title;   ///< for people: "POV-Ray"
    std::string_view program; ///< looked up in PATH
    std::string_view package; ///< Debian package that brings it

    /// Pure. Throws Error(Exit::bad_data) for what the program cannot say exactly.
    Exported (*compile)(const RenderJob &job);
    /// The share done, 0 to 1 over all replicates, if this line of the program's output tells it. `last_share` is its
    /// previous answer (0 at first): a line may count within one replicate only.
    std::optional<double> (*progress)(std::string_view line, double last_share, const Exported &exported);
    /// Arguments that make the program print its version; `parse_version` finds it in the output ("" if absent).
    std::string_view version_argument;
    std::string (*parse_version)(std::string_view output);
    /// The line of a log that best explains why the program failed; empty if none does.
    std::string (*explain_failure)(std::string_view log);
    /// Changes whenever the same files and arguments would be read as another picture: a kept picture is then old.
    int revision = 1;
    /// Where glass splits rays, or many lights fall on a surface: samples for one of a renderer that follows every
    /// branch, for about the same noise.
    int sample_factor = 1;
    /// The line after which the program does nothing but render: reading and building are over. May be null.
    bool (*rendering_begins)(std::string_view line) = nullptr;
    /// It sleeps between the pictures of one process: another render may use its core meanwhile.
    bool sleeps_between_pictures = false;
    /// Arguments with which the program renders one job after another (exporter/session.h): its stdin gives a line of
    /// JSON for each, the folder that holds the job's files. May be null: it cannot.
    std::vector<std::string> (*session_arguments)() = nullptr;
    /// CPU seconds of rendering alone, if the program's log tells them. May be null.
    std::optional<double> (*own_cpu_seconds)(std::string_view log) = nullptr;
};

std::span<const Adapter> adapters();

/// The job as this renderer is asked it: `samples_per_pixel` are those of a renderer that follows every branch.
RenderJob for_renderer(const Adapter &adapter, RenderJob job);

} // namespace threefold
