// SPDX-License-Identifier: MIT
#include "exporter/povray/povray_folder.h"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "exporter/povray/povray.h"

namespace threefold {

namespace {

std::string ini_of(const Exported &exported) {
    std::string text = "; povray scene.ini\n";
    for (const std::string &argument : exported.arguments) text += argument + "\n";
    return text;
}

/// What makes radiance of the pictures, as our adapter does it.
std::string averaging_command(const Exported &exported, const Camera &camera) {
    std::string command = "oiiotool";
    for (std::size_t i = 0; i < exported.outputs.size(); ++i)
        command += fmt::format(" {} -d float{}", exported.outputs[i], i > 0 ? " --add" : "");
    command +=
        fmt::format(" --mulc {:.17g}", 1 / (exported.radiance_scale * static_cast<double>(exported.outputs.size())));
    if (exported.supersampling > 1)
        command += fmt::format(" --resize:filter=box {}x{}", camera.image_width_px(), camera.image_height_px());
    return command + " -d float -o picture.exr";
}

std::string readme(const ExportJob &job, const Exported &exported) {
    const std::size_t count = exported.outputs.size();
    std::string text =
        fmt::format("{}\nTo render, in this folder:\n  povray scene.ini\n\n"
                    "That writes {}: linear 16-bit PNG, {} x {} pixels, a sample being radiance times {:.17g}.\n",
                    to_text(job.provenance), fmt::join(exported.outputs, " and "),
                    job.job.scene.camera.image_width_px() * exported.supersampling,
                    job.job.scene.camera.image_height_px() * exported.supersampling, exported.radiance_scale);
    if (count > 1 || exported.supersampling > 1)
        text +=
            fmt::format("POV-Ray's own antialiasing is no mean over a pixel, so the picture is {} of {} x {} samples a "
                        "pixel, with mirrored shifts: their mean is the picture.\n",
                        count > 1 ? fmt::format("{} pictures", count) : "one picture", exported.supersampling,
                        exported.supersampling);
    text += fmt::format("To have it as linear radiance (package openimageio-tools):\n  {}\n\n",
                        averaging_command(exported, job.job.scene.camera));
    text += fmt::format("Ray trees are cut at a weight of {:g}; light counts to half a step of 16 bits.\n"
                        "In scene.pov one unit, the origin and the scale of radiance stand in the second line.\n",
                        exported.accuracy.cut_weight);
    return text;
}

} // namespace

std::vector<ExportedFile> make_povray_folder(const ExportJob &job) {
    Exported exported = compile_povray(job.job);
    std::vector<ExportedFile> files = std::move(exported.files);
    files.push_back({"scene.ini", ini_of(exported)});
    files.push_back({"README.txt", readme(job, exported)});
    return files;
}

} // namespace threefold
