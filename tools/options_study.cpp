// SPDX-License-Identifier: MIT
#include "tools/options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "verifier/studies/extremes.h"

namespace threefold {

void add_power_options(CLI::App &command, PowerCommand &power) {
    command.add_flag("--quick", power.quick, "Our tracer alone, and a coarser search for the smallest faults");
    add_renderers_option(command, power.with,
                         "Honest renderers beside the tracer, which gets the faults (default: all that are installed)");
    comma_separated(command.add_option("--without", power.without, "Claims to leave out, comma-separated"), "CLAIM");
    comma_separated(command.add_option("--faults", power.faults, "Only these, comma-separated (see: threefold list)"),
                    "FAULT");
    command.add_option("--runs", power.runs, "Runs without a fault, to count false alarms (default: 40; --quick: 10)")
        ->check(CLI::Range(0, 100000));
    command
        .add_option("--precision", power.precision,
                    "Tracer: float, as other renderers compute, or double, which sees far smaller faults")
        ->capture_default_str();
    add_seed_option(command, power.seed);
    command.add_option("-o,--output", power.folder, "Folder of the study: power.json, power.md, honest pictures")
        ->capture_default_str();
    add_json_option(command, power.json);
    command.add_option("--markdown", power.markdown, "Also write the table as a page of Markdown here (-: stdout)");
    add_time_limit_option(command, power.time_limit_s);
}

void add_trade_options(CLI::App &command, TradeCommand &trade) {
    add_scene_options(command, trade.scene);
    command.add_flag("--quick", trade.quick, "Fewer settings, 64 px and less to pay: some minutes");
    add_renderers_option(command, trade.with);
    comma_separated(command.add_option("--tolerance", trade.tolerances,
                                       "Relative RMS error to be met: over pixels and channels, over the mean "
                                       "radiance (1e-2); comma-separated"),
                    "FLOAT")
        ->check(CLI::Range(1e-9, 0.999));
    command.add_option("--runs", trade.runs, "Runs of each setting, each with its own seed")
        ->capture_default_str()
        ->check(CLI::Range(2, 1000));
    command
        .add_option(
            "--budget", trade.budget_s,
            "CPU seconds to see one renderer meet one tolerance (300; --quick: 60); beyond, its law alone speaks")
        ->check(CLI::PositiveNumber);
    add_seed_option(command, trade.seed);
    command
        .add_option("-o,--output", trade.folder,
                    "Folder: report.html, trade.json, trade.csv, trade.md, pictures; a killed run goes on there")
        ->capture_default_str();
    add_json_option(command, trade.json);
    command.add_option("--markdown", trade.markdown, "Also write the tables as a page of Markdown here (-: stdout)");
    add_time_limit_option(command, trade.time_limit_s);
    command.footer(
        "For example:\n"
        "  threefold trade hollow --quick                              some minutes, all renderers\n"
        "  threefold trade hollow --set orb.wall_mm=4 --tolerance 1e-2,3e-3 -o trade\n"
        "  threefold trade furnace --with tracer,povray                against a closed form\n\n"
        "Each knob is swept, each setting run with several seeds, all renderers in turn; the error is split into noise "
        "and\n"
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
    command.add_flag("--quick", extremes.quick,
                     "Every third point or so, and our tracer alone unless --with says more");
    add_renderers_option(
        command, extremes.with,
        "Renderers, comma-separated: tracer, povray, cycles (default: all that are installed); the tracer "
        "takes part in double and in float");
    comma_separated(
        command.add_option("--sweeps", extremes.sweeps,
                           fmt::format("Only these, comma-separated: {}", fmt::join(extreme_sweep_names(), ", "))),
        "SWEEP");
    command
        .add_option(
            "-o,--output", extremes.folder,
            "Folder of the study: extremes.svg (the map), extremes.md, extremes.json, inputs, pictures, logs; a "
            "killed study goes on there")
        ->capture_default_str();
    add_json_option(command, extremes.json);
    add_time_limit_option(command, extremes.time_limit_s);
}

void add_scope_options(CLI::App &command, ScopeCommand &scope) {
    ScopeSettings &s = scope.settings;
    command.add_option("claims", scope.claims, "Claims (see: threefold list); none: all");
    command
        .add_option("--preset", scope.preset,
                    "Values of the study's wording (text), of its scene files (published), or "
                    "both")
        ->capture_default_str();
    add_set_option(command, scope.assignments);
    command.add_flag("--quick", scope.quick, "Closed forms alone: what only a picture could tell is not asked");
    command.add_option("--abbe", s.abbe_number, "Dispersion: the glass's Abbe number (crown 64, flint 36)")
        ->capture_default_str()
        ->check(CLI::Range(1.0, 1e6));
    command.add_option("--from-nm", s.least_wavelength_nm, "Dispersion: least wavelength")
        ->capture_default_str()
        ->check(CLI::Range(300.0, 2000.0));
    command.add_option("--to-nm", s.greatest_wavelength_nm, "Dispersion: greatest wavelength")
        ->capture_default_str()
        ->check(CLI::Range(300.0, 2000.0));
    command
        .add_option("--absorption-per-mm", s.absorption_per_mm,
                    "Absorption, natural logarithm (optical crown 0.0003, window glass 0.005)")
        ->capture_default_str()
        ->check(CLI::NonNegativeNumber);
    command
        .add_option("--strain", s.strain_nm_per_cm,
                    "Birefringence of strained glass, nm of path difference per cm (fine annealed 5, hardly 100)")
        ->capture_default_str()
        ->check(CLI::NonNegativeNumber);
    command.add_option("--light-deg", s.light_deg, "Angle across a light (the sun 0.53)")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 60.0));
    command.add_option("--pupil-mm", s.pupil_mm, "Diameter of the eye's pupil (2 in sunlight, 7 in the dark)")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 50.0));
    command.add_option("--calcite-abbe-o", s.calcite_abbe_ordinary, "Abbe number of calcite's ordinary ray")
        ->capture_default_str()
        ->check(CLI::Range(1.0, 1e6));
    command.add_option("--calcite-abbe-e", s.calcite_abbe_extraordinary, "Abbe number of its extraordinary ray")
        ->capture_default_str()
        ->check(CLI::Range(1.0, 1e6));
    command.add_option("--impact-mm", scope.impact_mm, "The one ray's distance from the axis")->capture_default_str();
    add_json_option(command, scope.json);
    command.add_option("--markdown", scope.markdown, "Also write it as a page of Markdown here (-: stdout)");
    command.footer(
        "Every model leaves something out. For each claim and each effect this says how far the effect could\n"
        "move the claim's numbers (a bound), beside how far they may move before the conclusion changes or a\n"
        "tolerance is left (the margin). Bound over margin: the effect is required, and the claim holds within\n"
        "its model only; `check` says so too. --verbose tells every number.\n\n"
        "For example:\n"
        "  threefold scope                          all claims\n"
        "  threefold scope tint --impact-mm 60      where polarisation matters: 8 %\n"
        "  threefold scope solid-vs-hollow --abbe 36 --set glass.index=1.62\n"
        "  threefold scope white-spots --pupil-mm 7 --light-deg 2");
}

} // namespace threefold
