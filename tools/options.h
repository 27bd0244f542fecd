// SPDX-License-Identifier: MIT
// The options of each command, with their help; where they are put when the command line is read.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/command_optics.h"
#include "tools/commands.h"

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace threefold {

void add_scene_options(CLI::App &command, SceneRequest &scene);
void add_render_options(CLI::App &command, RenderRequest &request);
void add_export_options(CLI::App &command, ExportRequest &request);
void add_gallery_options(CLI::App &command, GalleryCommand &request);

void add_check_options(CLI::App &command, CheckCommand &request);
void add_compare_options(CLI::App &command, CompareRequest &request);
void add_optics_options(CLI::App &command, OpticsQuery &request);

void add_power_options(CLI::App &command, PowerCommand &power);
void add_trade_options(CLI::App &command, TradeCommand &trade);
void add_extremes_options(CLI::App &command, ExtremesCommand &extremes);
void add_scope_options(CLI::App &command, ScopeCommand &scope);

/// Options that several commands share.
/// --set, once or many times, with one or many assignments.
CLI::Option *add_set_option(CLI::App &command, std::vector<std::string> &assignments,
                            std::string_view help = "Change a parameter of every scene that has it: orb.wall_mm=2");
/// Declares an option that takes comma-separated words, as its help shows.
CLI::Option *comma_separated(CLI::Option *option, std::string_view what);
/// Declares an option that takes one or many words of a form in which no positional argument can be.
CLI::Option *one_or_many(CLI::Option *option, std::string_view form);
/// "--set a=1 b=2 hollow" as "--set a=1 --set b=2 hollow": a word belongs to the option as long as it has its form.
std::vector<std::string> repeat_options(const std::vector<std::string> &arguments);
CLI::Option *
add_renderers_option(CLI::App &command, std::vector<std::string> &with,
                     std::string_view help = "Renderers, comma-separated: tracer, povray, cycles (default: "
                                             "all that are installed)");
CLI::Option *add_time_limit_option(CLI::App &command, double &seconds,
                                   std::string_view help = "Seconds until a renderer is given up");
CLI::Option *add_seed_option(CLI::App &command, std::uint64_t &seed, std::string_view help = "Seed");
CLI::Option *add_json_option(CLI::App &command, std::optional<std::string> &file);

} // namespace threefold
