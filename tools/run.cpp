// SPDX-License-Identifier: MIT
#include "tools/run.h"

#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <iostream>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "exporter/export/format.h"
#include "exporter/process/child.h"
#include "tools/command_optics.h"
#include "tools/commands.h"
#include "tools/scope_options.h"
#include "verifier/studies/extremes.h"
#include "verifier/witness/witness.h"

namespace threefold {

namespace {

/// The first signal asks everything to stop, children included; the second ends us at once.
void install_signal_handlers() {
    struct sigaction action {};
    action.sa_handler = [](int) { interrupt_requested = true; };
    action.sa_flags = SA_RESETHAND;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    std::signal(SIGPIPE, SIG_IGN); // a write that fails is answered where it is made
    std::signal(SIGXFSZ, SIG_IGN);
}

/// A file that is opened where stderr should be would be taken for it.
void open_missing_streams() {
    for (int stream = 0; stream <= 2; ++stream)
        if (fcntl(stream, F_GETFD) == -1 && open("/dev/null", stream == 0 ? O_RDONLY : O_WRONLY) == -1)
            _exit(static_cast<int>(Exit::input_output));
}

/// The file name that we were started by: a user's own program is not called threefold.
std::string program_name(int argc, char **argv) {
    const std::string name = argc > 0 ? std::filesystem::path(argv[0]).filename().string() : "";
    return name.empty() ? "threefold" : name;
}

std::string command_line(int argc, char **argv) {
    std::string all = shell_quoted(program_name(argc, argv));
    for (int i = 1; i < argc; ++i) all += " " + shell_quoted(argv[i]);
    return all;
}

void add_scene_options(CLI::App &command, SceneRequest &scene) {
    command.add_option("scene", scene.name, "Scene of the catalogue (see: threefold list)");
    command.add_option("--mitsuba", scene.mitsuba,
                       "Instead: a scene file of Mitsuba 0.5 to 3 (units: --set file.unit_mm, 10 by default; --verbose "
                       "tells what in it is not used)");
    command
        .add_option("--preset", scene.preset, "Values of the study's wording (text) or of its scene files (published)")
        ->capture_default_str();
    command
        .add_option("--set", scene.assignments,
                    "Change a parameter: name=value (see: threefold show SCENE); repeatable")
        ->allow_extra_args(false);
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
    command.add_option("--seed", request.seed, "blender: seed")->capture_default_str();
    command.add_option("--timeout", request.time_limit_s, "blender, glb: seconds until Blender is given up")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    command.footer("For example:\n"
                   "  threefold export hollow --to blender -o hollow-blend    change the wall in the orb's modifier\n"
                   "  threefold export hollow --set orb.wall_mm=2.72 --to glb -o glb\n"
                   "  threefold export salvator --to stmap --onto robe --size 1024x1024 -o map\n\n"
                   "LOSSES.txt in the folder lists what the format cannot say; README.txt how the files were made.");
}

void add_power_options(CLI::App &command, PowerCommand &power) {
    command.add_flag("--quick", power.quick, "Our tracer alone, and a coarser search for the smallest faults");
    command
        .add_option("--with", power.with,
                    "Honest renderers beside the tracer, which gets the faults (default: all that are installed)")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_option("--without", power.without, "Claims to leave out, comma-separated")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_option("--faults", power.faults, "Only these, comma-separated (see: threefold list)")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_option("--runs", power.runs, "Runs without a fault, to count false alarms (default: 40; --quick: 10)")
        ->check(CLI::Range(0, 100000));
    command
        .add_option("--precision", power.precision,
                    "Tracer: float, as other renderers compute, or double, which sees far smaller faults")
        ->capture_default_str();
    command.add_option("--seed", power.seed, "Seed")->capture_default_str();
    command.add_option("-o,--output", power.folder, "Folder of the study: power.json, power.md, honest pictures")
        ->capture_default_str();
    command.add_option("--json", power.json, "Also write the result as JSON here (-: stdout)");
    command.add_option("--markdown", power.markdown, "Also write the table as a page of Markdown here (-: stdout)");
    command.add_option("--timeout", power.time_limit_s, "Seconds until a renderer is given up")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
}

void add_trade_options(CLI::App &command, TradeCommand &trade) {
    add_scene_options(command, trade.scene);
    command.add_flag("--quick", trade.quick, "Fewer settings, 64 px and less to pay: some minutes");
    command
        .add_option("--with", trade.with,
                    "Renderers, comma-separated: tracer, povray, cycles (default: all that are installed)")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        .add_option("--tolerance", trade.tolerances,
                    "Relative RMS error to be met: over pixels and channels, over the mean radiance (1e-2); "
                    "comma-separated")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::Range(1e-9, 0.999));
    command.add_option("--runs", trade.runs, "Runs of each setting, each with its own seed")
        ->capture_default_str()
        ->check(CLI::Range(2, 1000));
    command
        .add_option("--budget", trade.budget_s,
                    "CPU seconds to see one renderer meet one tolerance (300; --quick: 60); beyond, its law alone speaks")
        ->check(CLI::PositiveNumber);
    command.add_option("--seed", trade.seed, "Seed")->capture_default_str();
    command
        .add_option("-o,--output", trade.folder,
                    "Folder: report.html, trade.json, trade.csv, trade.md, pictures; a killed run goes on there")
        ->capture_default_str();
    command.add_option("--json", trade.json, "Also write the result as JSON here (-: stdout)");
    command.add_option("--markdown", trade.markdown, "Also write the tables as a page of Markdown here (-: stdout)");
    command.add_option("--timeout", trade.time_limit_s, "Seconds until a renderer is given up")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    command.footer(
        "For example:\n"
        "  threefold trade hollow --quick                              some minutes, all renderers\n"
        "  threefold trade hollow --set orb.wall_mm=4 --tolerance 1e-2,3e-3 -o trade\n"
        "  threefold trade furnace --with tracer,povray                against a closed form\n\n"
        "Each knob is swept, each setting run with several seeds, all renderers in turn; the error is split into noise and\n"
        "bias against a closed form where there is one, else against a converged picture of our tracer. The cheapest\n"
        "setting that should meet the tolerance is rendered with fresh seeds, and the next one where it does not.\n"
        "Exit code 0: a setting of every renderer was seen to meet every tolerance; 2: not.");
}

void add_extremes_options(CLI::App &command, ExtremesCommand &extremes) {
    command.footer(
        "Each sweep leads one number of a plain scene to its extreme: the wall from 0.1 R to 1e-9 R, the index to\n"
        "1 + 1e-9, rays to 1e-12 of an edge, the scene to 1e9 times its size or 1e8 R from the origin, the eye to the\n"
        "glass, the field of view to 1e-6 and 179 degrees, light to thousands of reflections. Every point is a real\n"
        "render of 13 x 13 pixels, held against quad precision, and is\n"
        "  right       within what was stated beforehand, and not visible (1e-3 R on the card, 1e-2 of the light)\n"
        "  degraded    visible but stated, or invisible but beyond what was stated\n"
        "  wrong       visible and beyond what was stated, or no number\n"
        "  unresolved  too near to an edge for the stated accuracy: nothing was promised\n"
        "  refused     with the limit and the reason, before rendering\n"
        "Exit code 0: our tracer in double is right at all points that it answers for, and nobody is wrong; else 1.\n\n"
        "  threefold extremes -o extremes                       all sweeps, all renderers: some ten minutes\n"
        "  threefold extremes --quick                           our tracer in double and float, seconds\n"
        "  threefold extremes --sweeps wall,backdrop --with tracer,povray");
    command.add_flag("--quick", extremes.quick, "Every third point or so, and our tracer alone unless --with says more");
    command
        .add_option("--with", extremes.with,
                    "Renderers, comma-separated: tracer, povray, cycles (default: all that are installed); the tracer "
                    "takes part in double and in float")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        .add_option("--sweeps", extremes.sweeps,
                    fmt::format("Only these, comma-separated: {}", fmt::join(extreme_sweep_names(), ", ")))
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        .add_option("-o,--output", extremes.folder,
                    "Folder of the study: extremes.svg (the map), extremes.md, extremes.json, inputs, pictures, logs; a "
                    "killed study goes on there")
        ->capture_default_str();
    command.add_option("--json", extremes.json, "Also write the result as JSON here (-: stdout)");
    command.add_option("--timeout", extremes.time_limit_s, "Seconds until a renderer is given up")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
}

} // namespace

