// SPDX-License-Identifier: MIT
// The trade with all three renderers, small: each has a setting that is seen to meet the tolerance, and POV-Ray's own
// seconds are fewer than its process's.
#include <gtest/gtest.h>

#include "exporter/temporary_folder.h"
#include "tests/catalogue_scene.h"
#include "verifier/studies/trade.h"

namespace threefold {
namespace {

TEST(TradeOfRenderers, EachMeetsTheToleranceOnASceneOfItsOwn) {
    const TemporaryFolder folder;
    TradeRequest request;
    request.scene = catalogue_scene(
        "hollow", {{"image.width_px", "20"}, {"image.height_px", "20"}, {"orb.wall_mm", "11"}, {"glass.index", "1.4"}});
    request.witnesses = find_witnesses(witness_names());
    for (const Witness &w : request.witnesses)
        if (!w.present()) GTEST_SKIP() << w.title << " is not installed";
    request.tolerances = {5e-2};
    request.runs = 2;
    request.quick = true;
    request.folder = folder.path();
    const TradeResult result = study_trade(request);
    ASSERT_EQ(result.choices.size(), 3u);
    for (const TradeChoice &c : result.choices) {
        EXPECT_TRUE(c.met) << c.witness << ": " << c.note;
        EXPECT_LE(c.measured.root(), 5e-2) << c.witness;
    }
    for (const TradeRow &row : result.rows) {
        if (row.witness == "tracer") continue;
        EXPECT_GE(row.cost.own_cpu_s, 0) << row.setting;
        EXPECT_LT(row.cost.own_cpu_s, row.cost.process_cpu_s) << row.witness << " " << row.setting;
        EXPECT_GT(row.cost.memory_mb, 1);
    }
}

} // namespace
} // namespace threefold
