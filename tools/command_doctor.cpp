// SPDX-License-Identifier: MIT
// doctor: what is installed here, and does it work?
#include <thread>
#include <unistd.h>

#include <boost/version.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "exporter/image/load_pictures.h"
#include "exporter/mesh/mesh_file.h"
#include "exporter/temporary_folder.h"
#include "tools/commands.h"
#include "verifier/check/check.h"
#include "verifier/tracer/embree_world.h"

namespace threefold {

std::vector<std::pair<std::string, std::string>> library_versions() {
    return {
        {"threefold", THREEFOLD_VERSION},
        {"Embree", tracer::embree_version()},
        {"Assimp", assimp_version()},
        {"OpenImageIO", THREEFOLD_OPENIMAGEIO_VERSION},
        {"Boost", fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
        {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
        {"nlohmann-json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                      NLOHMANN_JSON_VERSION_PATCH)},
    };
}

std::vector<std::pair<std::string, std::string>> versions_with(const std::vector<Witness> &witnesses) {
    auto versions = library_versions();
    for (const Witness &w : witnesses)
        if (w.installed) versions.emplace_back(w.title, w.installed->version);
    return versions;
}

namespace {

/// A picture of 16 x 16 px; empty if it came, else what was wrong.
std::string try_out(const Shop &shop, const Witness &witness, const std::filesystem::path &folder) {
    try {
        RenderJob job;
        job.scene = scene_of(shop, {shop.scenes.front().name, "text", {}, "16x16"});
        job.samples_per_pixel = 1;
        render(witness, job,
               {.folder = folder,
                .label = "doctor",
                .tracer = {},
                .time_limit = std::chrono::seconds(120),
                .on_progress = {},
                .keep = false});
        return "";
    } catch (const Error &error) {
        return error.what();
    }
}

} // namespace

Exit command_doctor(const Shop &shop) {
    for (const auto &[name, version] : library_versions()) fmt::print("{:<14} {}\n", name, version);
    fmt::print("{:<14} {} of {} cores\n", "threads",
               shop.threads > 0 ? shop.threads : static_cast<int>(std::thread::hardware_concurrency()),
               std::thread::hardware_concurrency());
    fmt::print("{:<14} {:.1f} GB\n", "memory",
               static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e9);

    const TemporaryFolder folder;
    Exit exit = Exit::holds;
    try {
        const LoadedPictures &pictures = loaded_pictures();
        fmt::print("{:<14} OpenImageIO {} ({})\n", "picture files", pictures.module->openimageio_version,
                   pictures.path.string());
    } catch (const Error &error) {
        fmt::print("{:<14} cannot be read: {}\n", "picture files", error.what());
        exit = Exit::input_output;
    }
    for (const Witness &w : find_witnesses(witness_names())) {
        if (!w.problem.empty()) {
            fmt::print("{:<14} does not work: {}\n", w.name, w.problem);
            exit = Exit::input_output;
            continue;
        }
        if (!w.present()) {
            fmt::print("{:<14} missing: apt-get install {}\n", w.name, w.package);
            exit = Exit::renderer_missing;
            continue;
        }
        const std::string problem = try_out(shop, w, folder.path());
        fmt::print("{:<14} {}{}\n", w.name,
                   w.installed ? fmt::format("{} ({}), ", w.installed->version, w.installed->program.string()) : "",
                   problem.empty() ? "makes pictures" : "does not work: " + problem);
        if (!problem.empty() && exit == Exit::holds) exit = Exit::input_output;
    }
    return exit;
}

} // namespace threefold
