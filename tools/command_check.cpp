// SPDX-License-Identifier: MIT
// check: claims to verdicts, with a report to look at.
#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "exporter/export/delivery.h"
#include "exporter/files.h"
#include "exporter/mitsuba/pictures.h"
#include "tools/commands.h"
#include "tools/progress.h"
#include "verifier/check/check.h"
#include "verifier/check/look.h"
#include "verifier/check/plan.h"
#include "verifier/report/html.h"
#include "verifier/report/json.h"
#include "verifier/report/junit.h"
#include "verifier/report/numbers.h"
#include "verifier/report/terminal.h"

namespace threefold {

void write_result(const std::string &where, const std::string &text) {
    if (where == "-")
        fmt::print("{}\n", text);
    else
        write_file_atomically(where, text + "\n");
}

std::vector<Witness> asked_witnesses(const std::vector<std::string> &names) {
    std::vector<Witness> found = find_witnesses(names.empty() ? witness_names() : names);
    for (const Witness &w : found) {
        if (names.empty() || w.present()) continue;
        if (!w.problem.empty()) throw Error(Exit::input_output, w.problem);
        throw Error(Exit::renderer_missing, fmt::format("{} was asked for and is not installed", w.title),
                    fmt::format("apt-get install {}", w.package));
    }
    return found;
}

std::vector<Witness> usable_witnesses(const std::vector<std::string> &names) {
    std::vector<Witness> found = asked_witnesses(names);
    std::erase_if(found, [](const Witness &w) { return !w.present() || !w.problem.empty(); });
    return found;
}

namespace {

std::map<std::string, InjectedFault> parse_injections(const std::vector<std::string> &injections) {
    std::map<std::string, InjectedFault> all;
    for (const std::string &text : injections) {
        const std::size_t colon = text.find(':');
        if (colon == std::string::npos)
            throw Error(Exit::usage, fmt::format("--inject takes RENDERER:FAULT, not '{}'", text));
        const std::string name = text.substr(0, colon);
        if (std::ranges::count(witness_names(), name) == 0)
            throw Error(Exit::usage, unknown_name("renderer", name, witness_names()));
        all[name] = parse_injected_fault(text.substr(colon + 1));
    }
    return all;
}

std::vector<Claim> asked_claims(const Shop &shop, const CheckCommand &command) {
    const std::vector<std::string> &names = command.claims;
    const bool file = !command.mitsuba.empty();
    if (names.empty() && !file) return shop.claims;
    if (file && !names.empty())
        throw Error(Exit::usage, "--mitsuba has the file's own picture judged: name no claims beside it");
    if (file && !command.preset.empty())
        throw Error(Exit::usage, "--preset says nothing of a file: change its values by --set",
                    "threefold show --mitsuba FILE lists them");
    std::vector<Claim> asked;
    if (file) asked.push_back(claim_picture(mitsuba_recipe(shop, command.mitsuba)));
    for (const std::string &name : names) asked.push_back(find_claim(shop.claims, name));
    // A vote needs a calibration, asked for or not.
    if (std::ranges::count(asked, "calibration", &Claim::name) == 0)
        asked.insert(asked.begin(), find_claim(shop.claims, "calibration"));
    return asked;
}

void print_plan(const CheckRequest &request) {
    for (const PlannedClaim &planned : plan_of(request)) {
        fmt::print("{}{}\n", planned.claim->name,
                   request.presets.size() > 1 ? fmt::format(" ({})", to_string(planned.context.preset)) : "");
        if (!planned.problem.empty()) fmt::print("  left out: {}\n", planned.problem);
        for (const std::string &name : unused_values(planned)) fmt::print("  sets {} itself\n", name);
        for (const Experiment &e : planned.experiments)
            if (e.inspect)
                fmt::print("  {:<24} scene {:<20} nothing to render\n", e.name, e.record.scene);
            else
                fmt::print("  {:<24} scene {:<20} {} x {} px, {} replicates at first\n", e.name, e.record.scene,
                           e.scene.camera.image_width_px(), e.scene.camera.image_height_px(),
                           first_replicates({}, e, planned.experiments));
    }
}

Assignment parse_elsewhere(std::string_view option, const std::string &text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
        throw Error(Exit::usage, fmt::format("{} takes RENDERER=FOLDER, not '{}'", option, text));
    const std::string name = text.substr(0, equals);
    if (std::ranges::count(elsewhere_names(), name) == 0)
        throw Error(Exit::usage, unknown_name("renderer elsewhere", name, elsewhere_names()));
    return {name, text.substr(equals + 1)};
}

/// Scenes of all experiments that can be said, and the script that renders them; lists the pictures on stdout.
Exit export_jobs(const CheckRequest &request, const std::filesystem::path &folder) {
    require_fresh_folder(folder); // before the work, not after it
    std::vector<MitsubaJob> jobs;
    std::size_t refused = 0;
    for (const PlannedJob &planned : planned_jobs(request)) {
        try {
            jobs.push_back(to_mitsuba_job(planned.job, planned.label));
        } catch (const Error &error) {
            if (error.code() != Exit::bad_data) throw;
            ++refused;
            say(fmt::format("left out: {} of {}: {}", planned.label, planned.claim, error.what()));
        }
    }
    std::vector<ExportedFile> files{{"render.sh", render_script(jobs)}};
    for (const MitsubaJob &job : jobs)
        for (const ExportedFile &file : job.files) // named by their content: claims share scenes and textures
            if (std::ranges::count(files, file.name, &ExportedFile::name) == 0) files.push_back(file);
    write_fresh_folder(folder, files);
    for (const MitsubaJob &job : jobs)
        for (const std::string &picture : job.pictures)
            fmt::print("{}  {} x {} px\n", picture, job.width_px, job.height_px);
    say(fmt::format("wrote {} scenes to {} ({} left out); sh {} renders them; then check --image mitsuba={}",
                    jobs.size(), folder.string(), refused, shell_quoted((folder / "render.sh").string()),
                    shell_quoted(folder.string())));
    const double samples = samples_to_render(jobs);
    say(fmt::format("to render: {:.2g} samples, about {} of CPU time with Mitsuba 3.8 (scalar_rgb)", samples,
                    report::duration(samples * mitsuba_seconds_per_sample)));
    return refused == 0 ? Exit::holds : Exit::undecided;
}

bool is_colour_wanted(int stream) {
    const char *no_colour = std::getenv("NO_COLOR");
    return isatty(stream) && !(no_colour && *no_colour);
}

std::vector<Preset> parse_presets(const std::string &name, bool quick) {
    if (name == "both" || (name.empty() && !quick)) return {Preset::text, Preset::published};
    if (name.empty()) return {Preset::text};
    if (name != "text" && name != "published")
        throw Error(Exit::usage, unknown_name("preset", name, {"text", "published", "both"}));
    return {parse_preset(name)};
}

} // namespace

Exit command_check(const Shop &shop, const CheckCommand &command) {
    CheckRequest request;
    request.claims = asked_claims(shop, command);
    request.scenes = shop.scenes;
    request.presets = parse_presets(command.mitsuba.empty() ? command.preset : "text", command.quick);
    for (const std::string &text : command.assignments) request.assignments.push_back(parse_assignment(text));
    request.quick = command.quick;
    request.seed = command.seed;
    request.least_replicates = command.least_replicates;
    request.threads = shop.threads;
    request.tracer = tracer_settings(command.precision, "tree");
    request.tolerance = command.tolerance;
    request.time_limit = to_time_limit(command.time_limit_s);
    request.folder = command.folder;
    request.injected = parse_injections(command.injections);
    for (const auto &[name, fault] : request.injected)
        if (!command.with.empty() && std::ranges::count(command.with, name) == 0)
            throw Error(Exit::usage, fmt::format("--inject names {}, which takes no part (--with {})", name,
                                                 fmt::join(command.with, ",")));
    if (command.json == "-" && command.junit == "-")
        throw Error(Exit::usage, "--json and --junit cannot both go to stdout");
    if (command.dry_run) {
        print_plan(request);
        return Exit::holds;
    }
    if (!command.export_to.empty()) return export_jobs(request, parse_elsewhere("--export", command.export_to).value);
    request.witnesses = asked_witnesses(command.with);
    for (const std::string &text : command.images) {
        const Assignment elsewhere = parse_elsewhere("--image", text);
        if (std::ranges::count(request.witnesses, elsewhere.name, &Witness::name) > 0)
            throw Error(Exit::usage, fmt::format("--image names {} twice", elsewhere.name));
        request.witnesses.push_back(witness_elsewhere(elsewhere.name, elsewhere.value));
    }

    std::vector<std::string> names;
    for (const Witness &w : request.witnesses)
        if (w.present()) names.push_back(w.name);
    Progress progress(names, shop.verbosity < 0);
    request.on_progress = [&progress](const std::string &witness, double share, const std::string &now) {
        progress.update(witness, share, now);
    };
    const std::filesystem::path report = command.folder / "report.html";
    const auto write_report = [&](RunResult result) {
        result.threefold_version = THREEFOLD_VERSION;
        result.command = shop.command_line;
        result.versions = library_versions();
        write_file_atomically(report, to_html(result));
        return result;
    };
    const bool both = request.presets.size() > 1;
    request.on_claim = [&](const ClaimResult &claim, const RunResult &so_far) {
        progress.print(to_line(claim, is_colour_wanted(STDERR_FILENO), both));
        if (so_far.claims.size() < so_far.claims_planned) write_report(so_far);
    };
    CheckOutcome outcome = check(request);
    progress.finish();

    const RunResult result = write_report(std::move(outcome.result));
    write_file_atomically(command.folder / "result.json", to_json(result).dump(1) + "\n");
    if (command.json) write_result(*command.json, to_json(result).dump(1));
    if (command.junit) write_result(*command.junit, to_junit(result));
    if (!command.json || *command.json != "-") {
        fmt::print("{}", to_text(result, is_colour_wanted(STDOUT_FILENO), shop.verbosity));
        fmt::print("\nreport: {}\n", std::filesystem::absolute(report).lexically_normal().string());
    }
    return outcome.exit;
}

} // namespace threefold
