// SPDX-License-Identifier: MIT
#include "exporter/blender/session_script.h"

#include <string_view>

namespace threefold {

namespace {

constexpr std::string_view python = R"python(
import json, os, runpy, sys, traceback
import bpy
for number, line in enumerate(sys.stdin):
    folder = os.fsdecode(bytes(json.loads(line)))
    try:
        if number > 0:
            bpy.ops.wm.read_factory_settings()
        os.chdir(folder)
        runpy.run_path(os.path.join(folder, "scene.py"), run_name="__main__")
        end = "done"
    except BaseException:
        traceback.print_exc()
        end = "failed"
    sys.stderr.flush()
    print("\nthreefold job " + end, flush=True)
)python";

} // namespace

std::vector<std::string> blender_session_arguments() {
    return {"-b", "--factory-startup", "--disable-autoexec", "-noaudio", "--python-exit-code",
            "3",  "--python-expr",     std::string(python)};
}

} // namespace threefold
