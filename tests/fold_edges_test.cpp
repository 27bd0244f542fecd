// SPDX-License-Identifier: MIT
// Where an edge crosses a path, on pictures that the test drew itself.
#include <gtest/gtest.h>

#include <cmath>

#include "verifier/measure/fold_edges.h"

namespace threefold {
namespace {

/// Dark where `inside` says so, bright elsewhere; each pixel is a mean over 16 x 16 points of it.
template <class Inside>
Image drawn(int width, int height, double bright, double dark, Inside inside) {
    constexpr int fine = 16;
    Image image(width, height);
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            int count = 0;
            for (int y = 0; y < fine; ++y)
                for (int x = 0; x < fine; ++x)
                    count += inside(Vec2(column + (x + 0.5) / fine, row + (y + 0.5) / fine)) ? 1 : 0;
            image.at(column, row) = Rgb(bright + (dark - bright) * count / (fine * fine));
        }
    return image;
}

TEST(ImagePosition, IsTheInverseOfTheCamerasRays) {
    Camera camera;
    camera.width_px = 640;
    camera.height_px = 480;
    camera.crop = Crop{100, 50, 64, 32};
    camera.film_offset_px = {0.25, -0.125};
    for (const auto &[column, row] : {std::pair(0, 0), std::pair(63, 31), std::pair(20, 7)}) {
        const Ray ray = camera_ray(camera, pixel_sample(camera, column, row));
        const Vec2 at = image_position(camera, ray.origin_mm + 1234.5 * ray.direction);
        EXPECT_NEAR(at.x, column + 0.5, 1e-9);
        EXPECT_NEAR(at.y, row + 0.5, 1e-9);
    }
    EXPECT_TRUE(std::isnan(image_position(camera, camera.eye_mm + Vec3(0, 0, 1)).x)) << "behind the camera";
}

TEST(ImagePosition, HoldsForAParallelViewToo) {
    Camera camera;
    camera.projection = Projection::orthographic;
    const Ray ray = camera_ray(camera, pixel_sample(camera, 12, 200));
    const Vec2 at = image_position(camera, ray.origin_mm + 900.0 * ray.direction);
    EXPECT_NEAR(at.x, 12.5, 1e-9);
    EXPECT_NEAR(at.y, 200.5, 1e-9);
}

TEST(RadianceAt, IsBilinearBetweenPixelCentresAndNothingOutside) {
    Image image(2, 2);
    image.at(0, 0) = Rgb(1);
    image.at(1, 0) = Rgb(3);
    image.at(0, 1) = Rgb(5);
    image.at(1, 1) = Rgb(7);
    EXPECT_DOUBLE_EQ(radiance_at(image, {0.5, 0.5}), 1);
    EXPECT_DOUBLE_EQ(radiance_at(image, {1.5, 1.5}), 7);
    EXPECT_DOUBLE_EQ(radiance_at(image, {1, 1}), 4);
    EXPECT_TRUE(std::isnan(radiance_at(image, {0.4, 1})));
    EXPECT_TRUE(std::isnan(radiance_at(image, {1, 1.6})));
}

TEST(EdgeAlong, FindsASlantedEdgeToAHundredthOfAPixel) {
    for (const double slope : {0.0, 0.137, -0.481, 1.618}) {
        const Image image = drawn(40, 40, 0.6, 0.05, [&](Vec2 p) { return p.x < 20.25 + slope * (p.y - 20); });
        double mean = 0;
        for (int k = 0; k < 11; ++k) {
            const double y = 17.0 + 0.6 * k;
            const double found = edge_along(
                image, [&](double x) { return Vec2(x, y); }, 8, 32, 0.05, 0.6, 400);
            EXPECT_NEAR(found, 20.25 + slope * (y - 20), 0.05) << slope;
            mean += (found - (20.25 + slope * (y - 20))) / 11;
        }
        EXPECT_NEAR(mean, 0, 0.01) << slope;
    }
}

TEST(EdgeAlong, FollowsACircle) {
    const double edge_rad = 0.6;
    const Image image =
        drawn(80, 80, 0.6, 0.05, [&](Vec2 p) { return std::atan2(80 - p.y, p.x) < edge_rad; }); // centre below left
    double mean = 0;
    for (int k = 0; k < 8; ++k) {
        const double radius = 55 + k;
        mean += edge_along(
                    image, [&](double angle) { return Vec2(radius * std::cos(angle), 80 - radius * std::sin(angle)); },
                    0.5, 0.7, 0.05, 0.6, 200) /
                8;
    }
    EXPECT_NEAR(mean, edge_rad, 2e-4);
}

TEST(EdgeAlong, SaysNothingWhereThePathLeavesThePicture) {
    const Image image(8, 8, Rgb(1));
    EXPECT_TRUE(std::isnan(edge_along(
        image, [](double x) { return Vec2(x, 4); }, 4, 12, 1, 0, 50)));
}

TEST(JumpFromLine, IsTheMeanDistanceFromTheContinuation) {
    const std::vector<AlongAcross> outside{{100, 5}, {110, 6}, {120, 7}};
    EXPECT_NEAR(jump_from_line(outside, {{90, 4}, {80, 3}}), 0, 1e-12);
    EXPECT_NEAR(jump_from_line(outside, {{90, 6}, {80, 3}}), 1, 1e-12);
    EXPECT_TRUE(std::isnan(jump_from_line({{100, 5}}, {{90, 4}})));
    EXPECT_TRUE(std::isnan(jump_from_line(outside, {})));
}

} // namespace
} // namespace threefold
