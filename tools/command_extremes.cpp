// SPDX-License-Identifier: MIT
// extremes: where arithmetic ends in each renderer, and whether it says so.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "exporter/files.h"
#include "tools/commands.h"
#include "tools/progress.h"
#include "verifier/studies/extremes.h"
#include "verifier/studies/extremes_report.h"

namespace threefold {

Exit command_extremes(const Shop &shop, const ExtremesCommand &command) {
    ExtremesRequest request;
    std::vector<std::string> with = command.with;
    if (with.empty() && command.quick) with = {"tracer"};
    request.witnesses = usable_witnesses(with);
    request.sweeps = command.sweeps;
    request.quick = command.quick;
    request.threads = shop.threads;
    request.time_limit = to_time_limit(command.time_limit_s);
    request.folder = command.folder;

    Progress progress({"extremes"}, shop.verbosity < 0);
    request.on_progress = [&progress](double share, const std::string &now) {
        progress.update("extremes", share, now);
    };
    ExtremesResult result = study_extremes(request);
    progress.finish();
    result.threefold_version = THREEFOLD_VERSION;
    result.command = shop.command_line;
    result.versions = versions_with(request.witnesses);

    const std::string json = to_json(result).dump(1);
    write_file_atomically(command.folder / "extremes.json", json + "\n");
    write_file_atomically(command.folder / "extremes.svg", to_svg(result));
    write_file_atomically(command.folder / "extremes.md", to_markdown(result, "extremes.svg"));
    if (command.json) write_result(*command.json, json);
    if (command.json != "-") {
        fmt::print("{}", to_text(result));
        fmt::print("\nmap: {}\n",
                   std::filesystem::absolute(command.folder / "extremes.svg").lexically_normal().string());
    }
    return result.faults().empty() ? Exit::holds : Exit::fails;
}

} // namespace threefold
