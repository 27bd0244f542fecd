// SPDX-License-Identifier: MIT
#include "scenes/catalogue/three_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace threefold {

namespace {

/// Between the fields of the card and its grid, as a share of its half width: so little that nobody sees it, so much
/// that single precision keeps them apart.
constexpr double grid_gap_share = 1e-4;

constexpr int texels_per_half_width = 32;
constexpr int most_texels = 8192;

ParameterSpec both(std::string name, std::string description, double value, double least, double greatest) {
    ParameterSpec s{std::move(name), std::move(description)};
    s.text = s.published = value;
    s.least = least;
    s.greatest = greatest;
    return s;
}

ParameterSpec whole(ParameterSpec spec) {
    spec.whole = true;
    return spec;
}

Rgb shown(const Parameters &p, double reflectance) { return Rgb(reflectance * p.number("environment.radiance")); }

bool is_probe(const Parameters &p) { return p.word("lines.paint") == "probe"; }

double lines_depth(const Parameters &p) { return p.number("lines.ahead_mm") - p.number("card.distance_mm"); }

/// Along a line, and across it to its upper side.
struct LineFrame {
    Vec3 along, across;
};

LineFrame line_frame(const Parameters &p) {
    const double angle = p.number("lines.angle_deg") * std::numbers::pi / 180;
    return {{std::cos(angle), std::sin(angle), 0}, {-std::sin(angle), std::cos(angle), 0}};
}

/// One texel wide, `texels` high; `dark(across_mm)` for the three colours, across_mm from the middle and upwards.
template <class Dark>
std::shared_ptr<const Texture> across_texture(const Parameters &p, double half_extent_mm, int texels, Dark dark) {
    const double bright = std::min(1.0, p.number("environment.radiance"));
    auto texture = std::make_shared<Texture>(Texture{1, texels, {}});
    for (int row = 0; row < texels; ++row) {
        const Rgb d = dark(half_extent_mm * (1 - 2 * (row + 0.5) / texels));
        for (int k = 0; k < 3; ++k)
            texture->rgb.push_back(static_cast<std::uint16_t>(std::lround(65535 * bright * (1 - d[k]))));
    }
    return texture;
}

int texels_for(double half_extent_mm, double half_width_mm) {
    const double wanted = std::ceil(2 * half_extent_mm / half_width_mm * texels_per_half_width);
    return static_cast<int>(std::clamp(wanted, 2.0, static_cast<double>(most_texels)));
}

void add_card(const Parameters &p, std::vector<Object> &objects) {
    const double half = p.number("card.half_width_mm"), z = -p.number("card.distance_mm");
    Mesh grid;
    const auto add_rectangle = [&](double left, double right, double bottom, double top) {
        const auto first = static_cast<std::uint32_t>(grid.vertices_mm.size());
        for (const Vec3 &corner :
             {Vec3(left, bottom, z), Vec3(right, bottom, z), Vec3(right, top, z), Vec3(left, top, z)})
            grid.vertices_mm.push_back(corner);
        grid.triangles.push_back({first, first + 1, first + 2});
        grid.triangles.push_back({first, first + 2, first + 3});
    };
    const int cells = static_cast<int>(p.number("card.cells"));
    const double cell = 2 * half / cells, reach = p.number("card.grid_share") * cell;
    for (int k = 0; k <= cells && reach > 0; ++k) {
        const double from = std::max(-half, -half + k * cell - reach), to = std::min(half, -half + k * cell + reach);
        add_rectangle(from, to, -half, half);
        add_rectangle(-half, half, from, to);
    }
    grid.surface = Emissive{shown(p, p.number("card.grid_reflectance"))};
    objects.push_back({"card", Quad{{0, 0, z - grid_gap_share * half},
                                    {half, 0, 0},
                                    {0, half, 0},
                                    Emissive{shown(p, p.number("card.field_reflectance"))}}});
    if (!grid.triangles.empty()) objects.push_back({"grid of the card", grid});
}

Object straight_line(const Parameters &p, std::string name, double up_mm) {
    const auto [along, across] = line_frame(p);
    return {std::move(name), Quad{{0, up_mm, lines_depth(p)},
                                  p.number("lines.half_length_mm") * along,
                                  p.number("lines.half_width_mm") * across,
                                  Emissive{Rgb(0)}}};
}

/// One rectangle that holds all three: lines that lie closer than they are wide do not hide each other.
Object soft_lines(const Parameters &p) {
    const auto [along, across] = line_frame(p);
    const double half_width = p.number("lines.half_width_mm"), apart = p.number("lines.shift_mm") * across.y;
    const double half_extent = std::abs(apart) + (soft_reach + 0.5) * half_width;
    const auto paint = across_texture(p, half_extent, texels_for(half_extent, half_width), [&](double from_middle_mm) {
        return Rgb(soft_darkness(from_middle_mm - apart, half_width), soft_darkness(from_middle_mm, half_width),
                   soft_darkness(from_middle_mm + apart, half_width));
    });
    return {
        "three soft lines",
        Quad{{0, 0, lines_depth(p)}, p.number("lines.half_length_mm") * along, half_extent * across, Emissive{paint}}};
}

/// A band along points in one plane across the axis, its joints cut along their bisectors: no piece overlaps another.
/// v is 1 on the left edge (seen along the band) and 0 on the right.
Mesh ribbon(const std::vector<Vec3> &points, double half_width_mm, const Surface &surface) {
    Mesh mesh;
    mesh.surface = surface;
    const auto left_of = [](Vec3 direction) { return Vec3(-direction.y, direction.x, 0); };
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec3 before = glm::normalize(k > 0 ? points[k] - points[k - 1] : points[1] - points[0]);
        const Vec3 after =
            glm::normalize(k + 1 < points.size() ? points[k + 1] - points[k] : points[k] - points[k - 1]);
        const Vec3 mitre = glm::normalize(left_of(before) + left_of(after));
        const Vec3 side = half_width_mm / glm::dot(mitre, left_of(before)) * mitre;
        mesh.vertices_mm.insert(mesh.vertices_mm.end(), {points[k] + side, points[k] - side});
        mesh.uv.insert(mesh.uv.end(), {Vec2(0.5, 1), Vec2(0.5, 0)});
    }
    for (std::uint32_t k = 0; k + 3 < mesh.vertices_mm.size(); k += 2) {
        mesh.triangles.push_back({k, k + 1, k + 3});
        mesh.triangles.push_back({k, k + 3, k + 2});
    }
    return mesh;
}

} // namespace

