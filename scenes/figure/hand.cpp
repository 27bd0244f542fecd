// SPDX-License-Identifier: MIT
// Built around an orb of radius 1 at the origin, then scaled.
#include "scenes/figure/hand.h"

#include "scenes/figure/drawing.h"
#include "scenes/figure/hand_shape.h"
#include "scenes/figure/stored_figure.h"
#include "scenes/geometry.h"

namespace threefold::figure {

namespace {

const Mesh &unit_hand() {
    static const Mesh mesh = [] {
        Mesh m = stored_hand_shape();
        constexpr Vec3 low = hand_low, high = hand_high;
        for (const Vec3 v : m.vertices_mm) // seen from the side: no finger lies before another
            m.uv.emplace_back((v.z - low.z) / (high.z - low.z), (v.y - low.y) / (high.y - low.y));
        return m;
    }();
    return mesh;
}

} // namespace

double contact_gap_mm(double orb_radius_mm) { return std::min(0.1, 1.5e-3 * orb_radius_mm); }

Mesh holding_hand(Vec3 orb_centre_mm, double orb_radius_mm) {
    Mesh mesh = unit_hand();
    const double gap = contact_gap_mm(orb_radius_mm);
    for (Vec3 &v : mesh.vertices_mm) v *= orb_radius_mm;
    // Chords of triangles sink below the sphere on which their vertices lie: lift these until the triangles are clear.
    double floor_mm = orb_radius_mm + gap;
    for (int i = 0; i < 8; ++i) {
        for (Vec3 &v : mesh.vertices_mm)
            if (const double r = glm::length(v); r < floor_mm) v *= floor_mm / r;
        const double missing = orb_radius_mm + gap - distance_to(mesh, Vec3(0));
        if (missing < gap / 2) break;
        floor_mm += missing;
    }
    for (Vec3 &v : mesh.vertices_mm) v += orb_centre_mm;
    return mesh;
}

std::shared_ptr<const Texture> hand_texture() {
    static const std::shared_ptr<const Texture> texture = [] {
        constexpr int side = 192;
        auto image = std::make_shared<Texture>(Texture{side, side, {}});
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) {
                const Vec2 uv((column + 0.5) / side, 1 - (row + 0.5) / side);
                Rgb colour = mix(Rgb(0.43, 0.245, 0.135), Rgb(0.50, 0.30, 0.17), 0.5 + 0.5 * noise(uv * 14.0, 3, 70));
                colour = mix(colour, Rgb(0.52, 0.255, 0.15), 0.5 * soft_step(0.82, 0.95, uv.x)); // finger tips
                colour *= 1 + 0.05 * noise(uv * 50.0, 2, 71);
                for (int k = 0; k < 3; ++k)
                    image->rgb.push_back(static_cast<std::uint16_t>(std::lround(colour[k] * 65535)));
            }
        return image;
    }();
    return texture;
}

} // namespace threefold::figure
