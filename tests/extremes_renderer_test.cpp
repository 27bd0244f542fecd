// SPDX-License-Identifier: MIT
// The extremes study with the real POV-Ray and Blender, at the limits that their adapters draw.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/temporary_folder.h"
#include "verifier/studies/extremes.h"

namespace threefold {
namespace {

TEST(ExtremesRenderer, NothingThatIsExportedIsWrongAndAWallOfAMicrometreIsRight) {
    const tests::TemporaryFolder folder;
    ExtremesRequest request;
    request.witnesses = find_witnesses({"povray", "cycles"});
    std::erase_if(request.witnesses, [](const Witness &w) { return !w.present(); });
    if (request.witnesses.empty()) GTEST_SKIP() << "neither POV-Ray nor Blender is installed";
    request.sweeps = {"wall", "eye-near", "grazing-solid", "reflections-solid"};
    request.quick = true;
    request.folder = folder.path();
    const ExtremesResult result = study_extremes(request);
    for (const std::string &fault : result.faults()) ADD_FAILURE() << fault;
    int right = 0, micrometre = 0;
    for (const ExtremeSweepResult &sweep : result.sweeps)
        for (const ExtremeRow &row : sweep.rows)
            for (const ExtremeFinding &f : row.findings) {
                right += f.standing == Standing::right;
                if (row.label == "1 µm") {
                    EXPECT_EQ(f.standing, Standing::right) << f.worst << ", stated " << f.bound;
                    ++micrometre;
                }
            }
    EXPECT_EQ(micrometre, static_cast<int>(request.witnesses.size()));
    EXPECT_GE(right, 4 * static_cast<int>(request.witnesses.size()));
}

} // namespace
} // namespace threefold
