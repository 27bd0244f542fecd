// SPDX-License-Identifier: MIT
#include "exporter/blender/cycles.h"

#include <fmt/format.h>

#include "exporter/blender/log.h"
#include "exporter/blender/prelude.h"
#include "exporter/blender/scene_data.h"

namespace threefold {

Exported compile_cycles(const RenderJob &job) {
    CyclesScene scene = describe_for_cycles(job);
    Exported exported;
    exported.files.push_back({"scene.py", fmt::format("{}\n\n# ---- The scene\n\n{}\nmain(SCENE)\n", cycles_prelude(),
                                                      to_python("SCENE", scene.data))});
    for (ExportedFile &file : scene.files) exported.files.push_back(std::move(file));
    // Settings of the user's own and scripts in files have no say. The exit code goes before the script, or a failing
    // script ends with 0.
    // Not `-P scene.py`: Blender looks for that file where $PWD points, which need not be the working directory.
    exported.arguments = {"-b",
                          "--factory-startup",
                          "--disable-autoexec",
                          "-noaudio",
                          "--python-exit-code",
                          "3",
                          "--python-expr",
                          "import runpy; runpy.run_path('scene.py', run_name='__main__')"};
    exported.thread_arguments = {"-t", fmt::format("{}", job.threads)};
    exported.outputs = std::move(scene.outputs);
    exported.accuracy = scene.accuracy;
    return exported;
}

Adapter cycles_adapter() {
    Adapter adapter;
    adapter.name = "cycles";
    adapter.title = "Cycles";
    adapter.program = "blender";
    adapter.package = "blender";
    adapter.compile = compile_cycles;
    adapter.progress = cycles_progress;
    adapter.version_argument = "--version";
    adapter.parse_version = parse_blender_version;
    adapter.explain_failure = explain_blender_failure;
    adapter.sample_factor = 8; // glass reflects or refracts at random
    // "... | Sample 0/32": meshes and their hierarchy are built.
    adapter.rendering_begins = [](std::string_view line) { return line.find("| Sample 0/") != line.npos; };
    return adapter;
}

} // namespace threefold
