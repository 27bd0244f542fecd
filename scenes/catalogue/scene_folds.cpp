// SPDX-License-Identifier: MIT
// A hollow orb before a robe with five folds that run out to the upper right (figures 5 and 6 of the study). Four lie
// in planes that hold the eye and the orb's centre; the leftmost passes the centre by `folds.miss_mm`.
// On the robe, angles go from image right towards up; all folds are wedges, so that both edges of an aimed one are
// aimed.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "scenes/catalogue/catalogue.h"
#include "scenes/catalogue/common.h"
#include "scenes/catalogue/textures.h"

namespace threefold {

namespace {

constexpr double bright = 0.6, dark = 0.05; ///< radiance of the flat robe and of its folds
constexpr double behind_share = 1e-3;       ///< of the robe's half width: the bright sheet stands behind the folds
constexpr double from_share = 0.05, to_share = 0.95; ///< of the robe's half width: where a fold begins and ends
constexpr int folds = 5;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// A fold's middle line on the robe: it starts at `apex`, (0, 0) is the point behind the orb's centre at no shift.
struct FoldLine {
    Vec2 apex_mm, along;
};

/// From left to right as seen in the picture, the one that misses first.
std::array<FoldLine, folds> fold_lines(const Parameters &p) {
    std::array<FoldLine, folds> lines;
    for (int k = 0; k < folds; ++k) {
        const double angle = radians(p.number("folds.azimuth_deg") + (2.5 - k) * p.number("folds.step_deg"));
        lines[static_cast<std::size_t>(k)] = {Vec2(0), Vec2(std::cos(angle), std::sin(angle))};
    }
    const Vec2 along = lines[0].along;
    lines[0].apex_mm = p.number("folds.miss_mm") * Vec2(-along.y, along.x);
    return lines;
}

Specs robe_parameters() {
    Specs specs = card_parameters();
    std::erase_if(specs, [](const ParameterSpec &s) { return s.name == "card.surface"; });
    for (ParameterSpec &s : specs)
        if (s.name == "card.half_width_mm") s.text = s.published = 150;
    specs.push_back(
        number_parameter("robe.shift_mm", "robe moved sideways, to the right of the picture", 0, -1e9, 1e9));
    ParameterSpec surface{"robe.surface", "flat: dark wedges on a bright sheet, for measuring; cloth: soft blue folds"};
    surface.choices = {"flat", "cloth"};
    specs.push_back(surface);
    return specs;
}

Specs fold_parameters() {
    return {
        number_parameter("folds.azimuth_deg",
                         "direction of the middle of the four aimed folds, from image right towards up", 46, -360, 360),
        number_parameter("folds.step_deg", "angle from one fold to the next", 11, 0.01, 60),
        number_parameter("folds.width_deg", "opening angle of each fold", 4.5, 0.001, 30),
        number_parameter("folds.miss_mm",
                         "by which the leftmost fold's line passes the point behind the orb's centre, on the robe", 10,
                         -1e9, 1e9),
    };
}

Specs criterion_parameters() {
    return {number_parameter("criterion.acuity_arcmin", "the least angle at the eye that is noticed", 1, 1e-6, 1e4),
            number_parameter("criterion.circle_share",
                             "a fold's break is read on this circle, in shares of the orb's radius, or at 0.97 of the "
                             "hollow's radius where that is less",
                             0.95, 0.05, 0.995)};
}

Quad sheet(const Parameters &p, double behind_mm, Surface surface) {
    const double half = p.number("card.half_width_mm");
    return {{p.number("robe.shift_mm"), 0, -p.number("card.distance_mm") - behind_mm},
            {half, 0, 0},
            {0, half, 0},
            std::move(surface)};
}

Mesh wedges(const Parameters &p) {
    Mesh mesh;
    mesh.surface = Emissive{Rgb(dark)};
    const double half = p.number("card.half_width_mm"), tangent = std::tan(radians(p.number("folds.width_deg")) / 2);
    for (const FoldLine &line : fold_lines(p)) {
        const Vec2 left(-line.along.y, line.along.x);
        const auto first = static_cast<unsigned>(mesh.vertices_mm.size());
        const auto corner = [&](double along_mm, double side) {
            const Vec2 at = line.apex_mm + along_mm * (line.along + side * tangent * left);
            mesh.vertices_mm.emplace_back(p.number("robe.shift_mm") + at.x, at.y, -p.number("card.distance_mm"));
        };
        // In this order: the claims read each fold's edges from its four corners.
        corner(from_share * half, 1);
        corner(to_share * half, 1);
        corner(from_share * half, -1);
        corner(to_share * half, -1);
        mesh.triangles.emplace_back(first, first + 2, first + 3);
        mesh.triangles.emplace_back(first, first + 3, first + 1);
    }
    return mesh;
}

/// Blue cloth: broad waves, a fine weave, and each fold as a dark valley with a lit ridge on its left.
std::shared_ptr<const Texture> cloth_texture(const Parameters &p, int side) {
    const double half = p.number("card.half_width_mm"), width = radians(p.number("folds.width_deg"));
    const std::array<FoldLine, folds> lines = fold_lines(p);
    auto texture = std::make_shared<Texture>(Texture{side, side, {}});
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const Vec2 at = Vec2(2 * (column + 0.5) / side - 1, 1 - 2 * (row + 0.5) / side) * half;
            const double x = at.x / half, y = at.y / half;
            double light = 0.62 + 0.10 * std::sin(9 * x - 5 * y + 1.5 * std::sin(4 * y + 1)) +
                           0.06 * std::sin(21 * y + 13 * x + 2 * std::sin(6 * x));
            for (const FoldLine &line : lines) {
                const Vec2 from = at - line.apex_mm, left(-line.along.y, line.along.x);
                const double along = glm::dot(from, line.along), across = glm::dot(from, left);
                if (!(along > 0)) continue;
                const double shown = smooth_step(0.15, 0.4, along / half) * (1 - smooth_step(0.8, 1.3, along / half));
                const double t = std::atan2(across, along) / width;
                light *= 1 - 0.85 * shown * std::exp(-16 * t * t * t * t);
                light += 0.30 * shown * std::exp(-8 * (t - 0.85) * (t - 0.85));
            }
            const double weave = 1 + 0.03 * std::sin(700 * x) * std::sin(700 * y);
            const Rgb colour = weave * light * (light * Rgb(0.20, 0.33, 0.60) + (1 - light) * Rgb(0.05, 0.10, 0.28));
            for (int k = 0; k < 3; ++k)
                texture->rgb.push_back(
                    static_cast<std::uint16_t>(std::lround(std::clamp(colour[k], 0.0, 1.0) * 65535)));
        }
    return texture;
}

} // namespace

SceneRecipe folds_scene() {
    return {"folds", "a hollow orb before a robe with five folds: four aimed at its centre, the leftmost not",
            join({orb_parameters(), wall_parameters(), glass_parameters(), view_parameters(), robe_parameters(),
                  fold_parameters(), criterion_parameters(), environment_parameters(0.02)}),
            [](const Parameters &p) {
                Scene scene;
                scene.objects = {{"orb", make_shell(p)}};
                if (p.word("robe.surface") == "flat") {
                    const double behind = behind_share * p.number("card.half_width_mm");
                    scene.objects.push_back({"robe", sheet(p, behind, Emissive{Rgb(bright)})});
                    scene.objects.push_back({"folds", wedges(p)});
                } else {
                    scene.objects.push_back({"robe", sheet(p, 0, Emissive{cloth_texture(p, 1024)})});
                }
                scene.environment = make_environment(p);
                scene.camera = make_camera(p);
                return scene;
            }};
}

} // namespace threefold
