// SPDX-License-Identifier: MIT
// Every claim with our tracer alone: it holds, and its mutant makes it fail.
#include <gtest/gtest.h>

#include <algorithm>

#include "exporter/temporary_folder.h"
#include "scenes/catalogue/catalogue.h"
#include "tests/quick_request.h"
#include "verifier/check/check.h"
#include "verifier/report/html.h"

namespace threefold {
namespace {

class EveryClaim : public testing::TestWithParam<std::string> {};

TEST_P(EveryClaim, HoldsInTheTracerUnderBothPresets) {
    const TemporaryFolder folder;
    for (const Preset preset : {Preset::text, Preset::published}) {
        CheckRequest r = quick_request<CheckRequest>(folder.path(), {GetParam()});
        r.presets = {preset};
        const CheckOutcome outcome = check(r);
        if (outcome.result.claims.front().rows.empty()) { // pictures to be compared, and one renderer alone
            EXPECT_EQ(outcome.exit, Exit::undecided);
            continue;
        }
        EXPECT_EQ(outcome.result.verdict, Verdict::holds) << outcome.result.summary;
        EXPECT_EQ(outcome.exit, Exit::holds);
        for (const Row &row : outcome.result.claims.front().rows) {
            if (row.relation != Relation::equal) continue;
            EXPECT_FALSE(row.budget.empty()) << row.quantity << ": a tolerance has an itemised budget";
            EXPECT_DOUBLE_EQ(total(row.budget), row.tolerance);
        }
    }
}

TEST_P(EveryClaim, FailsUnderItsMutantAndTheRendererIsNamed) {
    const TemporaryFolder folder;
    CheckRequest r = quick_request<CheckRequest>(folder.path(), {GetParam()});
    r.injected["tracer"] = r.claims.front().mutant;
    const CheckOutcome outcome = check(r);
    if (outcome.result.claims.front().rows.empty()) { // see Mutants in check_renderer_test.cpp
        EXPECT_EQ(outcome.exit, Exit::undecided);
        return;
    }
    EXPECT_EQ(outcome.result.verdict, Verdict::fails) << outcome.result.summary;
    EXPECT_EQ(outcome.exit, Exit::fails);
    EXPECT_EQ(outcome.result.claims.front().blamed, std::vector<std::string>{"tracer"});
    EXPECT_NE(to_html(outcome.result).find("racer"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Claims, EveryClaim, testing::ValuesIn([] {
                             std::vector<std::string> names;
                             for (const Claim &c : built_in_claims()) names.push_back(c.name);
                             return names;
                         }()));

TEST(Check, EveryFaultIsAnsweredByFails) {
    const TemporaryFolder folder;
    std::vector<std::string> names;
    for (const Claim &c : built_in_claims()) names.push_back(c.name);
    for (const FaultEntry &fault : faults()) {
        const auto fails = [&](const std::string &name) {
            CheckRequest r = quick_request<CheckRequest>(folder.path(), {name});
            r.injected["tracer"] = fault.fault;
            return check(r).exit == Exit::fails;
        };
        EXPECT_TRUE(std::ranges::any_of(names, fails)) << fault.name; // the first that fails is enough
    }
}

TEST(Check, ASecondRunTakesThePicturesFromTheCacheAndSaysTheSame) {
    const TemporaryFolder folder;
    const CheckRequest r = quick_request<CheckRequest>(folder.path(), {"rim-reads-wall"});
    const RunResult first = check(r).result, second = check(r).result;
    EXPECT_FALSE(first.renders.front().from_cache);
    EXPECT_TRUE(second.renders.front().from_cache);
    EXPECT_EQ(first.claims.front().rows.front().measured.mean, second.claims.front().rows.front().measured.mean);
}

TEST(Check, ADamagedCacheIsRenderedAnew) {
    const TemporaryFolder folder;
    const CheckRequest r = quick_request<CheckRequest>(folder.path(), {"rim-reads-wall"});
    const RunResult first = check(r).result;
    std::filesystem::resize_file(folder.path() / first.renders.front().folder / "replicate-03.tif", 100);
    const RunResult second = check(r).result;
    EXPECT_FALSE(second.renders.front().from_cache);
    EXPECT_EQ(first.claims.front().rows.front().measured.mean, second.claims.front().rows.front().measured.mean);
}

TEST(Check, AnIndexUnderTheCriticalOneMakesTheConclusionFailAndSaysWhy) {
    const TemporaryFolder folder;
    CheckRequest r = quick_request<CheckRequest>(folder.path(), {"solid-vs-hollow"});
    r.assignments = {{"glass.index", "1.15"}};
    const CheckOutcome outcome = check(r);
    EXPECT_EQ(outcome.exit, Exit::fails);
    bool flip_named = false;
    for (const std::string &note : outcome.result.claims.front().notes)
        flip_named |= note.find("1.2103") != std::string::npos;
    EXPECT_TRUE(flip_named);
    for (const Row &row : outcome.result.claims.front().rows)
        if (row.relation == Relation::equal) {
            EXPECT_EQ(row.verdict, Verdict::holds)
                << "the renderer still agrees with the closed form: " << row.quantity;
        }
}

TEST(Check, AnUnknownParameterIsRefusedBeforeAnythingIsRendered) {
    const TemporaryFolder folder;
    CheckRequest r = quick_request<CheckRequest>(folder.path(), {"rim-reads-wall"});
    r.assignments = {{"orb.wal_mm", "2"}};
    EXPECT_THROW(check(r), Error);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

} // namespace
} // namespace threefold
