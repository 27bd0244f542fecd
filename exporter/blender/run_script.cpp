// SPDX-License-Identifier: MIT
#include "exporter/blender/run_script.h"

#include <algorithm>

#include <fmt/format.h>

#include "exporter/blender/cycles.h"
#include "exporter/blender/log.h"
#include "exporter/files.h"
#include "exporter/process/child.h"
#include "exporter/text.h"
#include "scenes/error.h"

namespace threefold {

InstalledRenderer require_blender() {
    const Adapter adapter = cycles_adapter();
    if (auto installed = find_renderer(adapter)) return *std::move(installed);
    throw Error(Exit::renderer_missing, "Blender is not installed", fmt::format("apt-get install {}", adapter.package));
}

void run_in_blender(const InstalledRenderer &blender, const BlenderScript &script) {
    bool said = script.last_words.empty();
    ChildRequest request;
    request.program = blender.program;
    request.folder = script.folder;
    request.log = script.folder / "blender.log";
    request.time_limit = script.time_limit;
    request.on_line = [&](std::string_view line) { said = said || line == script.last_words; };
    request.arguments = {"-b", "--factory-startup", "--disable-autoexec", "-noaudio"};
    if (script.file) request.arguments.push_back(script.file->string());
    // The script's name is ours. Not `-P`: Blender looks for that file where $PWD points.
    request.arguments.insert(request.arguments.end(),
                             {"--python-exit-code", "3", "--python-expr",
                              fmt::format("import runpy; runpy.run_path('{}', run_name='__main__')", script.name)});
    const ChildResult child = run_child(request);
    if (child.end == ChildResult::End::timed_out)
        throw Error(Exit::timed_out, "Blender " + child.describe(), "allow more time (--timeout)");
    if (child.end == ChildResult::End::exited && child.exit_code == 0 && said) return;
    const std::string why = explain_blender_failure(read_file(request.log));
    throw Error(Exit::input_output, fmt::format("Blender could not make the file: {}{}", child.describe(),
                                                why.empty() ? "" : ": " + one_line(why)));
}

} // namespace threefold
