// SPDX-License-Identifier: MIT
#include "scenes/figure/relief.h"

#include "scenes/figure/painted_relief.h"
#include "scenes/figure/stored_figure.h"

namespace threefold::figure {

namespace {

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
    const ReliefGrid grid(columns);
    const int rows = grid.rows;
    Mesh mesh;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) mesh.uv.push_back(uv_at(grid.place(column, row)));
    std::vector<double> heights = columns == usual_relief_columns ? stored_heights() : paint_heights(grid);
    const double cell =
        (relief_high.x - relief_low.x) / (columns - 1); // a pass has the variance of half a cell squared
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
    static const auto texture =
        std::make_shared<const Texture>(Texture{relief_texture_width, relief_texture_height, stored_relief_texture()});
    return texture;
}

} // namespace threefold::figure
