// SPDX-License-Identifier: MIT
// A job for a Mitsuba that is somewhere else: its scene to be carried there, and its pictures when they are back.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "exporter/image/image.h"
#include "exporter/job.h"

namespace threefold {

struct MitsubaJob {
    std::string name;                  ///< LABEL-HASH: another scene, another name, so an old picture is never taken
    std::vector<ExportedFile> files;   ///< NAME.xml first
    std::vector<std::string> pictures; ///< NAME.1.exr, ... one a replicate
    std::vector<std::uint64_t> seeds;  ///< one a replicate
    int samples_per_pixel = 1;
    /// Under Sampling::pixel_centres the film is this many times finer, and of each pixel one part is taken.
    int finer = 1;
    int width_px = 0, height_px = 0; ///< of a picture
    Accuracy accuracy;
};

/// Pure. Throws Error(bad_data) for what Mitsuba cannot say without another picture coming out.
MitsubaJob to_mitsuba_job(const RenderJob &job, std::string_view label);

/// What the pictures cost: samples in all of them.
double samples_to_render(const std::vector<MitsubaJob> &jobs);
/// Mitsuba 3.8, scalar_rgb, through glass: a rough figure of one core.
inline constexpr double mitsuba_seconds_per_sample = 5e-7;

/// A shell script beside the scenes: renders what is not there yet.
std::string render_script(const std::vector<MitsubaJob> &jobs);

/// One a replicate, from the folder. Throws Error(input_output) that names the picture that is missing, Error(bad_data)
/// for one that is damaged or of another size.
std::vector<Image> read_pictures(const MitsubaJob &asked, const RenderJob &job, const std::filesystem::path &folder);

} // namespace threefold
