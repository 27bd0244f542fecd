// SPDX-License-Identifier: MIT
#include "verifier/report/junit.h"

#include <cmath>
#include <sstream>
#include <string_view>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "verifier/report/claim_groups.h"
#include "verifier/report/text.h"
#include "verifier/report/words.h"

namespace threefold {

namespace {

using namespace report;

struct Counts {
    int tests = 0, failures = 0, skipped = 0;

    Counts &operator+=(const Counts &other) {
        tests += other.tests, failures += other.failures, skipped += other.skipped;
        return *this;
    }
};

void set(pugi::xml_node node, const char *attribute, std::string_view value) {
    node.append_attribute(attribute) = one_line(value).c_str();
}

void set_seconds(pugi::xml_node node, double seconds) {
    set(node, "time", fmt::format("{:.3f}", std::isfinite(seconds) ? seconds : 0.0));
}

void set(pugi::xml_node node, const Counts &counts) {
    node.append_attribute("tests") = counts.tests;
    node.append_attribute("failures") = counts.failures;
    node.append_attribute("errors") = 0;
    node.append_attribute("skipped") = counts.skipped;
}

/// A suite under construction: its counts are attributes that are known only at its end.
struct Suite {
    pugi::xml_node node;
    std::string name;
    Counts counts;

    pugi::xml_node add_case(std::string_view witness, std::string_view title) {
        pugi::xml_node test = node.append_child("testcase");
        set(test, "classname", fmt::format("threefold.{}{}{}", name, witness.empty() ? "" : ".", witness));
        set(test, "name", title);
        ++counts.tests;
        return test;
    }

    void add_outcome(pugi::xml_node test, Verdict verdict, const std::string &message, const std::string &details) {
        if (verdict == Verdict::holds) {
            test.append_child("system-out").text() = printable(message + "\n" + details).c_str();
            return;
        }
        const bool failure = verdict == Verdict::fails;
        ++(failure ? counts.failures : counts.skipped);
        pugi::xml_node outcome = test.append_child(failure ? "failure" : "skipped");
        set(outcome, "message", message);
        if (failure) set(outcome, "type", "outside tolerance");
        if (!details.empty()) outcome.text() = printable(details).c_str();
    }
};

Suite add_suite(pugi::xml_node root, const RunResult &result, const std::string &name) {
    Suite suite{root.append_child("testsuite"), name, {}};
    set(suite.node, "name", name);
    if (!result.started.empty()) set(suite.node, "timestamp", result.started);
    return suite;
}

std::string itemised(const std::vector<BudgetItem> &budget) {
    std::string text;
    for (const BudgetItem &item : budget) text += fmt::format("{} {:.3g}: {}\n", item.name, item.value, item.reason);
    return text.empty() ? text : "tolerance:\n" + text;
}

std::string with_advice(std::string text, Verdict verdict, std::optional<int> replicates) {
    const std::string advice = what_would_decide(verdict, replicates);
    return advice.empty() ? text : "undecided: " + text + "; " + advice;
}

void add_claim(Suite &suite, const RunResult &result, const ClaimResult &claim) {
    for (const Row &row : claim.rows) {
        const std::string against = row.versus.empty() ? "closed form" : title_of(result, row.versus);
        const auto test =
            suite.add_case(row.witness, fmt::format("{}: {} ({} against {})", row.experiment, row.quantity,
                                                    title_of(result, row.witness), against));
        suite.add_outcome(test, row.verdict, with_advice(sentence(row), row.verdict, row.replicates_to_decide),
                          itemised(row.budget));
    }
    for (const TileComparison &tiles : claim.tiles) {
        const auto test =
            suite.add_case(tiles.witness, fmt::format("{}: pictures, tile by tile ({} against {})", tiles.experiment,
                                                      title_of(result, tiles.witness), title_of(result, tiles.versus)));
        suite.add_outcome(test, tiles.verdict, with_advice(sentence(tiles), tiles.verdict, tiles.replicates_to_decide),
                          itemised(tiles.budget));
    }
    // A claim can be undecided for what is missing from its rows; it must not look passed then.
    if (of_all_rows(claim) != claim.verdict)
        suite.add_outcome(suite.add_case("", "verdict"), claim.verdict,
                          claim.summary.empty() ? claim.statement : claim.summary, "");
}

void add_renderer_suite(Suite &suite, const RunResult &result) {
    for (const WitnessRecord &witness : result.witnesses) {
        const auto test = suite.add_case(witness.name, witness.title.empty() ? witness.name : witness.title);
        set_seconds(test, witness.seconds);
        const bool voted = witness.present && witness.calibrated.value_or(true) && witness.problem.empty();
        if (voted) continue;
        const std::string reason = !witness.present ? "missing" : "had no vote";
        suite.add_outcome(test, Verdict::undecided,
                          witness.problem.empty() ? reason : fmt::format("{}: {}", reason, witness.problem), "");
    }
}

} // namespace

std::string to_junit(const RunResult &result) {
    pugi::xml_document document;
    pugi::xml_node declaration = document.append_child(pugi::node_declaration);
    set(declaration, "version", "1.0");
    set(declaration, "encoding", "UTF-8");
    pugi::xml_node root = document.append_child("testsuites");
    set(root, "name", "threefold");
    Counts all;
    const auto close = [&](Suite &suite) {
        set(suite.node, suite.counts);
        all += suite.counts;
    };
    if (!result.witnesses.empty()) {
        Suite suite = add_suite(root, result, "renderers");
        add_renderer_suite(suite, result);
        close(suite);
    }
    for (const ClaimGroup &group : groups_of(result))
        for (const ClaimResult *claim : group.parts) {
            // A claim judged under both presets is two suites with names of their own.
            Suite suite =
                add_suite(root, result, group.parts.size() > 1 ? claim->name + "." + claim->preset : claim->name);
            add_claim(suite, result, *claim);
            close(suite);
        }
    set(root, all);
    set_seconds(root, result.seconds);
    std::ostringstream out;
    document.save(out, "  ");
    return out.str();
}

} // namespace threefold
