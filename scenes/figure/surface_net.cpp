// SPDX-License-Identifier: MIT
#include "scenes/figure/surface_net.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace threefold::figure {

namespace {

constexpr int block = 4; ///< cells a side of what is skipped together when far from the surface

struct Grid {
    Vec3 low;
    double cell;
    int nx, ny, nz; ///< nodes

    std::size_t index(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(ny) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(nx) +
               static_cast<std::size_t>(x);
    }
    Vec3 node(int x, int y, int z) const { return low + cell * Vec3(x, y, z); }
};

Vec3 onto_surface(const Field &field, Vec3 p, double cell) {
    const double step = 0.05 * cell;
    for (int i = 0; i < 3; ++i) {
        const Vec3 gradient = Vec3(field(p + Vec3(step, 0, 0)) - field(p - Vec3(step, 0, 0)),
                                   field(p + Vec3(0, step, 0)) - field(p - Vec3(0, step, 0)),
                                   field(p + Vec3(0, 0, step)) - field(p - Vec3(0, 0, step))) /
                              (2 * step);
        const double squared = glm::dot(gradient, gradient);
        if (squared < 1e-6) break;
        Vec3 move = -field(p) / squared * gradient;
        const double length = glm::length(move);
        if (length > 0.5 * cell) move *= 0.5 * cell / length;
        p += move;
    }
    return p;
}

/// Values at the nodes; what lies in blocks that the surface cannot reach is left at plus or minus infinity.
std::vector<double> values_on(const Grid &g, const Field &field) {
    std::vector<double> values(g.index(g.nx - 1, g.ny - 1, g.nz - 1) + 1);
    const double reach = 0.5 * std::sqrt(3.0) * (block + 1) * g.cell;
    for (int z0 = 0; z0 < g.nz; z0 += block)
        for (int y0 = 0; y0 < g.ny; y0 += block)
            for (int x0 = 0; x0 < g.nx; x0 += block) {
                const double middle = field(g.node(x0, y0, z0) + Vec3(0.5 * (block - 1) * g.cell));
                const bool far = std::abs(middle) > reach;
                for (int z = z0; z < std::min(z0 + block, g.nz); ++z)
                    for (int y = y0; y < std::min(y0 + block, g.ny); ++y)
                        for (int x = x0; x < std::min(x0 + block, g.nx); ++x)
                            values[g.index(x, y, z)] = far ? std::copysign(std::numeric_limits<double>::max(), middle)
                                                           : field(g.node(x, y, z));
            }
    return values;
}

} // namespace

Mesh surface_net(const Field &field, Vec3 low, Vec3 high, double cell) {
    const Grid g{low, cell, static_cast<int>((high.x - low.x) / cell) + 2,
                 static_cast<int>((high.y - low.y) / cell) + 2, static_cast<int>((high.z - low.z) / cell) + 2};
    const std::vector<double> values = values_on(g, field);
    constexpr unsigned none = std::numeric_limits<unsigned>::max();
    std::vector<unsigned> vertex_of(values.size(), none); // of the cell whose lowest node it is
    Mesh mesh;
    const auto inside = [&](int x, int y, int z) { return values[g.index(x, y, z)] < 0; };
    for (int z = 0; z + 1 < g.nz; ++z)
        for (int y = 0; y + 1 < g.ny; ++y)
            for (int x = 0; x + 1 < g.nx; ++x) {
                // The mean of where the surface crosses the cell's edges.
                Vec3 sum(0);
                int crossings = 0;
                for (int axis = 0; axis < 3; ++axis)
                    for (int k = 0; k < 4; ++k) {
                        std::array<int, 3> from{x, y, z};
                        from[static_cast<std::size_t>((axis + 1) % 3)] += k & 1;
                        from[static_cast<std::size_t>((axis + 2) % 3)] += k >> 1;
                        std::array<int, 3> to = from;
                        ++to[static_cast<std::size_t>(axis)];
                        const double a = values[g.index(from[0], from[1], from[2])];
                        const double b = values[g.index(to[0], to[1], to[2])];
                        if ((a < 0) == (b < 0)) continue;
                        const double t = a / (a - b);
                        sum += g.node(from[0], from[1], from[2]) * (1 - t) + g.node(to[0], to[1], to[2]) * t;
                        ++crossings;
                    }
                if (crossings == 0) continue;
                vertex_of[g.index(x, y, z)] = static_cast<unsigned>(mesh.vertices_mm.size());
                mesh.vertices_mm.push_back(onto_surface(field, sum / static_cast<double>(crossings), cell));
            }
    // Each edge that the surface crosses joins the four cells around it.
    for (int z = 1; z + 1 < g.nz; ++z)
        for (int y = 1; y + 1 < g.ny; ++y)
            for (int x = 1; x + 1 < g.nx; ++x)
                for (int axis = 0; axis < 3; ++axis) {
                    const std::array<int, 3> step{axis == 0, axis == 1, axis == 2};
                    const bool here = inside(x, y, z), there = inside(x + step[0], y + step[1], z + step[2]);
                    if (here == there) continue;
                    const std::array<int, 3> u{axis == 2, axis == 0, axis == 1}, v{axis == 1, axis == 2, axis == 0};
                    const auto cell_at = [&](int i, int j) {
                        return vertex_of[g.index(x - i * u[0] - j * v[0], y - i * u[1] - j * v[1],
                                                 z - i * u[2] - j * v[2])];
                    };
                    unsigned a = cell_at(0, 0), b = cell_at(1, 0), c = cell_at(1, 1), d = cell_at(0, 1);
                    if (there) std::swap(b, d);
                    mesh.triangles.emplace_back(a, b, c);
                    mesh.triangles.emplace_back(a, c, d);
                }
    return mesh;
}

} // namespace threefold::figure
