// SPDX-License-Identifier: MIT
// scope: what each claim leaves out, and how far it could move the claim's numbers.
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tools/commands.h"
#include "tools/progress.h"
#include "verifier/studies/scope.h"
#include "verifier/studies/scope_report.h"

namespace threefold {

Exit command_scope(const Shop &shop, const ScopeCommand &command) {
    if (command.json == "-" && command.markdown == "-")
        throw Error(Exit::usage, "--json and --markdown cannot both go to stdout");
    ScopeRequest request;
    if (command.claims.empty()) request.claims = shop.claims;
    for (const std::string &name : command.claims) request.claims.push_back(find_claim(shop.claims, name));
    request.scenes = shop.scenes;
    request.presets = command.preset == "both" ? std::vector{Preset::text, Preset::published}
                                               : std::vector{parse_preset(command.preset)};
    for (const std::string &text : command.assignments) request.assignments.push_back(parse_assignment(text));
    request.settings = command.settings;
    if (!(request.settings.least_wavelength_nm <= request.settings.greatest_wavelength_nm))
        std::swap(request.settings.least_wavelength_nm, request.settings.greatest_wavelength_nm);
    request.impact_mm = command.impact_mm;
    request.closed_forms_only = command.quick;
    request.threads = shop.threads;

    Progress progress({"scope"}, shop.verbosity < 0);
    request.on_progress = [&progress](double share, const std::string &now) { progress.update("scope", share, now); };
    ScopeResult result = study_scope(request);
    progress.finish();
    result.threefold_version = THREEFOLD_VERSION;
    result.command = shop.command_line;

    const std::string page = to_markdown(result);
    if (command.json) write_result(*command.json, to_json(result).dump(1));
    if (command.markdown) write_result(*command.markdown, page.substr(0, page.size() - 1));
    if (command.json != "-" && command.markdown != "-") fmt::print("{}", to_text(result, shop.verbosity > 0));
    return Exit::holds;
}

} // namespace threefold
