// SPDX-License-Identifier: MIT
// What the tracer cannot meet rightly it refuses, and what should not matter to it does not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/error.h"
#include "scenes/validate.h"
#include "verifier/tracer/tracer.h"

namespace threefold {
namespace {

using testing::HasSubstr;

/// An orb before a card, and a triangle that shines beside both.
Scene scene_with_triangle(Vec3 corner) {
    Scene s;
    Mesh mesh;
    mesh.vertices_mm = {corner, corner + Vec3(40, 0, 0), corner + Vec3(0, 40, 3)};
    mesh.triangles = {{0, 1, 2}};
    mesh.surface = Emissive{Rgb(0.7)};
    s.objects = {{"orb", GlassShell{{0, 0, 0}, 68, 1.36, {}}},
                 {"card", Quad{{0, 0, -250}, {200, 0, 0}, {0, 200, 0}, CoordinateCard{}}},
                 {"triangle", mesh}};
    s.environment = Environment{Rgb(0.1)};
    s.camera.eye_mm = {0, 0, 900};
    s.camera.horizontal_fov_deg = 16;
    s.camera.width_px = s.camera.height_px = 32;
    return s;
}

Image traced(const Scene &scene) {
    validate(scene);
    RenderJob job;
    job.scene = scene;
    job.sampling = Sampling::pixel_centres;
    job.threads = 1;
    return trace(job).images.front();
}

std::string refusal(const Scene &scene) {
    try {
        traced(scene);
    } catch (const Error &error) {
        return error.what();
    }
    return "";
}

TEST(TracerLimits, HowFarAwayTheCamerasTargetLiesDoesNotMatter) {
    Scene scene = scene_with_triangle({60, 20, 80});
    const Image near = traced(scene);
    scene.camera.target_mm = {0, 0, -1e9};
    const Image far = traced(scene);
    for (std::size_t i = 0; i < near.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(near.pixels[i][c], far.pixels[i][c], 1e-9) << i;
}

TEST(TracerLimits, AMeshInsideAnOrbIsRefused) {
    EXPECT_THAT(refusal(scene_with_triangle({-10, -10, 0})), HasSubstr("the mesh triangle reaches into the glass orb"));
    EXPECT_THAT(refusal(scene_with_triangle({-100, -20, 0})), HasSubstr("reaches into")) << "no corner lies inside";
    EXPECT_EQ(refusal(scene_with_triangle({60, 20, 80})), "");
}

TEST(TracerLimits, AnEyeSoFarFromAMeshThatItsPlaceIsLostIsRefused) {
    Scene scene = scene_with_triangle({60, 20, 80});
    scene.camera.eye_mm = {0, 0, 9e8};
    scene.camera.horizontal_fov_deg = 1.6e-5;
    EXPECT_THAT(refusal(scene), HasSubstr("of a pixel"));
    scene.objects.pop_back();
    EXPECT_EQ(refusal(scene), "") << "rectangles are met in double precision";
}

TEST(TracerLimits, AnOrthographicFilmThatCutsAnOrbIsRefused) {
    Scene scene = scene_with_triangle({60, 20, 80});
    scene.camera.projection = Projection::orthographic;
    scene.camera.orthographic_width_mm = 200;
    EXPECT_EQ(refusal(scene), "");
    scene.camera.eye_mm = {90, 0, 0}; // itself outside
    scene.camera.target_mm = {90, 0, -10};
    EXPECT_THAT(refusal(scene), HasSubstr("film cuts the glass orb"));
    scene.camera.crop = Crop{30, 0, 2, 2}; // a corner that stays outside
    EXPECT_EQ(refusal(scene), "");
}

} // namespace
} // namespace threefold
