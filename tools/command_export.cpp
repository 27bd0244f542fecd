// SPDX-License-Identifier: MIT
// export: a scene as files for other programs, with a list of what they cannot say.
#include <array>

#include <fmt/format.h>

#include "exporter/blender/blend_file.h"
#include "exporter/blender/cycles.h"
#include "exporter/blender/glb_file.h"
#include "exporter/blender/run_script.h"
#include "exporter/export/delivery.h"
#include "exporter/export/losses.h"
#include "exporter/mesh/obj_file.h"
#include "exporter/mitsuba/write_mitsuba.h"
#include "exporter/povray/povray.h"
#include "exporter/povray/povray_folder.h"
#include "exporter/scene_json.h"
#include "tools/commands.h"
#include "verifier/stmap/stmap.h"

namespace threefold {

namespace {

/// As render and check ask POV-Ray and Cycles: their trees grow too fast for more.
constexpr double cut_weight = 1e-5;

/// The scene as asked, for a command line.
std::string scene_words(const SceneRequest &scene) {
    const std::string what =
        scene.mitsuba.empty() ? shell_quoted(scene.name) : "--mitsuba " + shell_quoted(scene.mitsuba);
    std::string words = fmt::format("{} --preset {}", what, shell_quoted(scene.preset));
    if (!scene.size.empty()) words += " --size " + shell_quoted(scene.size);
    for (const std::string &assignment : scene.assignments) words += " --set " + shell_quoted(assignment);
    return words;
}

/// What render would be told for the same picture; empty where no renderer of ours makes it.
std::string render_command(const Shop &shop, const ExportRequest &request, ExportFormat format) {
    const auto with = [&](std::string_view renderer) {
        return fmt::format("{} render {} --with {} --spp {} --seed {}", shell_quoted(shop.program),
                           scene_words(request.scene), renderer, request.samples_per_pixel, request.seed);
    };
    switch (format) {
    case ExportFormat::blender:
        return with("cycles");
    case ExportFormat::povray:
        return with("povray");
    case ExportFormat::glb:
    case ExportFormat::obj:
    case ExportFormat::mitsuba:
        return with("tracer");
    case ExportFormat::stmap:
        return {};
    }
    return {};
}

Provenance provenance_of(const Shop &shop, const ExportRequest &request, ExportFormat format, const Scene &scene) {
    const SceneRecipe recipe = recipe_of(shop, request.scene);
    const Parameters values = parameters_of(recipe, request.scene);
    Provenance provenance;
    provenance.scene = scene_label(request.scene);
    provenance.preset = request.scene.preset;
    for (const ParameterSpec &s : recipe.parameters) provenance.parameters.emplace_back(s.name, values.text(s.name));
    provenance.scene_hash = scene_hash(scene);
    provenance.version = library_versions().front().second;
    std::string options;
    if (format == ExportFormat::blender || format == ExportFormat::povray || format == ExportFormat::mitsuba)
        options += fmt::format(" --spp {} --seed {}", request.samples_per_pixel, request.seed);
    if (!request.onto.empty()) options += " --onto " + shell_quoted(request.onto);
    provenance.export_command = fmt::format("{} export {} --to {}{} -o FOLDER", shell_quoted(shop.program),
                                            scene_words(request.scene), request.to, options);
    provenance.render_command = render_command(shop, request, format);
    return provenance;
}

std::vector<ExportedFile> make_files(ExportFormat format, ExportJob job, const ExportRequest &request) {
    switch (format) {
    case ExportFormat::blender:
        job.job = for_renderer(cycles_adapter(), job.job);
        return make_blend_file(job, require_blender());
    case ExportFormat::povray:
        job.job = for_renderer(povray_adapter(), job.job);
        return make_povray_folder(job);
    case ExportFormat::glb:
        return make_glb_file(job, require_blender());
    case ExportFormat::obj:
        return make_obj_files(job);
    case ExportFormat::mitsuba:
        return to_mitsuba(job.job.scene, "scene", request.samples_per_pixel, request.seed).files;
    case ExportFormat::stmap:
        return make_stmap_files(job, stmap_target(job.job.scene, request.onto));
    }
    return {};
}

} // namespace

Exit command_export(const Shop &shop, const ExportRequest &request) {
    const ExportFormat format = parse_export_format(request.to);
    if (!request.onto.empty() && format != ExportFormat::stmap)
        throw Error(Exit::usage, "--onto names the surface of an stmap, and this is another format");
    ExportJob job;
    job.job.scene = scene_of(shop, request.scene);
    job.job.samples_per_pixel = request.samples_per_pixel;
    job.job.replicates = {{request.seed, {}}};
    job.job.cut_weight = cut_weight;
    job.job.threads = shop.threads;
    job.time_limit = to_time_limit(request.time_limit_s);
    job.provenance = provenance_of(shop, request, format, job.job.scene);

    const std::vector<std::string> lost = losses(job.job.scene, format);
    const std::string_view title = entry_of(format).title;
    if (request.strict && !lost.empty())
        throw Error(Exit::bad_data,
                    fmt::format("{} cannot say all of {}: {}", title, scene_label(request.scene), lost.front()),
                    fmt::format("without --strict LOSSES.txt lists all {}", lost.size()));
    require_fresh_folder(request.folder); // before anything takes time
    std::vector<ExportedFile> files = make_files(format, job, request);
    files.push_back({"LOSSES.txt", losses_text(lost, format)});
    write_fresh_folder(request.folder, files);

    if (shop.verbosity >= 0) {
        say(lost.empty() ? fmt::format("nothing is lost: {} says all of this scene", title)
                         : fmt::format("{} cannot say:", title));
        for (const std::string &loss : lost) say("  " + loss);
    }
    for (const ExportedFile &file : files) fmt::print("{}\n", (request.folder / file.name).string());
    return Exit::holds;
}

} // namespace threefold
