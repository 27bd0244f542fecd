// SPDX-License-Identifier: MIT
#include "exporter/blender/blend_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "exporter/blender/live_orb.h"
#include "exporter/blender/prelude.h"
#include "exporter/blender/run_script.h"
#include "exporter/blender/scene_data.h"
#include "exporter/files.h"
#include "exporter/temporary_folder.h"

namespace threefold {

namespace {

std::string notes_of(const ExportJob &job, const InstalledRenderer &blender, double unit_mm) {
    return fmt::format(
        "{}\nMade with Blender {}. One Blender unit is {} mm; lengths are shown in millimetres.\n\n"
        "The file holds what Threefold's Cycles adapter renders. To render it:\n"
        "  blender -b {}.blend -o //picture -F OPEN_EXR -f 1\n\n"
        "Live parameters: select an orb, and open its modifier \"Glass orb\": outer radius, wall, hollow or solid,\n"
        "index, transmittance of each surface. The orb may be moved. Neither drivers nor scripts are used.\n"
        "The camera hangs on \"Camera stand\"; at location and rotation 0 it is the verified view.\n"
        "\"Clear window\" before the camera is invisible. It makes Cycles share its samples evenly; keep it.\n"
        "Samples, bounces, clamping and filter are as verified: each one that is changed changes the picture.\n"
        "Saved by a Blender before 4.5, the file starts at sample 0, since later ones would read an offset as no "
        "samples\n"
        "at all: of N samples one goes through the pixel's centre, and the noise is another than in Threefold's "
        "renders.\n"
        "The view transform is Standard; the EXR holds linear radiance whatever is chosen there.\n",
        to_text(job.provenance), blender.version, unit_mm, job.stem());
}

} // namespace

std::vector<ExportedFile> make_blend_file(const ExportJob &job, const InstalledRenderer &blender) {
    const CyclesScene scene = describe_for_cycles(job.job);
    const std::string file = job.stem() + ".blend";
    const std::string notes = notes_of(job, blender, scene.data.at("unit_mm").get<double>());
    const nlohmann::ordered_json delivery{{"file", file}, {"stem", job.stem()}, {"notes", notes}};
    const auto script = [&](std::string_view call) {
        return fmt::format("{}{}\n\n# ---- The scene\n\n{}\n{}\n{}(SCENE, DELIVERY)\n", cycles_prelude(),
                           live_orb_prelude(), to_python("SCENE", scene.data), to_python("DELIVERY", delivery), call);
    };
    const TemporaryFolder folder;
    for (const ExportedFile &made : scene.files) write_file_atomically(folder.path() / made.name, made.bytes);
    write_file_atomically(folder.path() / "build.py", script("deliver"));
    write_file_atomically(folder.path() / "inspect.py", script("inspect"));
    run_in_blender(blender, {folder.path(), "build.py", {}, "", job.time_limit});
    run_in_blender(blender, {folder.path(), "inspect.py", folder.path() / file, "threefold inspected", job.time_limit});
    return {{file, read_file(folder.path() / file)}, {"README.txt", notes}};
}

} // namespace threefold
