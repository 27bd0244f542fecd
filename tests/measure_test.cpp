// SPDX-License-Identifier: MIT
// Pixels to physical quantities, on pictures whose truth is known because the test drew them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "verifier/measure/edges.h"
#include "verifier/measure/optical_map.h"
#include "verifier/measure/radiance.h"

namespace threefold {
namespace {

const Quad card{{10, 20, -250}, {300, 0, 0}, {0, 200, 0}, CoordinateCard{}};

TEST(OpticalMap, ARatioSaysWhereOnTheCardWhateverWasLost) {
    for (const double kept : {1.0, 0.627, 0.01}) {
        const auto p = landing_point(card, Rgb(0.25, 0.75, 1) * kept);
        ASSERT_TRUE(p);
        EXPECT_NEAR(p->x, 10 - 150, 1e-12);
        EXPECT_NEAR(p->y, 20 + 100, 1e-12);
        EXPECT_EQ(p->z, -250);
    }
    EXPECT_FALSE(landing_point(card, Rgb(0)));
}

TEST(OpticalMap, PointsAndCoordinatesAreInverse) {
    const Vec2 uv(0.1, 0.9);
    const Vec2 back = coordinates_on(card, point_on(card, uv));
    EXPECT_NEAR(back.x, uv.x, 1e-15);
    EXPECT_NEAR(back.y, uv.y, 1e-15);
}

TEST(CentralSlope, IsFoundUnderAberration) {
    std::vector<LandingPair> pairs;
    for (double x = 1; x < 20; ++x) pairs.push_back({x, -0.96 * x - 1e-3 * x * x * x + 2e-7 * std::pow(x, 5)});
    EXPECT_NEAR(central_slope(pairs), -0.96, 1e-9);
    EXPECT_TRUE(std::isnan(central_slope({{1, 1}})));
}

TEST(Quantile, IsByRank) {
    EXPECT_EQ(quantile({5, 1, 4, 2, 3}, 0.5), 3);
    EXPECT_EQ(quantile({5, 1, 4, 2, 3}, 1), 5);
    EXPECT_EQ(quantile({5, 1, 4, 2, 3}, 0), 1);
    EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(RingMeans, LeaveOutPixelsWithoutARingAndRingsWithoutAPixel) {
    Image image(2, 2, Rgb(1));
    image.at(1, 1) = Rgb(4);
    const auto means = ring_means(image, 3, [](int column, int row) {
        return column == 0 && row == 0 ? -1 : column + row > 1 ? 2 : 0;
    });
    EXPECT_EQ(means[0], 1);
    EXPECT_TRUE(std::isnan(means[1]));
    EXPECT_EQ(means[2], 4);
}

TEST(TileMeans, PutWhatIsLeftOverIntoTheLastTile) {
    Image image(5, 4, Rgb(0));
    image.at(4, 3) = Rgb(12);
    const Image tiles = tile_means(image, 2);
    EXPECT_EQ(tiles.width, 2);
    EXPECT_EQ(tiles.height, 2);
    EXPECT_EQ(tiles.at(1, 1), Rgb(2)) << "12 over 3 x 2 pixels";
}

TEST(PlateauBorders, AreExactForAnyBlurredBorder) {
    const Plateaus plateaus{0.0625, 0.25, 1};
    for (const double left : {3.0, 3.3, 4.75})
        for (const double right : {9.0, 9.5, 10.125}) {
            Image image(16, 1);
            for (int column = 0; column < 16; ++column) {
                const auto overlap = [&](double from, double to) {
                    return std::max(0.0, std::min(column + 1.0, to) - std::max<double>(column, from));
                };
                image.at(column, 0) = Rgb(overlap(0, left) * plateaus.left + overlap(left, right) * plateaus.middle +
                                          overlap(right, 16) * plateaus.right);
            }
            const Borders b = plateau_borders(image, 0, 7, plateaus);
            EXPECT_NEAR(b.left_px, left, 1e-12);
            EXPECT_NEAR(b.right_px, right, 1e-12);
        }
}

} // namespace
} // namespace threefold
