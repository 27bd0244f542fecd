// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include <fmt/format.h>

#include "tools/restored_impact.h"

namespace threefold {
namespace {

using optics::Quad;

TEST(RestoredImpact, TakesAProductCutOffByItsPrintWhole) {
    const std::string printed = "67.94114226938831789958886"; // 67.941164882 times a double
    const Quad limit("67.941164882"), restored = restored_impact(Quad(printed), printed, limit);
    EXPECT_NE(restored, Quad(printed));
    EXPECT_LT(abs(restored - Quad(printed)), Quad("5.0001e-24"));
    const Quad share = restored / limit;
    EXPECT_LT(abs(share - Quad(fmt::format("{}", static_cast<double>(share)))), Quad("1e-31"));
}

TEST(RestoredImpact, LeavesEveryOtherNumberAsItStands) {
    const Quad limit("67.941164882");
    for (const std::string text : {"60", "67.9411422693883178", "67.94114226938831789958887",
                                   "67.94114226938831789958886123", "0", "0.0007569180881855261950524457"})
        EXPECT_EQ(restored_impact(Quad(text), text, limit), Quad(text)) << text;
}

} // namespace
} // namespace threefold
