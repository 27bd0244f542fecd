// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tools/progress.h"

namespace threefold {
namespace {

const ProgressClock::time_point start{};

ProgressClock::time_point after(double seconds) {
    return start + std::chrono::duration_cast<ProgressClock::duration>(std::chrono::duration<double>(seconds));
}

TEST(ProgressLine, CountsTimeLeftFromItsOwnBeginWhateverOtherLinesDo) {
    ProgressLine slow, quick;
    slow.update(start, 0, "");
    for (int second = 0; second <= 100; ++second) {
        quick.update(after(second), second / 200.0, "");
        if (second % 25 == 0) slow.update(after(second), second / 1000.0, "");
    }
    EXPECT_EQ(quick.time_left(after(100)), "1 min 40 s left");
    EXPECT_EQ(slow.time_left(after(100)), "15 min 00 s left");
}

TEST(ProgressLine, CountsTimeLeftFromItsFirstUpdateWhenLinesComeOneAfterAnother) {
    ProgressLine second;
    second.update(after(1000), 0, "");
    second.update(after(1010), 0.5, "");
    EXPECT_EQ(second.time_left(after(1010)), "10 s left");
}

TEST(ProgressLine, TakesWhatAnEarlierRunLeftForNoWorkOfThisOne) {
    ProgressLine line;
    line.update(start, 0.5, "");
    EXPECT_EQ(line.time_left(after(1)), "");
    line.update(after(10), 0.6, "");
    EXPECT_EQ(line.time_left(after(10)), "40 s left");
}

TEST(ProgressLine, SaysNothingBeforeItCanTellAndDoneAtTheEnd) {
    ProgressLine line;
    EXPECT_EQ(line.time_left(start), "");
    line.update(start, 0, "");
    line.update(after(5), 0.01, "");
    EXPECT_EQ(line.time_left(after(5)), "");
    line.update(after(6), 1, "");
    EXPECT_EQ(line.time_left(after(6)), "done");
}

TEST(ProgressLine, NeverGoesBack) {
    ProgressLine line;
    line.update(start, 0, "");
    line.update(after(1), 0.5, "");
    line.update(after(2), 0.2, "");
    EXPECT_EQ(line.share, 0.5);
}

} // namespace
} // namespace threefold