double soft_darkness(double from_centre_mm, double half_width_mm) {
    const double share = std::abs(from_centre_mm) / (soft_reach * half_width_mm);
    return share < 1 ? std::pow(std::cos(share * std::numbers::pi / 2), 2) : 0;
}

Specs three_lines_orb_parameters(bool hollow) {
    Specs specs = orb_parameters();
    if (hollow) {
        ParameterSpec wall = wall_parameters().front();
        wall.published = 2.98;
        specs.push_back(wall);
    }
    for (ParameterSpec &s : specs = join({specs, glass_parameters()}))
        if (s.name == "glass.index") s.published = 1.6;
    return join({specs,
                 {both("eye.distance_mm", "eye to orb centre", 900, tiny_mm, huge_mm),
                  both("criterion.acuity_arcmin", "the least break, in minutes of arc, that counts as noticeable", 1,
                       1e-6, 1e4)},
                 environment_parameters(1)});
}

Specs three_lines_parameters(double half_length_mm) {
    Specs specs{
        both("card.distance_mm", "orb centre to card", 151, tiny_mm, huge_mm),
        both("card.half_width_mm", "half the side of the square card", 100, tiny_mm, huge_mm),
        whole(both("card.cells", "cells of the card's grid along one side", 20, 1, 1000)),
        both("card.grid_share", "reach of a grid line to either side of a cell's border, as a share of the cell", 0.02,
             0, 0.5),
        both("card.field_reflectance", "reflectance of the card's fields", 0.4, 0, 1),
        both("card.grid_reflectance", "reflectance of the card's grid lines", 0.8, 0, 1),
        both("lines.ahead_mm", "how far before the card the lines stand", 1, tiny_mm, huge_mm),
        both("lines.half_width_mm", "half the width of a line", 1, tiny_mm, huge_mm),
        both("lines.half_length_mm", "half the length of a line", half_length_mm, tiny_mm, huge_mm),
        both("lines.angle_deg", "rise of the lines to the right of the picture", 45, -89, 89),
        both("lines.shift_mm", "how much higher (lower) than the middle line the upper (lower) one stands", 20,
             -huge_mm, huge_mm),
        {"lines.paint", "black: before the card; probe: soft, each dark in one colour, before the surroundings alone"},
    };
    specs.back().choices = {"black", "probe"};
    return specs;
}

Specs three_lines_image_parameters() {
    return {whole(both("image.width_px", "width of the picture", 512, 1, 1e6)),
            whole(both("image.height_px", "height of the picture", 512, 1, 1e6))};
}

std::vector<Object> three_lines_objects(const Parameters &p) {
    std::vector<Object> objects;
    if (is_probe(p)) return {soft_lines(p)};
    add_card(p, objects);
    const double shift = p.number("lines.shift_mm");
    objects.push_back(straight_line(p, "upper line", shift));
    objects.push_back(straight_line(p, "middle line", 0));
    objects.push_back(straight_line(p, "lower line", -shift));
    return objects;
}

std::vector<Object> bent_lines_objects(const Parameters &p) {
    const Vec3 along = line_frame(p).along, middle(0, 0, lines_depth(p));
    const double half_length = p.number("lines.half_length_mm"), half_width = p.number("lines.half_width_mm");
    const Vec3 bend = middle + (p.number("orb.radius_mm") + p.number("lines.bend_beyond_mm")) * along;
    const std::vector<Vec3> way{middle - half_length * along, bend, bend + Vec3(half_length, 0, 0)};
    if (is_probe(p)) {
        const double reach = soft_reach * half_width;
        const auto paint = across_texture(p, reach, texels_for(reach, half_width), [&](double from_middle_mm) {
            return Rgb(0, soft_darkness(from_middle_mm, half_width), 0);
        });
        return {{"soft bent line", ribbon(way, reach, Emissive{paint})}};
    }
    std::vector<Object> objects;
    add_card(p, objects);
    const double shift = p.number("lines.shift_mm");
    objects.push_back(straight_line(p, "upper line", shift));
    objects.push_back({"bent middle line", ribbon(way, half_width, Emissive{Rgb(0)})});
    objects.push_back(straight_line(p, "lower line", -shift));
    return objects;
}

} // namespace threefold
