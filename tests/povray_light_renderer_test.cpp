// SPDX-License-Identifier: MIT
// The real POV-Ray: textures, lit surfaces and the shadows of glass.
#include <memory>
#include <numbers>

#include "scenes/light.h"
#include "tests/povray_fixture.h"

using namespace threefold;
using namespace threefold::povray_tests;

namespace {

Rgb sample(const Texture &texture, Vec2 uv) {
    const auto texel = [&](int x, int y) {
        x = std::clamp(x, 0, texture.width - 1), y = std::clamp(y, 0, texture.height - 1);
        const auto i = static_cast<std::size_t>(3 * (y * texture.width + x));
        return Rgb(texture.rgb[i], texture.rgb[i + 1], texture.rgb[i + 2]) / 65535.0;
    };
    const Vec2 at(uv.x * texture.width - 0.5, (1 - uv.y) * texture.height - 0.5), low = glm::floor(at);
    const Vec2 f = at - low;
    const int x = static_cast<int>(low.x), y = static_cast<int>(low.y);
    return glm::mix(glm::mix(texel(x, y), texel(x + 1, y), f.x), glm::mix(texel(x, y + 1), texel(x + 1, y + 1), f.x),
                    f.y);
}

std::shared_ptr<const Texture> small_texture() {
    Texture texture{.width = 3, .height = 2, .rgb = {}};
    for (int i = 0; i < 18; ++i) texture.rgb.push_back(static_cast<std::uint16_t>((i * 7919 + 13) * 61 % 65536));
    return std::make_shared<const Texture>(texture);
}

} // namespace

TEST_F(PovRay, shows_a_texture_upright_and_bilinear_on_a_quad_and_on_a_mesh) {
    const auto texture = small_texture();
    Quad quad = card;
    quad.surface = Emissive{texture};
    const auto at = [&](double u, double v) {
        return quad.centre_mm + (2 * u - 1) * quad.half_u_mm + (2 * v - 1) * quad.half_v_mm;
    };
    const Mesh mesh{.vertices_mm = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)},
                    .triangles = {{0, 1, 2}, {0, 2, 3}},
                    .uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                    .surface = Emissive{texture}};
    for (const Shape &shape : {Shape(quad), Shape(mesh)}) {
        Scene scene = scene_of({shape}, 60, 50);
        scene.camera.horizontal_fov_deg = 17;
        const Image image = render(at_pixel_centres(scene)).front();
        double worst = 0;
        for_each_sample(scene.camera, [&](int row, int column, const Ray &ray) {
            const auto uv = uv_of_landing(ray, quad);
            worst = std::max(worst, greatest_difference(image.at(column, row), uv ? sample(*texture, *uv) : Rgb(0)));
        });
        EXPECT_LE(worst, step() + 1e-6);
    }
}

TEST_F(PovRay, shows_a_mesh_card_like_a_quad_card_and_from_behind) {
    const auto at = [&](double u, double v) {
        return card.centre_mm + (2 * u - 1) * card.half_u_mm + (2 * v - 1) * card.half_v_mm;
    };
    const Mesh mesh{.vertices_mm = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)},
                    .triangles = {{0, 1, 2}, {0, 2, 3}},
                    .uv = {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                    .surface = CoordinateCard{}};
    for (const Shape &shape : {Shape(card), Shape(mesh)}) {
        Scene scene = scene_of({shape});
        scene.camera.eye_mm = {30, 20, -1200};
        const Image image = render(at_pixel_centres(scene)).front();
        expect_card(image, scene.camera, card, {}, step() + 1e-6);
    }
}

TEST_F(PovRay, lights_a_diffuse_surface_as_lambert_says) {
    const auto texture = small_texture();
    Quad quad = card;
    quad.surface = Diffuse{texture};
    Scene scene = scene_of({quad});
    scene.lights = {{{1, -2, -3}, Rgb(2, 3, 4)}, {{0, 0, -1}, Rgb(0.5)}, {{0, 0, 1}, Rgb(100)}}; // the last from behind
    const Image image = render(at_pixel_centres(scene)).front();
    const Rgb irradiance = Rgb(2, 3, 4) * 3.0 / std::sqrt(14.0) + 0.5;
    double worst = 0;
    for_each_sample(scene.camera, [&](int row, int column, const Ray &ray) {
        const auto uv = uv_of_landing(ray, quad);
        const Rgb expected = uv ? sample(*texture, *uv) * irradiance / std::numbers::pi : Rgb(0);
        worst = std::max(worst, greatest_difference(image.at(column, row), expected));
    });
    EXPECT_LE(worst, step() + 2e-6);
}

