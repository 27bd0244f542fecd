// SPDX-License-Identifier: MIT
// render: a scene as a picture.
#include <algorithm>
#include <cctype>
#include <chrono>

#include <fmt/format.h>

#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "exporter/scene_json.h"
#include "exporter/temporary_folder.h"
#include "tools/commands.h"
#include "tools/progress.h"
#include "verifier/tolerance/tolerance.h"
#include "verifier/witness/witness.h"

namespace threefold {

namespace fs = std::filesystem;

TracerSettings tracer_settings(const std::string &precision, const std::string &transport, const std::string &sampler) {
    TracerSettings settings;
    if (precision == "float")
        settings.precision = Precision::single_precision;
    else if (precision != "double")
        throw Error(Exit::usage, unknown_name("precision", precision, {"float", "double"}));
    if (transport == "roulette")
        settings.transport = Transport::roulette;
    else if (transport != "tree")
        throw Error(Exit::usage, unknown_name("transport", transport, {"tree", "roulette"}));
    if (sampler == "stratified")
        settings.sampler = Sampler::stratified;
    else if (sampler == "random")
        settings.sampler = Sampler::random;
    else if (sampler != "sobol")
        throw Error(Exit::usage, unknown_name("sampler", sampler, {"sobol", "stratified", "random"}));
    return settings;
}

Exit command_render(const Shop &shop, const RenderRequest &request) {
    const Scene scene = scene_of(shop, request.scene);
    const std::string label = scene_label(request.scene);
    const fs::path output = request.output.value_or(label + ".exr");
    std::string extension = output.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    if (extension != ".exr" && extension != ".tif" && extension != ".png")
        throw Error(Exit::usage, fmt::format("the picture's name must end in .exr, .tif (64-bit) or .png, not '{}'",
                                             output.string()));
    if (request.samples_per_pixel < 1) throw Error(Exit::bad_data, "--spp must be at least 1");
    const double cut_weight = request.cut_weight.value_or(request.with == "tracer" ? 1e-6 : 1e-5);
    if (!(cut_weight >= 1e-12 && cut_weight <= 0.5))
        throw Error(Exit::bad_data, fmt::format("--cut must lie in [1e-12, 0.5], not {}", cut_weight));
    const std::chrono::milliseconds time_limit = to_time_limit(request.time_limit_s);
    const TracerSettings tracer = tracer_settings(request.precision, request.transport, request.sampler);
    const Witness witness = find_witnesses({request.with}).front();
    if (output.has_parent_path()) make_folder(output.parent_path());
    RenderJob job;
    job.scene = scene;
    job.sampling = request.pixel_centres ? Sampling::pixel_centres : Sampling::box;
    job.samples_per_pixel = request.samples_per_pixel;
    job.replicates = {{request.seed, {}}};
    job.cut_weight = cut_weight;
    job.surface_tolerance_mm = request.surface_mm.value_or(job.surface_tolerance_mm);
    job.most_bounces = request.bounces;
    job.threads = shop.threads;

    const TemporaryFolder temporary;
    Progress progress({witness.name}, shop.verbosity < 0);
    std::optional<WithinTolerance> within;
    const auto attempt = [&] {
        try {
            if (request.tolerance) {
                ToleranceRequest asked;
                asked.tolerance = *request.tolerance;
                asked.seed = request.seed;
                asked.threads = shop.threads;
                asked.folder = request.keep.value_or(temporary.path());
                asked.label = label;
                asked.time_limit = time_limit;
                asked.on_progress = [&](double share, const std::string &now) {
                    progress.update(witness.name, share, now);
                };
                if (!witness.present() || !witness.problem.empty()) return render(witness, job, {}); // says why not
                within = render_within(witness, scene, asked);
                return within->rendered;
            }
            return render(witness, job,
                          {.folder = request.keep.value_or(temporary.path()),
                           .label = label,
                           .tracer = tracer,
                           .time_limit = time_limit,
                           .on_progress = [&](double share) { progress.update(witness.name, share, label); },
                           .keep = request.keep.has_value()});
        } catch (const Error &error) {
            // The log goes away with the temporary folder.
            if (request.keep || !witness.adapter || !error.hint().empty()) throw;
            throw Error(error.code(), error.what(), "--keep FOLDER keeps the inputs and the log");
        }
    };
    const Rendered r = attempt();
    progress.finish();

    std::map<std::string, std::string> metadata{{"threefold:scene", label},
                                                {"threefold:scene_hash", r.record.scene_hash},
                                                {"threefold:renderer", witness.name},
                                                {"threefold:command", shop.command_line}};
    if (witness.installed) metadata["threefold:renderer_version"] = witness.installed->version;
    if (r.record.missing_weight_mean) {
        metadata["threefold:missing_weight_mean"] = fmt::format("{:.3e}", *r.record.missing_weight_mean);
        metadata["threefold:missing_weight_greatest"] = fmt::format("{:.3e}", *r.record.missing_weight_greatest);
    }
    if (within) {
        metadata["threefold:settings"] = within->description;
        metadata["threefold:relative_rms_error"] = fmt::format("{:.3e}", within->error);
        metadata["threefold:relative_rms_error_upper"] = fmt::format("{:.3e}", within->error_upper);
    }
    write_image(output, r.images.front(), metadata);
    fs::path preview = output;
    preview.replace_extension(".png");
    if (preview != output) write_image(preview, r.images.front());

    if (shop.verbosity >= 0) {
        std::string line = fmt::format("{} in {:.2f} s", witness.title, r.record.seconds);
        if (r.record.missing_weight_mean)
            line += fmt::format(
                "; dropped with the ends of ray trees: {:.1e} of the light on average, {:.1e} in the worst pixel",
                *r.record.missing_weight_mean, *r.record.missing_weight_greatest);
        if (within)
            line = fmt::format(
                "{}: {}; relative RMS error {:.2g}, at most {:.2g} with 95 % confidence ({} {:g}): noise "
                "{:.2g}, {} {:.2g}{}; {:.3g} CPU s with the pilot",
                witness.title, within->description, within->error, within->error_upper,
                within->met                          ? "within"
                : within->error > *request.tolerance ? "NOT within"
                                                     : "not shown to be within",
                *request.tolerance, within->noise, within->systematic_is_bound ? "dropped light at most" : "offset",
                within->systematic, within->reference.empty() ? "" : fmt::format(" (against {})", within->reference),
                within->cpu_seconds);
        say(line);
    }
    fmt::print("{}\n", output.string());
    if (preview != output) fmt::print("{}\n", preview.string());
    return within && !within->met ? Exit::undecided : Exit::holds;
}

} // namespace threefold
