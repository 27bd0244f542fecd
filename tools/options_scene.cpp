// SPDX-License-Identifier: MIT
#include "tools/options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "exporter/export/format.h"

namespace threefold {

void add_scene_options(CLI::App &command, SceneRequest &scene) {
    command.add_option("scene", scene.name, "Scene of the catalogue (see: threefold list)");
    command.add_option("--mitsuba", scene.mitsuba,
                       "Instead: a scene file of Mitsuba 0.5 to 3 (units: --set file.unit_mm, 10 by default; --verbose "
                       "tells also what in it is not used without changing the picture)");
    command
        .add_option("--preset", scene.preset, "Values of the study's wording (text) or of its scene files (published)")
        ->capture_default_str();
    add_set_option(command, scene.assignments, "Change a parameter: orb.wall_mm=2 (see: threefold show SCENE)");
    command.add_option("--size", scene.size, "Picture size in pixels, WIDTHxHEIGHT");
}

void add_export_options(CLI::App &command, ExportRequest &request) {
    add_scene_options(command, request.scene);
    std::string formats = "Format:";
    for (const ExportFormatEntry &entry : export_formats())
        formats += fmt::format("\n  {}: {}", entry.name, entry.summary);
    command.add_option("--to", request.to, formats)->required();
    command.add_option("-o,--output", request.folder, "Folder for the files: new, or empty")->required();
    command.add_flag("--strict", request.strict,
                     "Fail (65) rather than lose anything; without it LOSSES.txt says what is lost");
    command.add_option("--onto", request.onto, "stmap: name of the surface to map, where there are several");
    command.add_option("--spp", request.samples_per_pixel, "blender, povray: samples per pixel, as render takes them")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    add_seed_option(command, request.seed, "blender: seed");
    add_time_limit_option(command, request.time_limit_s, "blender, glb: seconds until Blender is given up");
    command.footer("For example:\n"
                   "  threefold export hollow --to blender -o hollow-blend    change the wall in the orb's modifier\n"
                   "  threefold export hollow --set orb.wall_mm=2.72 --to glb -o glb\n"
                   "  threefold export salvator --to stmap --onto robe --size 1024x1024 -o map\n\n"
                   "LOSSES.txt in the folder lists what the format cannot say; README.txt how the files were made.");
}

void add_render_options(CLI::App &command, RenderRequest &request) {
    add_scene_options(command, request.scene);
    command.add_option("--with", request.with, "tracer, povray or cycles")->capture_default_str();
    command.add_option("-o,--output", request.output,
                       "Picture: .exr (float), .tif (64-bit) or .png; a .png preview is put beside it");
    CLI::Option *spp =
        command.add_option("--spp", request.samples_per_pixel, "Samples per pixel")->capture_default_str();
    CLI::Option *tolerance =
        command
            .add_option(
                "--tolerance", request.tolerance,
                "Choose all settings so that the picture's RMS error, over pixels and channels and relative to "
                "the mean radiance, is at most this with a confidence of 95 %: by a pilot on this very scene; noise "
                "and offset from our tracer's picture together (our tracer: noise, and what it dropped). Exit code 2 "
                "if that is not shown")
            ->check(CLI::Range(1e-9, 0.999))
            ->excludes(spp);
    add_seed_option(command, request.seed);
    command.add_flag("--pixel-centres", request.pixel_centres, "One ray through each pixel's centre, no filter")
        ->excludes(tolerance);
    command
        .add_option("--surface-mm", request.surface_mm,
                    "Cycles: greatest distance of a meshed glass sphere from the true one (1e-3)")
        ->check(CLI::PositiveNumber)
        ->excludes(tolerance);
    command.add_option("--bounces", request.bounces, "Cycles, POV-Ray: surfaces on a path (as many as it can)")
        ->check(CLI::Range(1, 256))
        ->excludes(tolerance);
    command
        .add_option("--cut", request.cut_weight,
                    "Weight at which a ray tree may be cut (1e-6; 1e-5 where branches are not merged: POV-Ray)")
        ->check(CLI::Range(1e-12, 0.5))
        ->excludes(tolerance);
    command.add_option("--precision", request.precision, "Tracer: float or double")
        ->capture_default_str()
        ->excludes(tolerance);
    command.add_option("--transport", request.transport, "Tracer: tree (all branches) or roulette")
        ->capture_default_str()
        ->excludes(tolerance);
    command
        .add_option("--sampler", request.sampler,
                    "Tracer: where in a pixel samples lie: sobol (scrambled, the least noise), stratified or random")
        ->capture_default_str()
        ->excludes(tolerance);
    command.add_option("--keep", request.keep, "Keep generated inputs, log and raw pictures in this folder");
    add_time_limit_option(command, request.time_limit_s);
}

void add_gallery_options(CLI::App &command, GalleryCommand &request) {
    command.add_option("figures", request.figures, "Figures (1B, 2, 3A, ...); none: all");
    add_renderers_option(command, request.with);
    command
        .add_option("--preset", request.preset,
                    "Values of the study's wording (text) or of its scene files (published)")
        ->capture_default_str();
    add_set_option(command, request.assignments);
    command.add_option("--scale", request.scale,
                       "Size of the pictures as a share of the study's (0.5; with --quick: 0.25)");
    command.add_option("--spp", request.samples_per_pixel, "Samples per pixel (9; with --quick: 4)");
    command.add_flag("--quick", request.quick, "Small and coarse, to see what there is");
    command
        .add_option("-o,--output", request.folder,
                    "Folder: index.html, contact-sheet.png, pictures; a killed run goes on there")
        ->capture_default_str();
    add_seed_option(command, request.seed);
    add_time_limit_option(command, request.time_limit_s);
}

} // namespace threefold
