// SPDX-License-Identifier: MIT
#include "verifier/report/terminal.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "verifier/report/claim_groups.h"
#include "verifier/report/flip_words.h"
#include "verifier/report/numbers.h"
#include "verifier/report/text.h"
#include "verifier/report/time_table.h"
#include "verifier/report/words.h"

namespace threefold {

namespace {

using namespace report;

/// Paints what is already free of control characters.
struct Painter {
    bool colour = false;

    std::string bold(std::string_view text) const { return wrap("1", text); }
    std::string faint(std::string_view text) const { return wrap("2", text); }
    std::string verdict(Verdict verdict, std::string_view text) const {
        return wrap(verdict == Verdict::holds ? "32" : verdict == Verdict::fails ? "1;31" : "33", text);
    }

private:
    std::string wrap(std::string_view code, std::string_view text) const {
        return colour ? fmt::format("\x1b[{}m{}\x1b[0m", code, text) : std::string(text);
    }
};

std::string mark(const Painter &paint, Verdict verdict) {
    return paint.verdict(verdict, fmt::format("{} {:<9}", symbol(verdict), to_string(verdict)));
}

std::string renderer_line(const RunResult &result, const ClaimResult &claim, const Painter &paint) {
    std::vector<std::string> parts;
    const auto add = [&](const std::string &who, std::optional<Verdict> verdict) {
        if (verdict) parts.push_back(fmt::format("{} {}", one_line(who), paint.verdict(*verdict, to_string(*verdict))));
    };
    const bool has_closed_form = std::ranges::any_of(claim.rows, [](const Row &row) { return row.versus.empty(); });
    for (const WitnessRecord &witness : result.witnesses) {
        const std::optional<Verdict> verdict = against_closed_form(claim, witness.name);
        add(title_of(result, witness.name), verdict);
        if (!verdict && has_closed_form && witness.present)
            parts.push_back(fmt::format("{} {}", one_line(title_of(result, witness.name)),
                                        paint.verdict(Verdict::undecided, "gave no picture")));
    }
    add("between renderers", between_renderers(claim));
    std::string line;
    for (const std::string &part : parts) line += (line.empty() ? "" : " · ") + part;
    return line;
}

void add_item(std::string &out, const Painter &paint, const std::string &indent, Verdict verdict,
              const std::string &what, const std::string &numbers, const std::string &advice) {
    out += fmt::format("{}{} {}\n", indent, mark(paint, verdict), one_line(what));
    out += fmt::format("{}  {}\n", indent, one_line(numbers));
    if (!advice.empty()) out += fmt::format("{}  {}\n", indent, paint.faint(advice));
}

/// What lies beneath a claim's line, `indent` deep.
void add_findings(std::string &out, const RunResult &result, const ClaimResult &claim, const Painter &paint,
                  const std::string &indent, int verbosity) {
    for (const FlipPoint &flip : claim.flips) {
        std::string line = "flips at " + one_line(flip_line(flip));
        if (const auto verdict = bracket_verdict(claim, flip)) {
            line += ", bracketed by renders" + (verbosity > 0 ? " " + one_line(bracket_text(claim, flip)) : "") + ": " +
                    paint.verdict(*verdict, to_string(*verdict));
        }
        out += indent + line + "\n";
        if (verbosity > 0 && !flip.meaning.empty()) out += indent + "  " + one_line(flip.meaning) + "\n";
    }
    const auto shown = [&](Verdict verdict) { return verbosity > 0 || verdict != Verdict::holds; };
    for (const Row &row : claim.rows)
        if (shown(row.verdict))
            add_item(
                out, paint, indent, row.verdict,
                fmt::format("{}, {}: {}", row.quantity, experiment_title(claim, row.experiment), title_of(result, row)),
                sentence(row), what_would_decide(row.verdict, row.replicates_to_decide));
    for (const TileComparison &tiles : claim.tiles)
        if (shown(tiles.verdict))
            add_item(out, paint, indent, tiles.verdict,
                     fmt::format("pictures tile by tile, {}: {} against {}", experiment_title(claim, tiles.experiment),
                                 title_of(result, tiles.witness), title_of(result, tiles.versus)),
                     sentence(tiles), what_would_decide(tiles.verdict, tiles.replicates_to_decide));
    for (const ScopeFinding &finding : claim.scope)
        out += indent + paint.verdict(Verdict::undecided, "within its model: ") + one_line(finding.sentence) + "\n";
    if (claim.verdict != Verdict::holds && !claim.summary.empty()) out += indent + one_line(claim.summary) + "\n";
    if (verbosity > 0)
        for (const std::string &note : claim.notes) out += indent + one_line(note) + "\n";
}

void print_claim(std::string &out, const RunResult &result, const ClaimGroup &group, const Painter &paint,
                 std::size_t width, int verbosity) {
    const ClaimResult &claim = group.first();
    out += fmt::format("  {} {}{}  {}\n", mark(paint, group.verdict()), paint.bold(one_line(claim.name)),
                       std::string(width - claim.name.size(), ' '), one_line(claim.statement));
    if (group.parts.size() == 1) {
        if (verbosity < 0) return;
        if (const std::string line = renderer_line(result, claim, paint); !line.empty()) out += "      " + line + "\n";
        return add_findings(out, result, claim, paint, "      ", verbosity);
    }
    const bool alike =
        std::ranges::all_of(group.parts, [&](const ClaimResult *p) { return p->verdict == claim.verdict; });
    if (verbosity < 0 && alike) return;
    for (const ClaimResult *part : group.parts) {
        const std::string line = verbosity < 0 ? "" : renderer_line(result, *part, paint);
        out += fmt::format("      {} under {}{}{}\n", mark(paint, part->verdict), one_line(part->preset),
                           line.empty() ? "" : ": ", line);
        if (verbosity >= 0) add_findings(out, result, *part, paint, "        ", verbosity);
    }
}

void print_witness(std::string &out, const WitnessRecord &witness, const Painter &paint) {
    std::string state = !witness.present      ? "missing"
                        : !witness.calibrated ? "not calibrated"
                        : *witness.calibrated ? "calibrated"
                                              : "failed calibration, has no vote";
    if (!witness.problem.empty()) state += ": " + one_line(witness.problem);
    const bool good = witness.present && witness.calibrated.value_or(false) && witness.problem.empty();
    out += fmt::format("  {}{}, {}{}\n", paint.bold(one_line(witness.title.empty() ? witness.name : witness.title)),
                       witness.version.empty() ? "" : " " + one_line(witness.version),
                       good ? state : paint.verdict(Verdict::undecided, state),
                       witness.seconds > 0 ? ", " + duration(witness.seconds) : "");
    if (!witness.injected_fault.empty())
        out += "    " + paint.verdict(Verdict::fails, "fault put in on purpose: " + one_line(witness.injected_fault)) +
               "\n";
}

} // namespace

std::string to_line(const ClaimResult &claim, bool colour, bool with_preset) {
    const Painter paint{colour};
    return fmt::format("{} {}{}  {}", mark(paint, claim.verdict), paint.bold(one_line(claim.name)),
                       with_preset ? fmt::format(" ({})", one_line(claim.preset)) : "", one_line(claim.statement));
}

std::string to_text(const RunResult &result, bool colour, int verbosity) {
    const Painter paint{colour};
    std::string out =
        paint.verdict(result.verdict, fmt::format("{} {}.", symbol(result.verdict), headline(result))) + "\n";
    if (!result.summary.empty()) out += one_line(result.summary) + "\n";
    if (verbosity >= 0 && !result.witnesses.empty()) {
        out += "\n";
        for (const WitnessRecord &witness : result.witnesses) print_witness(out, witness, paint);
    }
    if (!result.claims.empty()) out += "\n";
    std::size_t width = 0;
    for (const ClaimResult &claim : result.claims) width = std::max(width, claim.name.size());
    for (const ClaimGroup &group : groups_of(result)) print_claim(out, result, group, paint, width, verbosity);
    if (verbosity > 0 && !result.renders.empty()) out += "\n" + time_table(result);
    if (verbosity >= 0 && result.seconds > 0)
        out += paint.faint(fmt::format("\n{} in all, {} of it in renderers.", duration(result.seconds),
                                       duration(result.renderer_seconds))) +
               "\n";
    return out;
}

} // namespace threefold
