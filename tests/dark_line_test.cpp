// SPDX-License-Identifier: MIT
// The centre of a dark line, on pictures that the test drew, and how lines jump at an orb's boundary by the closed
// form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <glm/geometric.hpp>

#include "scenes/catalogue/catalogue.h"
#include "verifier/claims/line_crossing.h"
#include "verifier/measure/dark_line.h"

namespace threefold {
namespace {

double soft(double distance, double half_width) {
    const double share = std::abs(distance) / (2 * half_width);
    return share < 1 ? std::pow(std::cos(share * std::numbers::pi / 2), 2) : 0;
}

/// A soft line through the picture, `offset_px` from its middle, along a direction; one sample a pixel.
Image line_picture(const Camera &camera, double angle, double offset_px, double half_width_px) {
    Image image(camera.image_width_px(), camera.image_height_px(), Rgb(1));
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const Vec2 p = pixel_sample(camera, column, row) - Vec2(camera.width_px, camera.height_px) / 2.0;
            const double across = -std::sin(angle) * p.x - std::cos(angle) * p.y; // image y points down
            image.at(column, row).g = 1 - soft(across - offset_px, half_width_px);
        }
    return image;
}

Camera view(Vec2 film_offset_px) {
    Camera camera;
    camera.projection = Projection::orthographic;
    camera.orthographic_width_mm = 64; // a pixel is a millimetre
    camera.width_px = camera.height_px = 64;
    camera.film_offset_px = film_offset_px;
    return camera;
}

TEST(DarkLine, IsReadToAThousandthOfAPixelOnACircleWhereverPixelsAreSampled) {
    double worst = 0;
    for (const double angle : {0.0, 0.4, std::numbers::pi / 4})
        for (const double offset : {0.0, 3.3, -7.77})
            for (const Vec2 film : {Vec2(0), Vec2(0.25, -0.4)}) {
                const Camera camera = view(film);
                const Image image = line_picture(camera, angle, offset, 4);
                const PlaneScale scale{{0, 0, -100}, {-std::sin(angle), std::cos(angle), 0}, {0, 0, 1}};
                const auto path = circle_path(camera, Vec3(0), 24, scale, angle - 1.5, angle + 1.5);
                const auto centre = dark_centre(image, camera, path, 1);
                ASSERT_TRUE(centre);
                worst = std::max(worst, std::abs(centre->place - offset));
                EXPECT_FALSE(dark_centre(image, camera, path, 0)) << "no line in this channel";
            }
    EXPECT_LT(worst, 1e-3);
}

TEST(DarkLine, IsReadOnAnyScanLine) {
    const Camera camera = view({0.1, 0.2});
    const Image image = line_picture(camera, std::numbers::pi / 4, 2, 4);
    std::vector<PathPoint> row;
    for (double x = 4; x < 60; x += 0.1) row.push_back({{x, 30}, x});
    const auto centre = dark_centre(image, camera, row, 1);
    ASSERT_TRUE(centre);
    // Across = -(x - 32) / sqrt 2 - (30 - 32) / sqrt 2 = 2.
    EXPECT_NEAR(centre->place, 34 - 2 * std::sqrt(2.0), 1e-3);
    EXPECT_NEAR(centre->image_px.x, centre->place, 1e-9);
    EXPECT_NEAR(centre->image_px.y, 30, 1e-9);
}

TEST(DarkLine, HasNoCentreWhereItLeavesThePath) {
    const Camera camera = view({0, 0});
    const Image image = line_picture(camera, 0, 0, 4);
    std::vector<PathPoint> column;
    for (double y = 32; y < 60; y += 0.1) column.push_back({{32, y}, y});
    EXPECT_FALSE(dark_centre(image, camera, column, 1));
    EXPECT_FALSE(dark_centre(image, camera, {}, 1));
}

TEST(ImagePosition, IsTheInverseOfTheCamerasRay) {
    Camera camera;
    camera.eye_mm = {10, -20, 900};
    camera.target_mm = {3, 4, 5};
    camera.crop = Crop{40, 60, 100, 90};
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        camera.projection = projection;
        const Vec2 at(17.25, 71.5);
        EXPECT_LT(glm::length(image_position(camera, camera_ray(camera, at)) - at), 1e-9);
    }
}

TEST(RayPast, HasTheImpactParameterOnTheSideAskedFor) {
    Camera camera;
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        camera.projection = projection;
        for (const double azimuth : {0.0, 0.7, 2.0}) {
            const Vec3 centre(5, -3, 2);
            const Ray ray = *ray_past(camera, centre, 40, azimuth);
            EXPECT_NEAR(impact_parameter(ray, centre), 40, 1e-9);
            const Vec2 side = image_position(camera, ray) - image_position(camera, *ray_past(camera, centre, 0, 0));
            EXPECT_NEAR(std::atan2(-side.y, side.x), azimuth, 1e-4);
        }
    }
    EXPECT_FALSE(ray_past(Camera{}, Vec3(0), 901, 0));
}

