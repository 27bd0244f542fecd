// SPDX-License-Identifier: MIT
#include "verifier/witness/witness.h"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "exporter/mitsuba/pictures.h"
#include "exporter/scene_json.h"
#include "scenes/error.h"
#include "scenes/parameters.h"
#include "scenes/validate.h"

namespace threefold {

namespace {

using Json = nlohmann::ordered_json;

/// Changes whenever the tracer's pictures do: an old picture must not be taken for a new one.
constexpr int tracer_revision = 3;

Witness tracer_witness() {
    Witness w;
    w.name = "tracer";
    w.title = "Threefold's tracer";
    return w;
}

Witness witness_of(const Adapter &adapter) {
    Witness w;
    w.name = adapter.name;
    w.title = adapter.title;
    w.package = adapter.package;
    w.adapter = &adapter;
    return w;
}

std::string tracer_key(const RenderJob &job, const std::string &hash, const TracerSettings &settings) {
    Json replicates = Json::array();
    for (const Replicate &r : job.replicates) replicates.push_back({r.seed, r.film_offset_px.x, r.film_offset_px.y});
    const Json key{
        {"tracer", tracer_revision},
        {"scene", hash},
        {"sampling", static_cast<int>(job.sampling)},
        {"samples", job.samples_per_pixel},
        {"replicates", replicates},
        {"cut_weight", job.cut_weight},
        {"slip", {job.slip.inner_normal_flipped, job.slip.most_interfaces.value_or(0), job.slip.inner_tint_forgotten}},
        {"precision", static_cast<int>(settings.precision)},
        {"transport", static_cast<int>(settings.transport)},
        {"sampler", static_cast<int>(settings.sampler)},
        {"roulette_weight", settings.roulette_weight}};
    return content_hash(key.dump());
}

std::string program_key(const Witness &witness, const Exported &exported) {
    std::string all =
        fmt::format("{}\n{}\n{}\n{} {} {}\n", witness.name, witness.installed->version, witness.adapter->revision,
                    exported.pictures_per_replicate, exported.supersampling, exported.radiance_scale);
    for (const std::string &argument : exported.arguments) all += argument + '\0';
    for (const ExportedFile &file : exported.files) all += file.name + '\0' + content_hash(file.bytes);
    return content_hash(all);
}

std::string picture_name(std::size_t replicate) { return fmt::format("replicate-{:02}.tif", replicate); }

/// The cached pictures, if they are whole.
std::optional<Rendered> cached(const std::filesystem::path &folder, const std::string &key, const RenderJob &job) {
    if (!std::filesystem::exists(folder / "done.json")) return std::nullopt;
    try {
        const Json done = Json::parse(read_file(folder / "done.json"));
        if (done.at("key") != key) return std::nullopt;
        Rendered r;
        for (std::size_t k = 0; k < job.replicates.size(); ++k)
            r.images.push_back(read_image(folder / picture_name(k)));
        for (const Image &image : r.images)
            if (image.width != job.scene.camera.image_width_px() || image.height != job.scene.camera.image_height_px())
                return std::nullopt;
        r.record.seconds = done.at("seconds");
        r.record.cpu_seconds = done.at("cpu_seconds");
        r.record.peak_memory_mb = done.at("peak_memory_mb");
        r.record.own_cpu_seconds = done.value("own_cpu_seconds", r.record.cpu_seconds);
        if (done.contains("missing_weight_mean")) {
            r.record.missing_weight_mean = done.at("missing_weight_mean");
            r.record.missing_weight_greatest = done.at("missing_weight_greatest");
        }
        r.record.from_cache = true;
        return r;
    } catch (const std::exception &) {
        return std::nullopt; // a damaged cache is rendered anew
    }
}

void keep(const std::filesystem::path &folder, const std::string &key, const Rendered &r) {
    for (std::size_t k = 0; k < r.images.size(); ++k) write_image(folder / picture_name(k), r.images[k]);
    Json done{{"key", key},
              {"seconds", r.record.seconds},
              {"cpu_seconds", r.record.cpu_seconds},
              {"own_cpu_seconds", r.record.own_cpu_seconds},
              {"peak_memory_mb", r.record.peak_memory_mb}};
    if (r.record.missing_weight_mean) {
        done["missing_weight_mean"] = *r.record.missing_weight_mean;
        done["missing_weight_greatest"] = *r.record.missing_weight_greatest;
    }
    write_file_atomically(folder / "done.json", done.dump(1));
}

Rendered render_by_tracer(const RenderJob &job, const RenderOptions &options) {
    TracerOutcome outcome = trace(job, options.tracer, options.on_progress);
    Rendered r;
    r.images = std::move(outcome.images);
    r.record.seconds = outcome.seconds;
    r.record.cpu_seconds = r.record.own_cpu_seconds = outcome.cpu_seconds;
    r.record.missing_weight_mean = outcome.missing_weight_mean;
    r.record.missing_weight_greatest = outcome.missing_weight_greatest;
    return r;
}

Rendered render_by_program(const Witness &witness, const RenderJob &job, const Exported &exported,
                           const RenderOptions &options, const std::filesystem::path &folder) {
    RunOutcome outcome = run_exported(*witness.adapter, *witness.installed, exported, job,
                                      {folder, options.time_limit, options.on_progress});
    Rendered r;
    r.images = std::move(outcome.images);
    r.record.seconds = outcome.seconds;
    r.record.cpu_seconds = outcome.cpu_seconds;
    r.record.own_cpu_seconds = outcome.own_cpu_seconds;
    r.record.peak_memory_mb = outcome.peak_memory_mb;
    return r;
}

} // namespace

std::vector<std::string> elsewhere_names() { return {"mitsuba"}; }

Witness witness_elsewhere(const std::string &name, const std::filesystem::path &pictures) {
    if (std::ranges::count(elsewhere_names(), name) == 0)
        throw Error(Exit::usage, unknown_name("renderer elsewhere", name, elsewhere_names()));
    if (!std::filesystem::is_directory(pictures))
        throw Error(Exit::input_output, fmt::format("{} is no folder with pictures", pictures.string()));
    Witness w;
    w.name = name;
    w.title = "Mitsuba (pictures made elsewhere)";
    w.pictures = pictures;
    return w;
}

std::vector<std::string> witness_names() {
    std::vector<std::string> names{"tracer"};
    for (const Adapter &adapter : adapters()) names.emplace_back(adapter.name);
    return names;
}

std::vector<Witness> find_witnesses(const std::vector<std::string> &names) {
    for (const std::string &name : names)
        if (std::ranges::count(witness_names(), name) == 0)
            throw Error(Exit::usage, unknown_name("renderer", name, witness_names()));
    std::vector<Witness> found;
    if (std::ranges::count(names, "tracer")) found.push_back(tracer_witness());
    for (const Adapter &adapter : adapters())
        if (std::ranges::count(names, adapter.name)) {
            found.push_back(witness_of(adapter));
            try {
                found.back().installed = find_renderer(adapter);
            } catch (const Error &error) {
                if (error.code() == Exit::interrupted) throw;
                found.back().problem = error.what();
            }
        }
    return found;
}

namespace {

/// Two claims may ask for the same pictures at the same time: the second waits, and finds them kept.
class FolderInUse {
public:
    explicit FolderInUse(const std::filesystem::path &folder) : name_(folder.string()) {
        std::unique_lock lock(mutex());
        changed().wait(lock, [this] { return !names().contains(name_); });
        names().insert(name_);
    }
    ~FolderInUse() {
        const std::lock_guard lock(mutex());
        names().erase(name_);
        changed().notify_all();
    }
    FolderInUse(const FolderInUse &) = delete;
    FolderInUse &operator=(const FolderInUse &) = delete;

private:
    static std::mutex &mutex() {
        static std::mutex m;
        return m;
    }
    static std::condition_variable &changed() {
        static std::condition_variable c;
        return c;
    }
    static std::set<std::string> &names() {
        static std::set<std::string> n;
        return n;
    }

