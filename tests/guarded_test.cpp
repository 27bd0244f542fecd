// SPDX-License-Identifier: MIT
// A function in a child process: whatever it does, we go on and know why it gave nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "exporter/process/child.h"
#include "exporter/process/guarded.h"
#include "scenes/error.h"

namespace threefold {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

TEST(Guarded, WhatTheFunctionReturnsComesBackWhole) {
    const std::string large(5'000'000, 'x');
    const GuardedResult result = run_guarded({.work = [&] { return large + '\0' + "end"; }});
    EXPECT_TRUE(result.succeeded);
    EXPECT_EQ(result.bytes, large + '\0' + "end");
    EXPECT_TRUE(run_guarded({.work = [] { return std::string(); }}).succeeded);
}

TEST(Guarded, AnExceptionIsAFailureInItsOwnWordsOnOneLine) {
    const GuardedResult result =
        run_guarded({.work = []() -> std::string { throw std::runtime_error("two\nlines\n"); }});
    EXPECT_FALSE(result.succeeded);
    EXPECT_EQ(result.failure, "two lines");
}

TEST(Guarded, ACrashIsAFailure) {
    EXPECT_THAT(run_guarded({.work = []() -> std::string { std::abort(); }}).failure, HasSubstr("Aborted"));
    EXPECT_THAT(run_guarded({.work = []() -> std::string {
                    std::raise(SIGSEGV);
                    return "";
                }}).failure,
                HasSubstr("Segmentation fault"));
}

TEST(Guarded, AFunctionThatNeverEndsIsStopped) {
    const auto start = std::chrono::steady_clock::now();
    const GuardedResult result = run_guarded({.work = []() -> std::string {
                                                  for (volatile bool forever = true; forever;) {
                                                  }
                                                  return "";
                                              },
                                              .time_limit = milliseconds(300)});
    EXPECT_THAT(result.failure, HasSubstr("longer than 0.3 s"));
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(Guarded, AFunctionThatTakesAllMemoryIsStopped) {
    const GuardedResult result = run_guarded({.work = []() -> std::string {
                                                  std::vector<std::vector<char>> all;
                                                  for (;;) all.emplace_back(std::size_t{64} << 20);
                                              },
                                              .memory_bytes = std::int64_t{256} << 20});
    EXPECT_THAT(result.failure, HasSubstr("GB of memory"));
}

TEST(Guarded, AnInterruptEndsTheWaiting) {
    interrupt_requested = true;
    EXPECT_THROW(run_guarded({.work = [] { return std::string(); }}), Error);
    interrupt_requested = false;
}

} // namespace
} // namespace threefold
