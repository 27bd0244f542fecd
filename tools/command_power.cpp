// SPDX-License-Identifier: MIT
// power: known faults against our check and against others' image comparisons.
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "exporter/files.h"
#include "tools/commands.h"
#include "tools/progress.h"
#include "verifier/studies/power.h"
#include "verifier/studies/power_report.h"

namespace threefold {

Exit command_power(const Shop &shop, const PowerCommand &command) {
    if (command.json == "-" && command.markdown == "-")
        throw Error(Exit::usage, "--json and --markdown cannot both go to stdout");
    PowerRequest request;
    for (const Claim &claim : shop.claims)
        if (std::ranges::count(command.without, claim.name) == 0) request.claims.push_back(claim);
    for (const std::string &name : command.without) find_claim(shop.claims, name); // an unknown one is an error
    request.scenes = shop.scenes;
    std::vector<std::string> with = command.with;
    if (with.empty() && command.quick) with = {"tracer"};
    if (!with.empty() && std::ranges::count(with, "tracer") == 0) with.insert(with.begin(), "tracer");
    request.witnesses = usable_witnesses(with); // a missing one would leave every verdict undecided
    for (const FaultEntry &entry : faults())
        if (command.faults.empty() || std::ranges::count(command.faults, entry.name))
            request.faults.push_back(entry.fault);
    for (const std::string &name : command.faults) parse_fault(name);
    request.quick = command.quick;
    request.runs = command.runs.value_or(command.quick ? 10 : 40);
    request.seed = command.seed;
    request.threads = shop.threads;
    request.time_limit = to_time_limit(command.time_limit_s);
    request.tracer = tracer_settings(command.precision, "tree");
    request.folder = command.folder;

    Progress progress({"power"}, shop.verbosity < 0);
    request.on_progress = [&progress](double share, const std::string &now) { progress.update("power", share, now); };
    PowerResult result = study_power(request);
    progress.finish();
    result.threefold_version = THREEFOLD_VERSION;
    result.command = shop.command_line;
    result.versions = versions_with(request.witnesses);

    const std::string json = to_json(result).dump(1), page = to_markdown(result);
    write_file_atomically(command.folder / "power.json", json + "\n");
    write_file_atomically(command.folder / "power.md", page);
    if (command.json) write_result(*command.json, json);
    if (command.markdown) write_result(*command.markdown, page.substr(0, page.size() - 1));
    if (command.json != "-" && command.markdown != "-") {
        fmt::print("{}", to_text(result));
        fmt::print("\ntable: {}\n", std::filesystem::absolute(command.folder / "power.md").lexically_normal().string());
    }
    return result.verdict() == Verdict::holds ? Exit::holds : Exit::fails;
}

} // namespace threefold
