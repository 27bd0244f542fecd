// SPDX-License-Identifier: MIT
// The options of each command, with their help; where they are put when the command line is read.
#pragma once

#include "tools/command_optics.h"
#include "tools/commands.h"

namespace CLI {
class App;
}

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

} // namespace threefold
