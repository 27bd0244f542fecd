// SPDX-License-Identifier: MIT
#include "verifier/report/claim_groups.h"

#include <algorithm>

namespace threefold::report {

Verdict ClaimGroup::verdict() const {
    Verdict all = first().verdict;
    for (const ClaimResult *part : parts) all = all_of(all, part->verdict);
    return all;
}

const ClaimResult *ClaimGroup::under(std::string_view preset) const {
    const auto found = std::ranges::find(parts, preset, &ClaimResult::preset);
    return found == parts.end() ? nullptr : *found;
}

std::vector<ClaimGroup> groups_of(const RunResult &result) {
    std::vector<ClaimGroup> groups;
    for (const ClaimResult &claim : result.claims) {
        const auto belongs = [&](const ClaimGroup &g) {
            return g.first().name == claim.name && !g.under(claim.preset);
        };
        const auto group = std::ranges::find_if(groups, belongs);
        if (group == groups.end())
            groups.push_back({{&claim}});
        else
            group->parts.push_back(&claim);
    }
    return groups;
}

std::vector<std::string> presets_of(const RunResult &result) {
    std::vector<std::string> presets;
    for (const ClaimResult &claim : result.claims)
        if (std::ranges::count(presets, claim.preset) == 0) presets.push_back(claim.preset);
    return presets;
}

std::string_view meaning_of_preset(std::string_view preset) {
    if (preset == "text") return "the study's wording";
    if (preset == "published") return "the study's published scene files";
    return "";
}

} // namespace threefold::report
