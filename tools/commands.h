// SPDX-License-Identifier: MIT
// One function a command. Results go to stdout, log and progress to stderr; each returns an exit code or throws Error.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "exporter/process/shell.h"
#include "scenes/error.h"
#include "scenes/parameters.h"
#include "verifier/claims/claim.h"
#include "verifier/tracer/tracer.h"
#include "verifier/witness/witness.h"

namespace threefold {

/// What every command may use.
struct Shop {
    const std::vector<SceneRecipe> &scenes;
    const std::vector<Claim> &claims;
    std::string program;      ///< "threefold", or the name of a user's own program
    std::string command_line; ///< as typed, quoted for a shell
    int verbosity = 0;        ///< -1 quiet, 0, 1 verbose
    int threads = 0;
};

/// A scene as asked for on the command line.
struct SceneRequest {
    std::string name;
    std::string preset = "text";
    std::vector<std::string> assignments;
    std::string size{};    ///< "WxH", or empty
    std::string mitsuba{}; ///< a file to read the scene from, in place of `name`; or empty
};

/// The scene's name, or that of the user's file.
std::string scene_label(const SceneRequest &request);
/// Of the catalogue, or of the user's file.
SceneRecipe recipe_of(const Shop &shop, const SceneRequest &request);

Parameters parameters_of(const SceneRecipe &recipe, const SceneRequest &request);
/// Built and validated.
Scene scene_of(const Shop &shop, const SceneRequest &request);
/// The user's file as a scene; with --verbose it tells each note once.
SceneRecipe mitsuba_recipe(const Shop &shop, const std::string &file);
/// "WxH" as two assignments.
std::vector<Assignment> parse_size(const std::string &size);

Exit command_list(const Shop &shop, bool json);
Exit command_show(const Shop &shop, const SceneRequest &scene, bool json);
Exit command_doctor(const Shop &shop);

struct ExportRequest {
    SceneRequest scene;
    std::string to;
    std::filesystem::path folder;
    std::string onto;    ///< stmap: the surface's name; empty: the only one
    bool strict = false; ///< an export that loses something fails
    int samples_per_pixel = 16;
    std::uint64_t seed = 1;
    double time_limit_s = 600;
};
Exit command_export(const Shop &shop, const ExportRequest &request);

struct RenderRequest {
    SceneRequest scene;
    std::string with = "tracer";
    std::optional<std::filesystem::path> output;
    std::optional<std::filesystem::path> keep; ///< folder for generated inputs and logs
    int samples_per_pixel = 16;
    std::uint64_t seed = 1;
    bool pixel_centres = false;
    std::optional<double> cut_weight; ///< empty: 1e-6 by our tracer, which merges branches, 1e-5 by the others
    std::optional<double> surface_mm; ///< of meshed glass; empty: 1e-3
    std::optional<int> bounces;
    std::optional<double> tolerance; ///< chooses all of the above
    std::string precision = "double", transport = "tree", sampler = "sobol";
    double time_limit_s = 3600;
};
Exit command_render(const Shop &shop, const RenderRequest &request);

struct CheckCommand {
    std::vector<std::string> claims;
    std::string mitsuba;           ///< a file whose picture is judged, in place of `claims`; or empty
    std::vector<std::string> with; ///< empty: all, and a missing one is no error
    std::string preset;            ///< "text", "published" or "both"; empty: both, or text in a quick run
    std::vector<std::string> assignments;
    bool quick = false, dry_run = false;
    std::filesystem::path folder = "threefold-report";
    std::optional<std::string> json, junit;
    std::vector<std::string> injections; ///< RENDERER:FAULT
    std::vector<std::string> images;     ///< RENDERER=FOLDER: pictures made elsewhere
    std::string export_to;               ///< RENDERER=FOLDER: write its scenes, and judge nothing
    int least_replicates = 0;
    std::uint64_t seed = 1;
    double time_limit_s = 7200; // whole pictures of a million pixels take Cycles an hour on two busy cores
    std::string precision = "double";
    std::optional<double> tolerance; ///< of pictures; empty: each claim's own samples
};
Exit command_check(const Shop &shop, const CheckCommand &request);

struct PowerCommand {
    std::vector<std::string> with;    ///< the tracer always; empty: all that are installed, or in a quick run it alone
    std::vector<std::string> without; ///< claims left out
    std::vector<std::string> faults;  ///< empty: all
    bool quick = false;
    std::optional<int> runs; ///< without a fault; empty: 40, or 10 in a quick run
    std::uint64_t seed = 1;
    double time_limit_s = 600;
    std::string precision = "float";
    std::filesystem::path folder = "threefold-report-power";
    std::optional<std::string> json, markdown;
};
Exit command_power(const Shop &shop, const PowerCommand &command);

struct TradeCommand {
    SceneRequest scene;
    std::vector<std::string> with;  ///< empty: all, and a missing one is no error
    std::vector<double> tolerances; ///< empty: 1e-2
    bool quick = false;
    int runs = 5;
    std::optional<double> budget_s; ///< empty: by `quick`
    std::uint64_t seed = 1;
    double time_limit_s = 600;
    std::filesystem::path folder = "threefold-report-trade";
    std::optional<std::string> json, markdown;
};
Exit command_trade(const Shop &shop, const TradeCommand &command);

struct ExtremesCommand {
    std::vector<std::string> with;   ///< empty: all that are installed, or in a quick run the tracer alone
    std::vector<std::string> sweeps; ///< empty: all
    bool quick = false;
    double time_limit_s = 600;
    std::filesystem::path folder = "threefold-report-extremes";
    std::optional<std::string> json;
};
Exit command_extremes(const Shop &shop, const ExtremesCommand &command);

struct ScopeCommand {
    std::vector<std::string> claims; ///< empty: all
    std::string preset = "text";     ///< "text", "published" or "both"
    std::vector<std::string> assignments;
    ScopeSettings settings;
    double impact_mm = 60; ///< of the one ray
    bool quick = false;    ///< closed forms alone
    std::optional<std::string> json, markdown;
};
Exit command_scope(const Shop &shop, const ScopeCommand &command);

struct CompareRequest {
    std::vector<std::filesystem::path> pictures;
    int tile_px = 8;
    double tolerance = 0.01; ///< on a tile's mean, as a share of the pictures' mean radiance
    std::optional<std::filesystem::path> folder;
    std::optional<std::string> json;
};
Exit command_compare(const Shop &shop, const CompareRequest &request);

struct GalleryCommand {
    std::vector<std::string> figures; ///< numbers; empty: all
    std::vector<std::string> with;    ///< empty: all, and a missing one is no error
    std::string preset = "text";
    std::vector<std::string> assignments;
    bool quick = false;
    std::optional<double> scale;          ///< of the study's sizes; empty: by `quick`
    std::optional<int> samples_per_pixel; ///< empty: by `quick`
    std::filesystem::path folder = "threefold-gallery";
    std::uint64_t seed = 1;
    double time_limit_s = 7200;
};
Exit command_gallery(const Shop &shop, const GalleryCommand &command);

/// Those asked for by name, which must be there; all, present or not, when none is named.
std::vector<Witness> asked_witnesses(const std::vector<std::string> &names);
/// The same without those that cannot be used.
std::vector<Witness> usable_witnesses(const std::vector<std::string> &names);

/// Precision, transport and sampler by their names on the command line.
TracerSettings tracer_settings(const std::string &precision, const std::string &transport,
                               const std::string &sampler = "sobol");

/// A line on stderr; where that cannot be written, there is nobody to tell.
void say(const std::string &line);
/// Error(bad_data) for what is no time.
std::chrono::milliseconds to_time_limit(double seconds);

/// Writes to a file, or to stdout for "-".
void write_result(const std::string &where, const std::string &text);

/// Name and version of each library that a picture or a number depends on.
std::vector<std::pair<std::string, std::string>> library_versions();
/// The same, and the renderers that take part.
std::vector<std::pair<std::string, std::string>> versions_with(const std::vector<Witness> &witnesses);

} // namespace threefold