    std::string name_;
};

Rendered take_pictures(const Witness &witness, const RenderJob &job, const RenderOptions &options) {
    const MitsubaJob asked = to_mitsuba_job(job, options.label);
    Rendered r;
    r.images = read_pictures(asked, job, *witness.pictures);
    RenderRecord &record = r.record;
    record.witness = witness.name;
    record.command = fmt::format("{} by someone else", asked.files.front().name);
    record.accuracy = asked.accuracy;
    record.width_px = job.scene.camera.image_width_px();
    record.height_px = job.scene.camera.image_height_px();
    record.replicates = static_cast<int>(job.replicates.size());
    record.samples_per_pixel = asked.samples_per_pixel;
    record.scene_hash = scene_hash(job.scene);
    return r;
}

} // namespace

Rendered render(const Witness &witness, RenderJob job, const RenderOptions &options) {
    validate(job.scene);
    if (witness.pictures) return take_pictures(witness, job, options);
    if (witness.adapter) job = for_renderer(*witness.adapter, std::move(job));
    if (!witness.problem.empty()) throw Error(Exit::input_output, witness.problem);
    if (!witness.present())
        throw Error(Exit::renderer_missing, fmt::format("{} is not installed", witness.title),
                    fmt::format("apt-get install {}", witness.package));
    std::optional<Exported> exported;
    if (witness.adapter) exported = witness.adapter->compile(job);

    const std::string hash = scene_hash(job.scene);
    const std::string key = exported ? program_key(witness, *exported) : tracer_key(job, hash, options.tracer);
    const std::string name = fmt::format("{}-{}-{}", options.label, witness.name, key.substr(0, 12));
    const std::filesystem::path folder = options.folder / "renders" / name;

    const FolderInUse in_use(folder);
    std::optional<Rendered> r = cached(folder, key, job);
    if (!r) {
        if (exported || options.keep) make_folder(folder);
        r = exported ? render_by_program(witness, job, *exported, options, folder) : render_by_tracer(job, options);
        if (options.keep) keep(folder, key, *r);
    }
    RenderRecord &record = r->record;
    record.witness = witness.name;
    record.folder = "renders/" + name;
    if (exported)
        record.command = fmt::format("{} {} {}", witness.adapter->program, fmt::join(exported->thread_arguments, " "),
                                     fmt::join(exported->arguments, " "));
    record.accuracy = exported ? exported->accuracy : tracer_accuracy(job, options.tracer);
    record.width_px = job.scene.camera.image_width_px();
    record.height_px = job.scene.camera.image_height_px();
    record.replicates = static_cast<int>(job.replicates.size());
    const bool several = job.sampling == Sampling::box || record.accuracy.random_branches; // else one ray tells all
    record.samples_per_pixel = several ? job.samples_per_pixel : 1;
    record.scene_hash = hash;
    return *std::move(r);
}

} // namespace threefold
