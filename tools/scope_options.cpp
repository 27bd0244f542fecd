// SPDX-License-Identifier: MIT
#include "tools/scope_options.h"

#include <CLI/CLI.hpp>

namespace threefold {

void add_scope_options(CLI::App &command, ScopeCommand &scope) {
    ScopeSettings &s = scope.settings;
    command.add_option("claims", scope.claims, "Claims (see: threefold list); none: all");
    command
        .add_option("--preset", scope.preset, "Values of the study's wording (text), of its scene files (published), or "
                                              "both")
        ->capture_default_str();
    command
        .add_option("--set", scope.assignments, "Change a parameter of every scene that has it: name=value; repeatable")
        ->allow_extra_args(false);
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
    command.add_option("--json", scope.json, "Also write the result as JSON here (-: stdout)");
    command.add_option("--markdown", scope.markdown, "Also write it as a page of Markdown here (-: stdout)");
    command.footer("Every model leaves something out. For each claim and each effect this says how far the effect could\n"
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
