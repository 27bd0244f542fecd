// SPDX-License-Identifier: MIT
#include "verifier/check/conclude.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "verifier/claims/scope.h"

namespace threefold {

namespace {

/// Each effect once, by the number that it could move farthest beyond its margin.
std::vector<ScopeFinding> scope_findings(const std::vector<ScopeNumber> &numbers) {
    std::vector<ScopeFinding> findings;
    for (const EffectEntry &entry : effects())
        if (const ScopeNumber *n = most_moved(numbers, entry.effect); n && n->requires_effect(entry.effect))
            findings.push_back({std::string(entry.name), n->quantity, n->unit, n->value,
                                n->bounds.of(entry.effect).value, n->margin, scope_sentence(*n, entry.effect)});
    return findings;
}

void blame(ClaimResult &result, const std::string &witness) {
    if (std::ranges::count(result.blamed, witness) == 0) result.blamed.push_back(witness);
}

/// Of three pictures of one scene, two that agree with each other and not with the third.
void blame_the_odd_one_out(const std::vector<WitnessRecord> &renderers, ClaimResult &result) {
    for (const ExperimentRecord &e : result.experiments)
        for (const WitnessRecord &w : renderers) {
            int with = 0, failing_with = 0, without = 0, holding_without = 0;
            for (const TileComparison &t : result.tiles) {
                if (t.experiment != e.name) continue;
                const bool takes_part = t.witness == w.name || t.versus == w.name;
                (takes_part ? with : without) += 1;
                failing_with += takes_part && t.verdict == Verdict::fails;
                holding_without += !takes_part && t.verdict == Verdict::holds;
            }
            if (with > 1 && failing_with == with && without > 0 && holding_without == without) blame(result, w.name);
        }
}

void add_notes(const PlannedClaim &planned, ClaimResult &result) {
    const Claim &claim = *planned.claim;
    if (claim.notes) result.notes = claim.notes(planned.context);
    for (const Experiment &e : planned.experiments)
        if (std::ranges::any_of(
                result.rows, [&](const Row &row) { return row.experiment == e.name && std::isnan(row.measured.mean); }))
            result.notes.push_back(
                fmt::format("With these values \"{}\" cannot be read: what is looked for is hidden, too narrow, or not "
                            "in the picture. Of that nothing is said.",
                            e.title));
    for (const std::string &name : unused_values(planned))
        result.notes.push_back(fmt::format("This claim sets {} itself: your value is not used.", name));
}

} // namespace

ClaimResult result_of(const PlannedClaim &planned) {
    ClaimResult result;
    result.name = planned.claim->name;
    result.statement = planned.claim->statement;
    result.preset = to_string(planned.context.preset);
    return result;
}

ClaimResult claim_without_scene(const PlannedClaim &planned) {
    ClaimResult result = result_of(planned);
    result.summary = "It could not be asked: these values leave it no scene.";
    result.notes = {planned.problem};
    return result;
}

void conclude_claim(const PlannedClaim &planned, const std::vector<WitnessRecord> &renderers, bool complete,
                    ClaimResult &result) {
    const Claim &claim = *planned.claim;
    const bool calibrating = claim.name == calibration_name;
    const bool compared = !result.rows.empty() || !result.tiles.empty(); // one picture alone agrees with nothing
    result.verdict = complete && compared ? Verdict::holds : Verdict::undecided;
    const auto counts = [&](const std::string &witness, const std::string &versus) {
        return calibrating || std::ranges::none_of(renderers, [&](const WitnessRecord &w) {
                   return (w.name == witness || w.name == versus) && !w.problem.empty();
               });
    };
    for (const Row &row : result.rows)
        if (counts(row.witness, row.versus)) {
            result.verdict = all_of(result.verdict, row.verdict);
            // A difference names neither side alone, and a conclusion that optics itself denies is nobody's fault.
            if (row.verdict == Verdict::fails && row.versus.empty() && row.relation == Relation::equal)
                blame(result, row.witness);
        }
    for (const TileComparison &tiles : result.tiles)
        if (counts(tiles.witness, tiles.versus)) result.verdict = all_of(result.verdict, tiles.verdict);
    if (std::ranges::all_of(renderers, [](const WitnessRecord &w) { return w.problem.empty(); }))
        blame_the_odd_one_out(renderers, result);
    if (claim.summary) result.summary = claim.summary(planned.context, result.verdict);
    add_notes(planned, result);
    if (claim.flips) result.flips = claim.flips(planned.context);
    if (claim.scope) result.scope = scope_findings(claim.scope(planned.context, {}));
}

void apply_calibrations(const std::vector<ClaimResult> &calibrations, const std::set<std::string> &left_out,
                        std::vector<WitnessRecord> &renderers) {
    for (WitnessRecord &w : renderers) {
        if (!w.present || left_out.contains(w.name)) continue;
        std::optional<Verdict> verdict;
        for (const ClaimResult &calibration : calibrations)
            for (const Row &row : calibration.rows)
                if (row.witness == w.name) verdict = all_of(verdict.value_or(Verdict::holds), row.verdict);
        if (verdict) w.calibrated = *verdict == Verdict::holds;
        if (verdict != Verdict::holds)
            w.problem = fmt::format("{} {}: it has no vote", w.title,
                                    verdict == Verdict::fails ? "failed its calibration" : "could not be calibrated");
    }
}

void conclude_run(RunResult &result, const std::vector<std::string> &refusals) {
    result.verdict = Verdict::holds;
    std::vector<std::string> failing, open, blamed, problems, titles;
    for (const ClaimResult &c : result.claims) {
        const std::string name = result.preset == "both" ? fmt::format("{} ({})", c.name, c.preset) : c.name;
        result.verdict = all_of(result.verdict, c.verdict);
        if (c.verdict == Verdict::fails) failing.push_back(name);
        if (c.verdict == Verdict::undecided) open.push_back(name);
        for (const std::string &b : c.blamed)
            if (std::ranges::count(blamed, b) == 0) blamed.push_back(b);
    }
    for (const WitnessRecord &w : result.witnesses) {
        if (w.problem.empty())
            titles.push_back(w.title);
        else
            problems.push_back(w.problem);
    }
    problems.insert(problems.end(), refusals.begin(), refusals.end());
    switch (result.verdict) {
    case Verdict::holds:
        result.summary =
            fmt::format("Every conclusion checked holds in {}, within tolerances that were fixed before rendering.",
                        fmt::join(titles, ", "));
        break;
    case Verdict::fails:
        result.summary =
            fmt::format("Fails: {}{}.", fmt::join(failing, ", "),
                        blamed.empty() ? "" : fmt::format(" (the numbers of {} are off)", fmt::join(blamed, ", ")));
        break;
    case Verdict::undecided:
        result.summary = fmt::format("Undecided: {}.", fmt::join(open, ", "));
        break;
    }
    for (const std::string &p : problems) result.summary += " " + p + ".";
}

} // namespace threefold
