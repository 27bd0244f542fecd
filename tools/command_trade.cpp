// SPDX-License-Identifier: MIT
// trade: what accuracy costs in each renderer, and the cheapest setting for a tolerance.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "exporter/files.h"
#include "exporter/process/child.h"
#include "tools/commands.h"
#include "tools/progress.h"
#include "verifier/studies/trade.h"
#include "verifier/studies/trade_report.h"

namespace threefold {

namespace fs = std::filesystem;

namespace {

bool sets_size(const SceneRequest &scene) {
    return !scene.size.empty() || std::ranges::any_of(scene.assignments, [](const std::string &text) {
        return text.starts_with("image.width_px=") || text.starts_with("image.height_px=");
    });
}

/// The same shape in at most so many pixels a side.
std::string smaller_size(const Scene &scene, int most_px) {
    const double longest = std::max(scene.camera.width_px, scene.camera.height_px);
    const auto scaled = [&](int px) {
        return std::max(1, static_cast<int>(std::lround(px * std::min(1.0, most_px / longest))));
    };
    return fmt::format("{}x{}", scaled(scene.camera.width_px), scaled(scene.camera.height_px));
}

/// Our tracer as a process of its own: this very program, told to render.
RunCost run_ourselves(const SceneRequest &scene, const Setting &setting, std::uint64_t seed, int threads,
                      const fs::path &folder, std::chrono::milliseconds time_limit) {
    ChildRequest child;
    child.program = fs::read_symlink("/proc/self/exe");
    child.arguments = {"render"};
    if (scene.mitsuba.empty())
        child.arguments.push_back(scene.name);
    else
        child.arguments.insert(child.arguments.end(), {"--mitsuba", scene.mitsuba});
    child.arguments.insert(child.arguments.end(), {"--preset", scene.preset});
    if (!scene.size.empty()) child.arguments.insert(child.arguments.end(), {"--size", scene.size});
    for (const std::string &text : scene.assignments) child.arguments.insert(child.arguments.end(), {"--set", text});
    Witness tracer;
    tracer.name = "tracer";
    for (const std::string &option : render_options(setting, tracer)) child.arguments.push_back(option);
    child.arguments.insert(child.arguments.end(),
                           {"--seed", fmt::format("{}", seed), "--threads", fmt::format("{}", threads), "-q", "-o",
                            (folder / "process.exr").string()});
    child.log = folder / "process.log";
    child.time_limit = time_limit;
    const ChildResult r = run_child(child);
    if (r.end != ChildResult::End::exited || r.exit_code != 0)
        throw Error(Exit::input_output,
                    fmt::format("this program as a process of its own: {}; log: {}", r.describe(), child.log.string()));
    return {r.cpu_seconds, r.cpu_seconds, r.seconds, r.peak_memory_mb};
}

} // namespace

Exit command_trade(const Shop &shop, const TradeCommand &command) {
    if (command.json == "-" && command.markdown == "-")
        throw Error(Exit::usage, "--json and --markdown cannot both go to stdout");
    if (command.scene.name.empty() && command.scene.mitsuba.empty())
        throw Error(Exit::usage, "trade takes a scene", "threefold list shows them");
    SceneRequest scene = command.scene;
    TradeRequest request;
    request.scene = scene_of(shop, scene);
    if (!sets_size(scene)) {
        scene.size = smaller_size(request.scene, command.quick ? 64 : 128);
        request.scene = scene_of(shop, scene);
    }
    request.witnesses = asked_witnesses(command.with);
    std::vector<std::string> missing;
    for (const Witness &w : request.witnesses)
        if (!w.present() || !w.problem.empty()) missing.push_back(w.title);
    std::erase_if(request.witnesses, [](const Witness &w) { return !w.present() || !w.problem.empty(); });
    if (!command.tolerances.empty()) request.tolerances = command.tolerances;
    request.runs = command.runs;
    request.quick = command.quick;
    request.most_cpu_s = command.budget_s.value_or(command.quick ? 60 : 300);
    request.seed = command.seed;
    request.threads = shop.threads;
    request.time_limit = to_time_limit(command.time_limit_s);
    request.folder = fs::absolute(command.folder);
    make_folder(request.folder);
    request.tracer_process = [&](const Setting &setting, std::uint64_t seed) {
        return run_ourselves(scene, setting, seed, shop.threads, request.folder, request.time_limit);
    };

    std::vector<std::string> names;
    for (const Witness &w : request.witnesses) names.push_back(w.name);
    Progress progress(names, shop.verbosity < 0);
    request.on_progress = [&progress](const std::string &witness, double share, const std::string &now) {
        progress.update(witness, share, now);
    };
    TradeResult result = study_trade(request);
    progress.finish();
    result.threefold_version = THREEFOLD_VERSION;
    result.command = shop.command_line;
    for (const auto &version : library_versions()) result.versions.push_back(version);
    const SceneRecipe recipe = recipe_of(shop, scene);
    const Parameters values = parameters_of(recipe, scene);
    for (const ParameterSpec &s : recipe.parameters) result.parameters.emplace_back(s.name, values.text(s.name));
    for (const std::string &title : missing) result.notes.push_back(title + " is not installed: it took no part.");

    const std::string json = to_json(result).dump(1), page = to_markdown(result);
    const fs::path report = command.folder / "report.html";
    write_file_atomically(command.folder / "trade.json", json + "\n");
    write_file_atomically(command.folder / "trade.csv", to_csv(result));
    write_file_atomically(command.folder / "trade.md", page);
    write_file_atomically(report, to_html(result));
    if (command.json) write_result(*command.json, json);
    if (command.markdown) write_result(*command.markdown, page.substr(0, page.size() - 1));
    if (command.json != "-" && command.markdown != "-") {
        fmt::print("{}", to_text(result));
        fmt::print("\nreport: {}\n", fs::absolute(report).lexically_normal().string());
    }
    return result.all_met() ? Exit::holds : Exit::undecided;
}

} // namespace threefold
