// SPDX-License-Identifier: MIT
// The painting's three white specks as reflections: a small bright square in the mirror direction of each of the
// study's three points on the front of the orb, for the eye of this scene. The points are those of its scene files,
// turned into our frame; they are directions here, so that they lie on an orb of any radius.
#include "scenes/catalogue/white_spots.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scenes/catalogue/catalogue.h"
#include "scenes/catalogue/common.h"

namespace threefold {

namespace {

/// (x, y, z) of the study, in centimetres, is 10 (-z, y, x) here.
constexpr double spots_cm[spot_count][3] = {
    {5.8765, 1.0341, 3.2574}, {6.6934, 0.8285, 0.8515}, {6.4676, -2.0442, 0.4523}};

Specs source_parameters() {
    ParameterSpec which{"source.which", "all three sources, or the one for spot 1, 2 or 3 alone"};
    which.choices = {"all", "1", "2", "3"};
    return {which,
            number_parameter("source.distance_mm", "spot on the orb to its source", 3000, 1e-9, 1e9),
            number_parameter("source.half_width_mm", "half the side of a square source", 30, 1e-9, 1e9),
            number_parameter("source.radiance", "radiance of a source", 1, 0, 1e6),
            number_parameter("source.offset_deg", "source turned out of its mirror direction, away from the eye", 0,
                             -80, 80),
            number_parameter("criterion.spot_mm",
                             "a highlight so far from the painted spot has left it: a claim's threshold", 1, 0, 1e9)};
}

} // namespace

Vec3 white_spot(const Parameters &p, int spot) {
    const auto &cm = spots_cm[spot];
    return p.number("orb.radius_mm") * glm::normalize(Vec3(-cm[2], cm[1], cm[0]));
}

Vec3 white_spot_source(const Parameters &p, int spot) {
    const Vec3 at = white_spot(p, spot), normal = glm::normalize(at);
    const Vec3 to_eye = glm::normalize(Vec3(0, 0, p.number("eye.distance_mm")) - at);
    const Vec3 mirrored = 2 * glm::dot(to_eye, normal) * normal - to_eye;
    // In the plane of incidence, away from the eye's side.
    const Vec3 aside = glm::normalize(mirrored - glm::dot(mirrored, to_eye) * to_eye);
    const double angle = std::acos(std::clamp(glm::dot(mirrored, to_eye), -1.0, 1.0)) +
                         p.number("source.offset_deg") * std::numbers::pi / 180;
    return at + p.number("source.distance_mm") * (std::cos(angle) * to_eye + std::sin(angle) * aside);
}

SceneRecipe white_spots_scene() {
    return {"white-spots", "a hollow orb with a small bright source in the mirror direction of each painted speck",
            join({orb_parameters(), wall_parameters(), glass_parameters(), view_parameters(), source_parameters(),
                  environment_parameters(0.02)}),
            [](const Parameters &p) {
                Scene scene;
                scene.objects = {{"orb", make_shell(p)}};
                const std::string &which = p.word("source.which");
                const double half = p.number("source.half_width_mm");
                for (int spot = 0; spot < spot_count; ++spot) {
                    if (which != "all" && which != std::to_string(spot + 1)) continue;
                    const Vec3 source = white_spot_source(p, spot);
                    const Vec3 facing = glm::normalize(white_spot(p, spot) - source);
                    const Vec3 u =
                        glm::normalize(glm::cross(std::abs(facing.y) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0), facing));
                    scene.objects.push_back(
                        {fmt::format("source {}", spot + 1), Quad{source, half * u, half * glm::cross(facing, u),
                                                                  Emissive{Rgb(p.number("source.radiance"))}}});
                }
                scene.environment = make_environment(p);
                scene.camera = make_camera(p);
                return scene;
            }};
}

} // namespace threefold
