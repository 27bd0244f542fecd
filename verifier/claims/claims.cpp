// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>

#include "exporter/file_reader.h"
#include "scenes/error.h"
#include "scenes/validate.h"
#include "verifier/claims/claim.h"

namespace threefold {

std::vector<Claim> built_in_claims() {
    return {
        // What a person wants to know first stands first; calibration before all, for a renderer that fails it counts
        // in
        // no other claim; whole pictures, which take longest, last.
        claim_calibration(),  claim_solid_vs_hollow(), claim_palm(),           claim_folds(),
        claim_three_lines(),  claim_wall_limit(),      claim_rim_reads_wall(), claim_shift(),
        claim_hand_contact(), claim_calcite(),         claim_dark_layer(),     claim_tint(),
        claim_soft_light(),   claim_white_spots(),     claim_energy(),         claim_salvator(),
        claim_setup(),
    };
}

const Claim &find_claim(const std::vector<Claim> &claims, std::string_view name) {
    const auto found = std::ranges::find(claims, name, &Claim::name);
    if (found != claims.end()) return *found;
    std::vector<std::string> valid;
    for (const Claim &c : claims) valid.push_back(c.name);
    throw Error(Exit::usage, unknown_name("claim", name, valid));
}

Assignment assign(std::string_view name, double value) { return {std::string(name), fmt::format("{}", value)}; }
Assignment assign(std::string_view name, std::string_view value) { return {std::string(name), std::string(value)}; }

Experiment ClaimContext::experiment(std::string name, std::string title, std::string_view scene,
                                    const std::vector<Assignment> &defaults,
                                    const std::vector<Assignment> &fixed) const {
    const SceneRecipe &recipe = find_scene(scenes, scene);
    Parameters values(recipe.parameters, preset, file_reader());
    for (const Assignment &a : defaults) values.set(a.name, a.value);
    for (const Assignment &a : assignments)
        if (values.has(a.name)) values.set(a.name, a.value);
    for (const Assignment &a : fixed) values.set(a.name, a.value);

    Experiment e;
    e.name = std::move(name);
    e.title = std::move(title);
    e.scene = recipe.make(values);
    validate(e.scene); // before a claim computes anything on it
    e.record.name = e.name;
    e.record.title = e.title;
    e.record.scene = recipe.name;
    for (const ParameterSpec &s : recipe.parameters) e.record.parameters[s.name] = values.text(s.name);
    return e;
}

} // namespace threefold
