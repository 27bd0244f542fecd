// SPDX-License-Identifier: MIT
#include "tools/options.h"

#include <CLI/CLI.hpp>

namespace threefold {

void add_check_options(CLI::App &command, CheckCommand &request) {
    command.add_option("claims", request.claims, "Claims (see: threefold list); none: all");
    command.add_option(
        "--mitsuba", request.mitsuba,
        "Instead: whether a Mitsuba 0.5 to 3 file is the same picture in every renderer, tile by tile (its "
        "parameters: threefold show --mitsuba FILE)");
    command.add_flag("--quick", request.quick, "Smaller pictures and one preset; README.md says how long it takes");
    add_renderers_option(command, request.with);
    command.add_option(
        "--preset", request.preset,
        "Values of the study's wording (text), of its scene files (published), or both (the default; with "
        "--quick: text)");
    add_set_option(command, request.assignments);
    command
        .add_option("-o,--output", request.folder,
                    "Folder of the run: report.html, result.json, inputs, pictures, logs; a killed run goes on there")
        ->capture_default_str();
    add_json_option(command, request.json);
    command.add_option("--junit", request.junit, "Also write the result as JUnit XML here");
    one_or_many(command.add_option("--inject", request.injections,
                                   "Put a fault, or FAULT@SIZE, into one renderer, to see that a claim can fail "
                                   "(see: threefold list)"),
                "RENDERER:FAULT");
    add_seed_option(command, request.seed);
    command
        .add_option(
            "--replicates", request.least_replicates,
            "At least so many replicates of each experiment, with --export and --image: what \"would decide\" a "
            "number whose pictures are made elsewhere")
        ->check(CLI::Range(2, 1000));
    add_time_limit_option(command, request.time_limit_s, "Seconds until a renderer is given up on one experiment");
    command
        .add_option(
            "--tolerance", request.tolerance,
            "Choose each renderer's samples by a pilot so that the mean picture of every experiment has at most "
            "this RMS noise, relative to its mean radiance. Tiles never get more than their budget allows, "
            "numbers never fewer samples than their claim asks (default: the claims' own samples)")
        ->check(CLI::Range(1e-9, 0.999));
    command.add_option("--precision", request.precision, "Tracer: float or double")->capture_default_str();
    one_or_many(command.add_option("--image", request.images,
                                   "One more renderer: pictures made elsewhere, of the scenes that --export wrote "
                                   "with the same claims, options and seed"),
                "mitsuba=FOLDER");
    command.add_option("--export", request.export_to,
                       "Only write, mitsuba=FOLDER (new, or empty): each experiment's scene as Mitsuba 3 XML and a "
                       "script that renders them; what Mitsuba cannot say is left out and told");
    command.add_flag("--dry-run", request.dry_run, "Say what would be rendered");
}

void add_compare_options(CLI::App &command, CompareRequest &request) {
    command.add_option("pictures", request.pictures, "Pictures of the same size (EXR, TIFF, PNG, ...)")
        ->required()
        ->expected(2, 3);
    command.add_option("--tile", request.tile_px, "Tile size in pixels")->capture_default_str();
    command.add_option("--tolerance", request.tolerance, "On a tile's mean, as a share of the mean radiance")
        ->capture_default_str();
    command.add_option("-o,--output", request.folder, "Folder for difference maps");
    command.add_option("--json", request.json, "Write the numbers as JSON here (-: stdout)");
}

void add_optics_options(CLI::App &command, OpticsQuery &request) {
    command.add_option("--outer-mm", request.outer_mm, "Outer radius")->capture_default_str();
    command.add_option("--wall-mm", request.wall_mm, "Wall of a hollow orb")->capture_default_str();
    command.add_flag("--solid", request.solid, "A solid orb");
    command.add_option("--index", request.index, "Index of the glass")->capture_default_str();
    command.add_option("--impact-mm", request.impact_mm, "Distance of the ray's line from the centre")
        ->capture_default_str();
    command.add_option("--eye-mm", request.eye_mm, "Eye to orb centre")->capture_default_str();
    command.add_option("--plane-mm", request.plane_mm, "Orb centre to the plane behind it")->capture_default_str();
    command.add_option(
        "--rows", request.rows_file,
        "Answer every row of a JSON file: R_mm r_mm n b_mm eye_mm plane_mm as decimal strings. A b_mm of "
        "25 digits that is a share of the clear radius, cut off by the print, is taken whole");
    command.add_option("--precision", request.precision, "double or quad")->capture_default_str();
    command.add_option("--json", request.json, "Write JSON here (-: stdout)");
}

} // namespace threefold