TEST_F(PovRay, casts_the_shadow_that_the_rule_says_and_never_shows_its_proxy) {
    Quad quad = card;
    quad.surface = Diffuse{Rgb(1)};
    using Rule = GlassShadow::Rule;
    for (const auto &[rule, transmittance, expected] :
         {std::tuple{Rule::none, 0.3, 1.0}, std::tuple{Rule::opaque, 0.3, 0.0}, std::tuple{Rule::constant, 0.3, 0.3}}) {
        // The light comes at a slant: the shadow lies beside the orb. Behind it, the wall is seen through coated glass.
        Scene scene = scene_of({GlassShell{.glass = {.coating = Coating::antireflective}}, quad}, 64, 32);
        scene.camera.horizontal_fov_deg = 20;
        scene.lights = {{{1, 0, -1}, Rgb(std::numbers::pi * std::numbers::sqrt2)}};
        scene.glass_shadow = {rule, transmittance};
        const Image image = render(at_pixel_centres(scene)).front();
        double worst = 0;
        int in_shadow = 0, through_glass = 0;
        for_each_sample(scene.camera, [&](int row, int column, const Ray &straight) {
            const Ray ray = through(straight, {{68, 1.51714, 1}, {66.64, 1, 1.51714}}).ray;
            const auto uv = uv_of_landing(ray, quad);
            if (!uv) {
                EXPECT_EQ(image.at(column, row), Rgb(0));
                return;
            }
            const Vec3 at(300 * (uv->x - 0.5), 300 * (uv->y - 0.5), -200);
            const double b = glm::length(glm::cross(at, glm::normalize(Vec3(-1, 0, 1))));
            if (std::abs(b - 68) < 1e-3) return;
            (b < 68 ? in_shadow : through_glass) += b < 68 || impact_mm(straight) < 68 ? 1 : 0;
            worst = std::max(worst, std::abs(image.at(column, row).r - (b < 68 ? expected : 1)));
        });
        EXPECT_GT(in_shadow, 50);
        EXPECT_GT(through_glass, 50);
        EXPECT_LE(worst, step() + 2e-6);
    }
}

TEST_F(PovRay, casts_the_shadow_of_a_dome_as_of_other_lights) {
    Quad quad = card;
    quad.surface = Diffuse{Rgb(1)};
    Scene scene = scene_of({GlassBall{.glass = {.coating = Coating::antireflective}}, quad}, 32, 16);
    scene.camera.horizontal_fov_deg = 20;
    scene.environment = Environment{Rgb(0.5), 24};
    scene.glass_shadow = {GlassShadow::Rule::opaque, 1};
    const Image image = render(at_pixel_centres(scene)).front();
    double worst = 0;
    int in_shadow = 0;
    for_each_sample(scene.camera, [&](int row, int column, const Ray &straight) {
        const auto uv = uv_of_landing(straight, quad);
        if (!uv || impact_mm(straight) < 69) return;
        const Vec3 at(300 * (uv->x - 0.5), 300 * (uv->y - 0.5), -200);
        double expected = 0, nearest_edge = 1e9;
        bool shadowed = false;
        for (const Directional &light : dome(*scene.environment)) {
            const Vec3 travel = glm::normalize(light.travel);
            if (travel.z >= 0) continue; // from behind the card
            const double b = glm::length(glm::cross(at, travel));
            nearest_edge = std::min(nearest_edge, std::abs(b - 68));
            if (b < 68 && glm::dot(at, travel) > 0)
                shadowed = true;
            else
                expected += light.irradiance.r * -travel.z / std::numbers::pi;
        }
        if (nearest_edge < 1e-3) return;
        in_shadow += shadowed;
        worst = std::max(worst, std::abs(image.at(column, row).r - expected));
    });
    EXPECT_GT(in_shadow, 50);
    EXPECT_LE(worst, 2 * step() + 4e-6);
}
