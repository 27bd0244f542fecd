// SPDX-License-Identifier: MIT
// The soft edge of a shadow, on profiles whose moments are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verifier/measure/penumbra.h"

namespace threefold {
namespace {

/// A ramp from `dark` to `light` between two heights in rows, the mean over each row.
std::vector<double> ramp(int rows, double from, double to, double dark, double light) {
    const auto integral = [&](double y) { // of the ramp's share, from 0
        const double t = std::clamp(y, from, to) - from;
        return t * t / (2 * (to - from)) + std::max(0.0, y - to);
    };
    std::vector<double> profile;
    for (int k = 0; k < rows; ++k) profile.push_back(dark + (light - dark) * (integral(k + 1) - integral(k)));
    return profile;
}

TEST(Penumbra, OfAnEvenRampIsItsWidth) {
    const Penumbra p = measure_penumbra(ramp(96, 20.3, 70.9, 0.2, 3.1));
    EXPECT_NEAR(p.dark, 0.2, 1e-12);
    EXPECT_NEAR(p.light, 3.1, 1e-12);
    EXPECT_NEAR(p.middle_row, (20.3 + 70.9) / 2, 1e-9);
    EXPECT_NEAR(p.width_rows, 70.9 - 20.3, 0.02); // a row's own mean blurs by a row
}

TEST(Penumbra, OfTwoStepsIsThreeTimesTheRootOfTheirDistanceAsARamp) {
    std::vector<double> two(100, 1.0);
    std::fill_n(two.begin(), 70, 0.5);
    std::fill_n(two.begin(), 40, 0.0);
    const Penumbra p = measure_penumbra(two);
    EXPECT_NEAR(p.middle_row, 55, 1e-9);
    EXPECT_NEAR(p.width_rows, std::sqrt(12.0) * 15, 1e-9);
}

TEST(Penumbra, IsUnknownWithoutContrastOrRows) {
    EXPECT_TRUE(std::isnan(measure_penumbra(std::vector<double>(64, 1.0)).width_rows));
    EXPECT_TRUE(std::isnan(measure_penumbra(std::vector<double>(8, 1.0)).width_rows));
}

} // namespace
} // namespace threefold