// The numbers of the next two tests come from the textbook's sums of inverse sines, worked out apart from this code.

LinesView published_view(const optics::Orb<double> &orb) {
    const double half = std::sqrt(0.5);
    LinesView view;
    view.orb = {Vec3(0), orb, {}};
    view.scale = {{0, 0, -150}, {-half, half, 0}, {0, 0, 1}};
    view.along = {half, half, 0};
    view.circles = {0.9 * view.orb.clear_radius_mm(), 1.05 * orb.outer_mm, std::numbers::pi / 4};
    return view;
}

TEST(LineCrossing, JumpsAsTheClosedFormSaysBesideTheAxisAndNotAtAllOnIt) {
    Camera camera; // eye at 900 mm
    const double apart = 20 * std::sqrt(0.5);
    const LinesView hollow = published_view(optics::shell(67.98, 2.98, 1.6)),
                    solid = published_view(optics::solid_ball(67.98, 1.6));
    EXPECT_NEAR(predicted_jump(hollow, camera, {apart, 1, {}}), -2.838772033, 1e-6);
    EXPECT_NEAR(predicted_jump(hollow, camera, {-apart, 1, {}}), 2.838772033, 1e-6);
    EXPECT_NEAR(predicted_jump(solid, camera, {apart, 1, {}}), -23.115598274, 1e-6);
    for (const LinesView &view : {hollow, solid}) EXPECT_NEAR(predicted_jump(view, camera, {0, 1, {}}), 0, 1e-9);
}

TEST(LineCrossing, OfTheMiddleLineIsUnbrokenAtAnyWallAndIndex) {
    Camera camera;
    for (const double index : {1.05, 1.33, 1.6, 1.9})
        for (const double wall : {0.01, 1.3, 20.0}) {
            EXPECT_NEAR(predicted_jump(published_view(optics::shell(68.0, wall, index)), camera, {0, 1, {}}), 0, 1e-9);
            EXPECT_NEAR(predicted_jump(published_view(optics::solid_ball(68.0, index)), camera, {0, 1, {}}), 0, 1e-9);
        }
}

TEST(LineCrossing, OfALineBentOutsideIsBroken) {
    Camera camera;
    camera.projection = Projection::orthographic;
    LinesView view = published_view(optics::shell(67.98, 2.98, 1.6));
    view.circles.inside_mm = 0.95 * view.orb.clear_radius_mm();
    EXPECT_NEAR(predicted_jump(view, camera, {0, 1e-3, 80}), -5.016710073, 1e-4) << "a thin line";
    EXPECT_NEAR(predicted_jump(view, camera, {0, 1, 1000}), 0, 1e-9) << "bent too far away to be seen";
}

TEST(ThreeLinesScene, HasThePublishedGeometryInOurFrame) {
    const SceneRecipe recipe = three_lines_solid_scene();
    const Scene scene = recipe.make(Parameters(recipe.parameters, Preset::published));
    EXPECT_EQ(scene.camera.width_px, 512);
    EXPECT_EQ(scene.camera.height_px, 512);
    EXPECT_EQ(scene.camera.horizontal_fov_deg, 10);
    EXPECT_EQ(scene.camera.eye_mm, Vec3(0, 0, 900));
    const auto find = [&](std::string_view name) -> const Shape & {
        for (const Object &o : scene.objects)
            if (o.name == name) return o.shape;
        throw std::runtime_error("not there");
    };
    const auto &ball = std::get<GlassBall>(find("orb"));
    EXPECT_EQ(ball.radius_mm, 67.98);
    EXPECT_EQ(ball.glass.index, 1.6);
    const auto &upper = std::get<Quad>(find("upper line"));
    EXPECT_EQ(upper.centre_mm, Vec3(0, 20, -150));
    EXPECT_NEAR(glm::length(upper.half_u_mm), 300, 1e-12);
    EXPECT_NEAR(glm::length(upper.half_v_mm), 1, 1e-12);
    EXPECT_NEAR(upper.half_u_mm.x, upper.half_u_mm.y, 1e-12) << "from lower left to upper right";
    const auto &grid = std::get<Mesh>(find("grid of the card"));
    EXPECT_EQ(grid.triangles.size(), 2u * 2 * 21);
    EXPECT_NEAR(grid.vertices_mm[8].x, -90.2, 1e-12) << "2 % of a cell before the first inner border";
    EXPECT_NEAR(grid.vertices_mm[8].z, -151, 0);
}

} // namespace
} // namespace threefold
