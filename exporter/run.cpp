// SPDX-License-Identifier: MIT
#include "exporter/run.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "exporter/process/child.h"
#include "exporter/session.h"
#include "scenes/error.h"

namespace threefold {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds version_time_limit{60};
constexpr std::size_t longest_explanation = 300;

/// Text of another program as a part of an error message; with ": " before it, or empty.
std::string as_reason(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
    const std::size_t first = text.find_first_not_of(' ');
    if (first == text.npos) return {};
    text = text.substr(first, text.find_last_not_of(' ') + 1 - first);
    if (text.size() > longest_explanation) text = text.substr(0, longest_explanation) + "...";
    return ": " + text;
}

void require_plain_name(const std::string &name) {
    if (name.empty() || name == "." || name == ".." || name.find('/') != name.npos)
        throw Error(Exit::internal, fmt::format("'{}' is not a plain file name", name));
}

void remove_stale_pictures(const Exported &exported, const fs::path &folder) {
    for (const std::string &name : exported.outputs) {
        require_plain_name(name);
        std::error_code error;
        fs::remove(folder / name, error);
        if (error)
            throw Error(Exit::input_output,
                        fmt::format("cannot remove {}: {}", (folder / name).string(), error.message()));
    }
}

/// One run of a program, as far as its error messages are concerned.
struct Run {
    const Adapter &adapter;
    fs::path log;

    std::string explanation() const { return as_reason(adapter.explain_failure(read_file(log))); }

    [[noreturn]] void fail(Exit code, std::string_view what, std::string hint = {}) const {
        throw Error(code, fmt::format("{} {}; log: {}", adapter.title, what, log.string()), std::move(hint));
    }
};

void require_success(const Run &run, const ChildResult &child) {
    switch (child.end) {
    case ChildResult::End::timed_out:
        run.fail(Exit::timed_out, child.describe(), "allow more time, or ask for fewer pixels or samples");
    case ChildResult::End::signalled:
        run.fail(Exit::input_output, fmt::format("failed: {}{}", child.describe(), run.explanation()));
    case ChildResult::End::exited:
        if (child.exit_code != 0)
            run.fail(Exit::input_output, fmt::format("failed: {}{}", child.describe(), run.explanation()));
    }
}

ChildResult run_alone(const Adapter &adapter, const InstalledRenderer &installed, const Exported &exported,
                      const RunOptions &options, const fs::path &log, std::function<void(std::string_view)> on_line) {
    ChildRequest request;
    request.program = installed.program;
    request.arguments = exported.thread_arguments;
    request.arguments.insert(request.arguments.end(), exported.arguments.begin(), exported.arguments.end());
    request.folder = options.folder;
    request.log = log;
    request.time_limit = options.time_limit;
    if (adapter.rendering_begins) request.marks = adapter.rendering_begins;
    request.on_line = std::move(on_line);
    return run_child(request);
}

Image read_output(const Run &run, const fs::path &picture, const Exported &exported, const Camera &camera) {
    std::error_code ignored;
    const std::string name = picture.filename().string();
    if (!fs::exists(picture, ignored))
        run.fail(Exit::input_output, fmt::format("wrote no picture ({} is missing){}", name, run.explanation()));
    Image image;
    try {
        image = read_image(picture, Encoding::linear);
    } catch (const Error &error) {
        if (error.code() != Exit::bad_data) throw; // not the renderer's doing
        run.fail(Exit::input_output, fmt::format("wrote a truncated or damaged picture: {}", error.what()));
    }
    const int width = camera.image_width_px() * exported.supersampling;
    const int height = camera.image_height_px() * exported.supersampling;
    if (image.width != width || image.height != height)
        run.fail(Exit::input_output, fmt::format("wrote a picture of the wrong size ({} is {} x {}, not {} x {})", name,
                                                 image.width, image.height, width, height));
    image = average_blocks(image, exported.supersampling);
    for (Rgb &pixel : image.pixels) pixel /= exported.radiance_scale;
    return image;
}

} // namespace

std::optional<InstalledRenderer> find_renderer(const Adapter &adapter) {
    const std::optional<fs::path> program = find_program(adapter.program);
    if (!program) return std::nullopt;
    std::string output;
    ChildRequest request;
    request.program = *program;
    request.arguments = {std::string(adapter.version_argument)};
    request.time_limit = version_time_limit;
    request.on_line = [&](std::string_view line) { output.append(line).append("\n"); };
    const ChildResult child = run_child(request);
    const std::string version = adapter.parse_version(output);
    const auto fail = [&](const std::string &why) {
        throw Error(Exit::input_output,
                    fmt::format("{} ({}) does not tell its version: {}", adapter.title, program->string(), why),
                    fmt::format("reinstall the package {}", adapter.package));
    };
    if (child.end != ChildResult::End::exited || child.exit_code != 0) fail(child.describe());
    if (version.empty()) fail("unknown answer" + as_reason(output));
    return InstalledRenderer{*program, version};
}

void write_exported(const Exported &exported, const fs::path &folder) {
    make_folder(folder);
    for (const ExportedFile &file : exported.files) {
        require_plain_name(file.name);
        write_file_atomically(folder / file.name, file.bytes);
    }
}

RunOutcome run_exported(const Adapter &adapter, const InstalledRenderer &installed, const Exported &exported,
                        const RenderJob &job, const RunOptions &options) {
    const auto per_replicate = static_cast<std::size_t>(std::max(exported.pictures_per_replicate, 1));
    if (exported.outputs.size() != job.replicates.size() * per_replicate || exported.supersampling < 1 ||
        !(exported.radiance_scale > 0) || !std::isfinite(exported.radiance_scale))
        throw Error(Exit::internal, fmt::format("{}: {} pictures for {} replicates, supersampling {}, scale {}",
                                                adapter.title, exported.outputs.size(), job.replicates.size(),
                                                exported.supersampling, exported.radiance_scale));
    write_exported(exported, options.folder);
    remove_stale_pictures(exported, options.folder);

    const Run run{adapter, options.folder / fmt::format("{}.log", adapter.name)};
    std::function<void(std::string_view)> on_line;
    double last_share = 0;
    if (options.on_progress)
        on_line = [&](std::string_view line) {
            const auto share = adapter.progress(line, last_share, exported);
            if (!share) return;
            last_share = *share;
            options.on_progress(*share);
        };
    const ChildResult child = options.sessions && adapter.session_arguments
                                  ? options.sessions->render(adapter, installed, exported.thread_arguments,
                                                             {options.folder, run.log, options.time_limit, on_line})
                                  : run_alone(adapter, installed, exported, options, run.log, on_line);
    require_success(run, child);

    RunOutcome outcome;
    for (std::size_t first = 0; first < exported.outputs.size(); first += per_replicate) {
        std::vector<Image> pictures;
        for (std::size_t k = first; k < first + per_replicate; ++k)
            pictures.push_back(read_output(run, options.folder / exported.outputs[k], exported, job.scene.camera));
        outcome.images.push_back(mean(pictures));
    }
    outcome.seconds = child.seconds;
    outcome.cpu_seconds = child.cpu_seconds;
    std::optional<double> own;
    if (adapter.own_cpu_seconds) own = adapter.own_cpu_seconds(read_file(run.log));
    if (!own && child.cpu_seconds_at_mark) own = child.cpu_seconds - *child.cpu_seconds_at_mark;
    outcome.own_cpu_seconds = own.value_or(child.cpu_seconds);
    outcome.peak_memory_mb = child.peak_memory_mb;
    return outcome;
}

} // namespace threefold
