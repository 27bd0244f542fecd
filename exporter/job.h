// SPDX-License-Identifier: MIT
// What is asked of a renderer, whichever it is, and what it promises before it starts.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace threefold {

/// `pixel_centres`: one ray through each pixel's sample position, no filtering. `box`: the mean over each whole pixel.
enum class Sampling { pixel_centres, box };

/// Where nobody says how near a tessellated sphere must be to the true one: of its own radius, whatever its size.
inline constexpr double usual_surface_share = 1.5e-5;

/// One of K independent repetitions of the same picture.
struct Replicate {
    std::uint64_t seed = 1;
    Vec2 film_offset_px{0, 0}; ///< added to the camera's own; every renderer gets the same one
};

/// A deliberate defect that no scene can say, for the power study: none in an honest job. A renderer that cannot be
/// made to err in this way refuses the job.
struct Slip {
    bool inner_normal_flipped = false;  ///< crossing the inner surface of a shell refracts as entering its glass does
    std::optional<int> most_interfaces; ///< a path through an orb ends after it met so many of its surfaces
    double inner_tint_forgotten = 0;    ///< the inner surface's transmittance is that to the power 1 minus this

    bool operator==(const Slip &) const = default;
};

struct RenderJob {
    Scene scene;
    Sampling sampling = Sampling::box;
    int samples_per_pixel = 16; ///< for `box`, per replicate; a renderer that samples on a grid rounds up to a square
    std::vector<Replicate> replicates{Replicate{}};
    double surface_tolerance_mm = 0; ///< greatest distance of a tessellated glass surface; 0: usual_surface_share
    double cut_weight = 1e-6;        ///< a branch of the ray tree may be dropped below this weight, never above
    /// For studies: a path ends after so many surfaces, where a renderer counts them. Empty: as deep as it can. What it
    /// takes away is in no `Accuracy`.
    std::optional<int> most_bounces{};
    int threads = 0; ///< 0: all cores
    Slip slip{};
};

/// How far a picture can be from the exact one apart from sampling noise: stated before rendering, itemised, and in
/// quantities that mean the same for every renderer. Claims build their tolerances from it.
struct Accuracy {
    double radiance_step = 0;      ///< greatest error of a stored radiance through its number format
    double surface_mm = 0;         ///< greatest distance between a rendered glass surface and the true one
    double rounding_mm = 0;        ///< error of a position through the arithmetic, at the scale of the scene
    double filter_px = 0;          ///< standard deviation of the sample position under Sampling::pixel_centres
    double cut_weight = 0;         ///< branches below this weight are dropped; 0: none is dropped
    bool cuts_whole_trees = false; ///< cut_weight bounds all that is dropped of a ray's tree, not each branch
    double lost_paths = 0;         ///< greatest share of paths through glass that a renderer loses altogether
    double paths_per_pixel = 1;    ///< of so many independent paths a lost one is a share of its pixel's radiance
    double trapped_light = 0;      ///< share of the picture's light that is dropped because paths may not be longer
    bool random_branches = false;  ///< follows one branch where light splits, or one light, at random: much more noise
};

struct ExportedFile {
    std::string name; ///< a plain file name, no folder
    std::string bytes;
};

/// A job in another program's language: a pure function of the job.
struct Exported {
    std::vector<ExportedFile> files;
    std::vector<std::string> arguments;        ///< of the program, run inside the folder that holds `files`
    std::vector<std::string> thread_arguments; ///< come before them; they change no picture
    std::vector<std::string> outputs; ///< pictures it will write, linear and unfiltered, replicate by replicate
    int pictures_per_replicate = 1;   ///< a replicate is the mean of this many of them
    int supersampling = 1;            ///< pictures are this many times wider and higher: average blocks
    double radiance_scale = 1;        ///< a stored value is radiance times this
    Accuracy accuracy;
};

} // namespace threefold