int run(int argc, char **argv, const std::vector<SceneRecipe> &scenes, const std::vector<Claim> &claims) {
    open_missing_streams();
    CLI::App app{
        "Does a conclusion about a glass orb hold in physics, or only in one renderer?\n"
        "A scene is rendered by POV-Ray, Blender Cycles and Threefold's own tracer, measured by the same code, held\n"
        "against exact optics, and judged: holds, fails, or undecided.\n",
        program_name(argc, argv)};
    app.footer(
        "Start here:\n"
        "  threefold render hollow                  a first picture (hollow.exr, hollow.png)\n"
        "  threefold check --quick                  all claims in all renderers, with a report\n"
        "  threefold check solid-vs-hollow --set glass.index=1.1 -o water\n"
        "  threefold power --quick                  which known faults the check catches, and how small\n"
        "  threefold trade hollow --quick           what accuracy costs in each renderer\n"
        "  threefold scope                          what the claims leave out, and whether it matters\n"
        "  threefold optics --impact-mm 60          the closed forms for one ray\n\n"
        "Exit codes: 0 holds, 1 fails, 2 undecided, 64 usage, 65 bad input, 69 renderer missing, 70 a defect of ours,\n"
        "74 input or output failed, 124 a renderer ran out of time, 130 interrupted.");
    app.require_subcommand(1);
    app.set_version_flag("--version", [] {
        std::string all;
        for (const auto &[name, version] : library_versions()) all += fmt::format("{} {}\n", name, version);
        for (const Witness &w : find_witnesses(witness_names()))
            if (w.adapter) all += fmt::format("{} {}\n", w.title, w.installed ? w.installed->version : "not installed");
        return all.substr(0, all.size() - 1);
    });

    Shop shop{scenes, claims, program_name(argc, argv), command_line(argc, argv), 0, 0};
    Exit exit = Exit::holds;
    bool quiet = false, verbose = false;
    const auto add_common = [&](CLI::App &command) {
        command.add_flag("-q,--quiet", quiet, "Say only the result");
        command.add_flag("-v,--verbose", verbose, "Say more: every number, every note");
        command.add_option("--threads", shop.threads, "Threads to use (0: all cores)")->check(CLI::NonNegativeNumber);
    };

    bool list_json = false;
    CLI::App &list = *app.add_subcommand("list", "Scenes, claims and faults there are");
    list.add_flag("--json", list_json, "As JSON on stdout");

    SceneRequest show_scene;
    bool show_json = false;
    CLI::App &show =
        *app.add_subcommand("show", "A scene's parameters with units, ranges and both presets, and what it needs");
    add_scene_options(show, show_scene);
    show.add_flag("--json", show_json, "Parameters and the whole scene as JSON on stdout");
    show.add_flag("-v,--verbose", verbose, "Also say what in a Mitsuba file is read otherwise, or not used");

    CLI::App &doctor = *app.add_subcommand("doctor", "What is installed here, and does it work?");
    add_common(doctor);

    ExportRequest export_request;
    CLI::App &export_ = *app.add_subcommand("export", "A scene as files for another program, in a new folder");
    add_export_options(export_, export_request);
    add_common(export_);

    RenderRequest render_request;
    CLI::App &render = *app.add_subcommand("render", "One picture by one renderer");
    add_scene_options(render, render_request.scene);
    render.add_option("--with", render_request.with, "tracer, povray or cycles")->capture_default_str();
    render.add_option("-o,--output", render_request.output,
                      "Picture: .exr (float), .tif (64-bit) or .png; a .png preview is put beside it");
    CLI::Option *spp =
        render.add_option("--spp", render_request.samples_per_pixel, "Samples per pixel")->capture_default_str();
    CLI::Option *tolerance =
        render
            .add_option("--tolerance", render_request.tolerance,
                        "Choose all settings so that the picture's RMS error, over pixels and channels and relative to "
                        "the mean radiance, is at most this: by a pilot on this very scene; noise and offset from our "
                        "tracer's picture together (our tracer: noise, and what it dropped). Exit code 2 if it is not met")
            ->check(CLI::Range(1e-9, 0.999))
            ->excludes(spp);
    render.add_option("--seed", render_request.seed, "Seed")->capture_default_str();
    render.add_flag("--pixel-centres", render_request.pixel_centres, "One ray through each pixel's centre, no filter")
        ->excludes(tolerance);
    render
        .add_option("--surface-mm", render_request.surface_mm,
                    "Cycles: greatest distance of a meshed glass sphere from the true one (1e-3)")
        ->check(CLI::PositiveNumber)
        ->excludes(tolerance);
    render.add_option("--bounces", render_request.bounces, "Cycles, POV-Ray: surfaces on a path (as many as it can)")
        ->check(CLI::Range(1, 256))
        ->excludes(tolerance);
    render
        .add_option("--cut", render_request.cut_weight,
                    "Weight at which a ray tree may be cut (1e-6; 1e-5 where branches are not merged: POV-Ray)")
        ->check(CLI::Range(1e-12, 0.5))
        ->excludes(tolerance);
    render.add_option("--precision", render_request.precision, "Tracer: float or double")
        ->capture_default_str()
        ->excludes(tolerance);
    render.add_option("--transport", render_request.transport, "Tracer: tree (all branches) or roulette")
        ->capture_default_str()
        ->excludes(tolerance);
    render
        .add_option("--sampler", render_request.sampler,
                    "Tracer: where in a pixel samples lie: sobol (scrambled, the least noise), stratified or random")
        ->capture_default_str()
        ->excludes(tolerance);
    render.add_option("--keep", render_request.keep, "Keep generated inputs, log and raw pictures in this folder");
    render.add_option("--timeout", render_request.time_limit_s, "Seconds until a renderer is given up")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    add_common(render);

    CheckCommand check_command;
    CLI::App &check = *app.add_subcommand("check", "Judge claims: render, measure, compare with exact optics, report");
    check.add_option("claims", check_command.claims, "Claims (see: threefold list); none: all");
    check.add_option("--mitsuba", check_command.mitsuba,
                     "Instead: whether a Mitsuba 0.5 to 3 file is the same picture in every renderer, tile by tile (its "
                     "parameters: threefold show --mitsuba FILE)");
    check.add_flag("--quick", check_command.quick, "Smaller pictures: an answer in two minutes or so");
    check
        .add_option("--with", check_command.with,
                    "Renderers, comma-separated: tracer, povray, cycles (default: all that are installed)")
        ->delimiter(',')
        ->allow_extra_args(false);
    check.add_option("--preset", check_command.preset,
                     "Values of the study's wording (text), of its scene files (published), or both (the default; with "
                     "--quick: text)");
    check
        .add_option("--set", check_command.assignments,
                    "Change a parameter of every scene that has it: name=value; repeatable")
        ->allow_extra_args(false);
    check
        .add_option("-o,--output", check_command.folder,
                    "Folder of the run: report.html, result.json, inputs, pictures, logs; a killed run goes on there")
        ->capture_default_str();
    check.add_option("--json", check_command.json, "Also write the result as JSON here (-: stdout)");
    check.add_option("--junit", check_command.junit, "Also write the result as JUnit XML here");
    check
        .add_option(
            "--inject", check_command.injections,
            "Put a fault into one renderer, RENDERER:FAULT or RENDERER:FAULT@SIZE, to see that a claim can fail "
            "(see: threefold list)")
        ->allow_extra_args(false);
    check.add_option("--seed", check_command.seed, "Seed")->capture_default_str();
    check.add_option("--timeout", check_command.time_limit_s, "Seconds until a renderer is given up")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    check
        .add_option("--tolerance", check_command.tolerance,
                    "Choose each renderer's samples by a pilot so that the mean picture of every experiment has at most "
                    "this RMS noise, relative to its mean radiance. Tiles never get more than their budget allows, "
                    "numbers never fewer samples than their claim asks (default: the claims' own samples)")
        ->check(CLI::Range(1e-9, 0.999));
    check.add_option("--precision", check_command.precision, "Tracer: float or double")->capture_default_str();
    check
        .add_option("--image", check_command.images,
                    "One more witness, mitsuba=FOLDER: pictures made elsewhere, of the scenes that --export wrote with "
                    "the same claims, options and seed")
        ->allow_extra_args(false);
    check.add_option("--export", check_command.export_to,
                     "Only write, mitsuba=FOLDER (new, or empty): each experiment's scene as Mitsuba 3 XML and a "
                     "script that renders them; what Mitsuba cannot say is left out and told");
    check.add_flag("--dry-run", check_command.dry_run, "Say what would be rendered");
    add_common(check);

    GalleryCommand gallery_command;
    CLI::App &gallery =
        *app.add_subcommand("gallery", "The study's figures, once per renderer, with an index and a contact sheet");
    gallery.add_option("figures", gallery_command.figures, "Figures (1B, 2, 3A, ...); none: all");
    gallery
        .add_option("--with", gallery_command.with,
                    "Renderers, comma-separated: tracer, povray, cycles (default: all that are installed)")
        ->delimiter(',')
        ->allow_extra_args(false);
    gallery
        .add_option("--preset", gallery_command.preset,
                    "Values of the study's wording (text) or of its scene files (published)")
        ->capture_default_str();
    gallery
        .add_option("--set", gallery_command.assignments,
                    "Change a parameter of every scene that has it: name=value; repeatable")
        ->allow_extra_args(false);
    gallery.add_option("--scale", gallery_command.scale,
                       "Size of the pictures as a share of the study's (0.5; with --quick: 0.25)");
    gallery.add_option("--spp", gallery_command.samples_per_pixel, "Samples per pixel (9; with --quick: 4)");
    gallery.add_flag("--quick", gallery_command.quick, "Small and coarse, to see what there is");
    gallery
        .add_option("-o,--output", gallery_command.folder,
                    "Folder: index.html, contact-sheet.png, pictures; a killed run goes on there")
        ->capture_default_str();
    gallery.add_option("--seed", gallery_command.seed, "Seed")->capture_default_str();
    gallery.add_option("--timeout", gallery_command.time_limit_s, "Seconds until a renderer is given up")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    add_common(gallery);
    PowerCommand power_command;
    add_power_options(
        *app.add_subcommand("power", "Known faults: which our check catches, how small, and which others' tests would"),
        power_command);
    CLI::App &power = *app.get_subcommand("power");
    add_common(power);

    TradeCommand trade_command;
    CLI::App &trade = *app.add_subcommand("trade", "What accuracy costs: error against time for every renderer and knob");
    add_trade_options(trade, trade_command);
    add_common(trade);

    ExtremesCommand extremes_command;
    CLI::App &extremes = *app.add_subcommand(
        "extremes", "Where arithmetic ends in each renderer, and whether it says so: a map against quad precision");
    add_extremes_options(extremes, extremes_command);
    add_common(extremes);

    ScopeCommand scope_command;
    add_scope_options(
        *app.add_subcommand("scope", "What each claim leaves out, and how far it could move the claim's numbers"),
        scope_command);
    CLI::App &scope = *app.get_subcommand("scope");
    add_common(scope);

    CompareRequest compare_request;
    CLI::App &compare = *app.add_subcommand("compare", "Two or three pictures, tile by tile");
    compare.add_option("pictures", compare_request.pictures, "Pictures of the same size (EXR, TIFF, PNG, ...)")
        ->required()
        ->expected(2, 3);
    compare.add_option("--tile", compare_request.tile_px, "Tile size in pixels")->capture_default_str();
    compare.add_option("--tolerance", compare_request.tolerance, "On a tile's mean, as a share of the mean radiance")
        ->capture_default_str();
    compare.add_option("-o,--output", compare_request.folder, "Folder for difference maps");
    compare.add_option("--json", compare_request.json, "Write the numbers as JSON here (-: stdout)");
    add_common(compare);

    OpticsQuery optics_query;
    CLI::App &optics = *app.add_subcommand("optics", "The closed forms as a calculator: one ray, or a file of rows");
    optics.add_option("--outer-mm", optics_query.outer_mm, "Outer radius")->capture_default_str();
    optics.add_option("--wall-mm", optics_query.wall_mm, "Wall of a hollow orb")->capture_default_str();
    optics.add_flag("--solid", optics_query.solid, "A solid orb");
    optics.add_option("--index", optics_query.index, "Index of the glass")->capture_default_str();
    optics.add_option("--impact-mm", optics_query.impact_mm, "Distance of the ray's line from the centre")
        ->capture_default_str();
    optics.add_option("--eye-mm", optics_query.eye_mm, "Eye to orb centre")->capture_default_str();
    optics.add_option("--plane-mm", optics_query.plane_mm, "Orb centre to the plane behind it")->capture_default_str();
    optics.add_option("--rows", optics_query.rows_file,
                      "Answer every row of a JSON file: R_mm r_mm n b_mm eye_mm plane_mm as decimal strings. A b_mm of "
                      "25 digits that is a share of the clear radius, cut off by the print, is taken whole");
    optics.add_option("--precision", optics_query.precision, "double or quad")->capture_default_str();
    optics.add_option("--json", optics_query.json, "Write JSON here (-: stdout)");

    const auto refuse = [](const Error &error) {
        say(fmt::format("threefold: {}{}", error.what(), error.hint().empty() ? "" : " (" + error.hint() + ")"));
        return static_cast<int>(error.code());
    };
    try {
        // The parser would only say that a command is missing.
        std::vector<std::string> commands;
        for (const CLI::App *command : app.get_subcommands({})) commands.push_back(command->get_name());
        if (argc > 1 && argv[1][0] != '-' && std::ranges::count(commands, argv[1]) == 0)
            throw Error(Exit::usage, unknown_name("command", argv[1], commands));
        app.parse(argc, argv);
        shop.verbosity = quiet ? -1 : verbose ? 1 : 0;
        install_signal_handlers();
        if (list) exit = command_list(shop, list_json);
        if (show) exit = command_show(shop, show_scene, show_json);
        if (doctor) exit = command_doctor(shop);
        if (export_) exit = command_export(shop, export_request);
        if (render) exit = command_render(shop, render_request);
        if (check) exit = command_check(shop, check_command);
        if (gallery) exit = command_gallery(shop, gallery_command);
        if (power) exit = command_power(shop, power_command);
        if (trade) exit = command_trade(shop, trade_command);
        if (extremes) exit = command_extremes(shop, extremes_command);
        if (scope) exit = command_scope(shop, scope_command);
        if (compare) exit = command_compare(shop, compare_request);
        if (optics) exit = static_cast<Exit>(run_optics(optics_query, std::cout));
        std::cout.flush();
        if (std::fflush(stdout) != 0 || !std::cout) throw Error(Exit::input_output, "cannot write to stdout");
        return static_cast<int>(exit);
    } catch (const CLI::ParseError &error) {
        if (error.get_exit_code() == 0) return app.exit(error); // --help, --version
        return refuse(Error(Exit::usage, error.what()));
    } catch (const Error &error) {
        return refuse(error);
    } catch (const std::system_error &error) { // files, pipes, a full stdout
        return refuse(Error(Exit::input_output, error.what()));
    } catch (const std::bad_alloc &) {
        return refuse(Error(Exit::bad_data, "out of memory: make the picture smaller"));
    } catch (const std::exception &error) {
        return refuse(Error(Exit::internal, fmt::format("a defect of Threefold: {}", error.what())));
    }
}

} // namespace threefold
