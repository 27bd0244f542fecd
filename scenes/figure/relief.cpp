// SPDX-License-Identifier: MIT
#include "scenes/figure/relief.h"

namespace threefold::figure {

namespace {

constexpr int texture_width = 704, texture_height = 1022;

Vec2 place_at(double u, double v) { return relief_low + Vec2(u, v) * (relief_high - relief_low); }

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
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const Vec2 uv(static_cast<double>(column) / (columns - 1), static_cast<double>(row) / (rows - 1));
            const Vec2 place = place_at(uv.x, uv.y);
            mesh.uv.push_back(uv);
            mesh.vertices_mm.push_back(standpoint.point_mm(place, painting.at(place).height));
        }
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
                    painting.at(place_at((column + 0.5) / texture_width, 1 - (row + 0.5) / texture_height)).colour;
                for (int k = 0; k < 3; ++k)
                    image->rgb.push_back(static_cast<std::uint16_t>(std::lround(colour[k] * 65535)));
            }
        return image;
    }();
    return texture;
}

} // namespace threefold::figure
