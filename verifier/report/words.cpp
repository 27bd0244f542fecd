// SPDX-License-Identifier: MIT
#include "verifier/report/words.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "verifier/report/claim_groups.h"
#include "verifier/report/numbers.h"
#include "verifier/report/text.h"

namespace threefold::report {

namespace {

std::optional<Verdict> combine(std::optional<Verdict> a, Verdict b) { return a ? all_of(*a, b) : b; }

/// " under both presets", " under published"; empty for a run under one preset, and where it differs by claim.
std::string under(const RunResult &result, const std::vector<ClaimGroup> &groups, Verdict verdict) {
    const std::vector<std::string> presets = presets_of(result);
    if (presets.size() < 2) return "";
    std::vector<std::string> where; // under which some claim has this verdict
    bool everywhere = true;         // such a claim has it under all
    for (const ClaimGroup &group : groups) {
        if (group.verdict() != verdict) continue;
        for (const std::string &preset : presets) {
            const ClaimResult *part = group.under(preset);
            if (!part || part->verdict != verdict)
                everywhere = false;
            else if (std::ranges::count(where, preset) == 0)
                where.push_back(preset);
        }
    }
    if (everywhere) return " under both presets";
    return where.size() == 1 ? " under " + one_line(where.front()) : "";
}

std::string expectation(const Row &row, double resolution) {
    const std::string value = bound_at(row.expected, resolution);
    switch (row.relation) {
    case Relation::equal:
        return fmt::format("expected {} within {}", value, number(row.tolerance));
    case Relation::below:
        return "expected below " + value;
    case Relation::above:
        return "expected above " + value;
    }
    return value;
}

} // namespace

std::string headline(const RunResult &result) {
    if (is_running(result))
        return fmt::format("Running: {} of {} {} judged", result.claims.size(), result.claims_planned,
                           result.preset == "both" ? "claims and presets" : "claims");
    const std::vector<ClaimGroup> groups = groups_of(result);
    const auto with = [&](Verdict v) { return std::ranges::count(groups, v, &ClaimGroup::verdict); };
    const auto claims = std::ssize(groups);
    const auto fails = with(Verdict::fails), undecided = with(Verdict::undecided);
    if (claims == 0) return "Nothing was checked";
    if (fails == 0 && undecided == 0) {
        const std::string all = (claims == 1 ? "The claim holds" : fmt::format("All {} claims hold", claims)) +
                                under(result, groups, Verdict::holds);
        return result.verdict == Verdict::holds ? all : all + ", but not everything was tested";
    }
    const Verdict worst = fails ? Verdict::fails : Verdict::undecided;
    if (claims == 1) return (fails ? "The claim fails" : "The claim is undecided") + under(result, groups, worst);
    if (fails == 0)
        return fmt::format("{} of {} claims {} undecided{}", undecided, claims, undecided == 1 ? "is" : "are",
                           under(result, groups, worst));
    std::string text =
        fmt::format("{} of {} claims {}{}", fails, claims, fails == 1 ? "fails" : "fail", under(result, groups, worst));
    if (undecided) text += fmt::format(", {} {} undecided", undecided, undecided == 1 ? "is" : "are");
    return text;
}

bool is_running(const RunResult &result) { return result.claims.size() < result.claims_planned; }

std::string_view symbol(Verdict verdict) {
    switch (verdict) {
    case Verdict::holds:
        return "✓";
    case Verdict::fails:
        return "✗";
    case Verdict::undecided:
        return "?";
    }
    return "";
}

std::string title_of(const RunResult &result, std::string_view witness) {
    const auto found = std::ranges::find(result.witnesses, witness, &WitnessRecord::name);
    return found == result.witnesses.end() || found->title.empty() ? std::string(witness) : found->title;
}

std::string title_of(const RunResult &result, const Row &row) {
    const std::string title = title_of(result, row.witness);
    return row.versus.empty() ? title : title + " minus " + title_of(result, row.versus);
}

std::string experiment_title(const ClaimResult &claim, std::string_view experiment) {
    const auto found = std::ranges::find(claim.experiments, experiment, &ExperimentRecord::name);
    return found == claim.experiments.end() || found->title.empty() ? std::string(experiment) : found->title;
}

std::optional<Verdict> against_closed_form(const ClaimResult &claim, std::string_view witness) {
    std::optional<Verdict> all;
    for (const Row &row : claim.rows)
        if (row.versus.empty() && row.witness == witness) all = combine(all, row.verdict);
    return all;
}

std::optional<Verdict> between_renderers(const ClaimResult &claim) {
    std::optional<Verdict> all;
    for (const Row &row : claim.rows)
        if (!row.versus.empty()) all = combine(all, row.verdict);
    for (const TileComparison &tiles : claim.tiles) all = combine(all, tiles.verdict);
    return all;
}

std::optional<Verdict> of_all_rows(const ClaimResult &claim) {
    std::optional<Verdict> all = between_renderers(claim);
    for (const Row &row : claim.rows) all = combine(all, row.verdict);
    return all;
}

std::string coverage(const Row &row) { return fmt::format("{:g} %", 100 * (1 - 2 * row.level)); }

std::string sentence(const Row &row) {
    const double step = resolution(row);
    const std::string unit = row.unit.empty() ? "" : " " + row.unit;
    return fmt::format("measured {}{} ({} interval {} to {}), {}{}", number_at(row.measured.mean, step), unit,
                       coverage(row), number_at(row.interval.low, step), number_at(row.interval.high, step),
                       expectation(row, step), unit);
}

std::string sentence(const TileComparison &t) {
    const auto share = [&](double radiance) {
        return t.mean_radiance > 0 ? percent(radiance / t.mean_radiance) + " of the mean radiance"
                                   : number(radiance) + " in radiance";
    };
    std::string text =
        fmt::format("worst tile (column {}, row {}) differs by {}, tolerance {}; {} hold", t.worst_column, t.worst_row,
                    share(t.worst_difference), share(t.tolerance), count(t.holding, "tile"));
    if (t.holding == 1) text += "s";
    if (t.failing) text += fmt::format(", {} {}", t.failing, t.failing == 1 ? "fails" : "fail");
    if (t.open) text += fmt::format(", {} undecided", t.open);
    if (t.allowed) text += fmt::format(" ({} may differ)", t.allowed);
    if (!t.problem.empty()) text += "; not judged: " + t.problem;
    return text;
}

std::string what_would_decide(Verdict verdict, std::optional<int> replicates) {
    if (verdict != Verdict::undecided) return {};
    return replicates ? count(*replicates, "replicate") + " would decide" : "more replicates would not decide";
}

} // namespace threefold::report
