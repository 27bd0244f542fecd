// SPDX-License-Identifier: MIT
#include "scenes/figure/relief.h"

namespace threefold::figure {

namespace {

constexpr int texture_width = 704, texture_height = 1036;

/// Texture coordinates are those of the whole picture.
constexpr Vec2 picture_high{1, picture_height};
Vec2 place_at(Vec2 uv) { return (2.0 * uv - 1.0) * picture_high; }
Vec2 uv_at(Vec2 place) { return 0.5 * (place / picture_high + 1.0); }

/// A cliff between two cells would be a row of teeth: it is spread over this (standard deviation).
constexpr double softness = 0.008;

/// One pass of the binomial filter (1 2 1) / 4 along and across.
void soften(std::vector<double> &heights, int columns, int rows) {
    const auto pass = [&](int step, int count, int stride, int lines) {
        for (int line = 0; line < lines; ++line) {
            double before = heights[static_cast<std::size_t>(line * stride)];
            for (int i = 0; i < count; ++i) {
                double &here = heights[static_cast<std::size_t>(line * stride + i * step)];
                const double after =
                    i + 1 < count ? heights[static_cast<std::size_t>(line * stride + (i + 1) * step)] : here;
                const double old = here;
                here = (before + 2 * old + after) / 4;
                before = old;
            }
        }
    };
    pass(1, columns, columns, rows);
    pass(columns, rows, 1, columns);
}

} // namespace

Vec3 Standpoint::point_mm(Vec2 place, double height) const {
    const double distance = eye_mm.z - plane_z_mm, unit = unit_mm();
    const Vec3 ground(eye_mm.x + place.x * unit, eye_mm.y + place.y * unit, plane_z_mm);
    return eye_mm + (ground - eye_mm) * (1 - height * unit / distance);
}

Vec2 Standpoint::place(Vec3 point_mm) const {
    const Vec3 d = point_mm - eye_mm;
    return Vec2(d.x, d.y) / (-d.z * half_angle_tangent);
}

Mesh relief(const Standpoint &standpoint, int columns) {
    const Vec2 size = relief_high - relief_low;
    const int rows = std::max(2, static_cast<int>(std::lround((columns - 1) * size.y / size.x)) + 1);
    const Painting painting;
    Mesh mesh;
    std::vector<double> heights;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const Vec2 share(static_cast<double>(column) / (columns - 1), static_cast<double>(row) / (rows - 1));
            const Vec2 place = relief_low + share * size;
            mesh.uv.push_back(uv_at(place));
            heights.push_back(painting.at(place).height);
        }
    const double cell = size.x / (columns - 1); // a pass has the variance of half a cell squared
    const auto passes = std::min(64L, std::lround(2 * softness * softness / (cell * cell)));
    for (long i = 0; i < passes; ++i) soften(heights, columns, rows);
    for (std::size_t i = 0; i < heights.size(); ++i)
        mesh.vertices_mm.push_back(standpoint.point_mm(place_at(mesh.uv[i]), heights[i]));
    for (int row = 0; row + 1 < rows; ++row)
        for (int column = 0; column + 1 < columns; ++column) {
            const auto a = static_cast<unsigned>(row * columns + column), b = a + 1;
            const auto c = a + static_cast<unsigned>(columns), d = c + 1;
            // Along the cell's flatter diagonal: a ridge across a cell stays a ridge.
            const auto bent = [&](unsigned i, unsigned j) {
                return std::abs(mesh.vertices_mm[i].z - mesh.vertices_mm[j].z);
            };
            if (bent(a, d) < bent(b, c)) {
                mesh.triangles.emplace_back(a, b, d);
                mesh.triangles.emplace_back(a, d, c);
            } else {
                mesh.triangles.emplace_back(a, b, c);
                mesh.triangles.emplace_back(b, d, c);
            }
        }
    return mesh;
}

std::shared_ptr<const Texture> relief_texture() {
    // Always the same: made once a process.
    static const std::shared_ptr<const Texture> texture = [] {
        const Painting painting;
        auto image = std::make_shared<Texture>(Texture{texture_width, texture_height, {}});
        image->rgb.reserve(static_cast<std::size_t>(texture_width) * texture_height * 3);
        for (int row = 0; row < texture_height; ++row)
            for (int column = 0; column < texture_width; ++column) {
                const Rgb colour =
                    painting.at(place_at({(column + 0.5) / texture_width, 1 - (row + 0.5) / texture_height})).colour;
                for (int k = 0; k < 3; ++k)
                    image->rgb.push_back(static_cast<std::uint16_t>(std::lround(colour[k] * 65535)));
            }
        return image;
    }();
    return texture;
}

} // namespace threefold::figure
