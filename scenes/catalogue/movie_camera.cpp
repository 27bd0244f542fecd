// SPDX-License-Identifier: MIT
#include "scenes/catalogue/movie_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace threefold {

namespace {

constexpr int tones = 64; ///< greys that the shading chooses from
constexpr int facets = 40;

/// Triangles with their shade: each has its own three corners, for its own tone.
class Painter {
public:
    Painter(Vec3 front_mm, Vec3 forward, Vec3 up, double length_mm)
        : front_(front_mm), back_(-forward), up_(up), side_(glm::cross(up, -forward)), unit_(length_mm) {}

    /// Local coordinates: x backwards from the lens's front, y up, z sideways, in lengths of the camera.
    void triangle(Vec3 a, Vec3 b, Vec3 c, double reflectance) {
        const Vec3 normal = glm::normalize(glm::cross(b - a, c - a));
        // As if lit from above, in front and from one side.
        const double lit = 0.45 + 0.4 * std::max(0.0, glm::dot(normal, glm::normalize(Vec3(-0.5, 0.7, -0.6)))) +
                           0.15 * std::max(0.0, glm::dot(normal, glm::normalize(Vec3(0.3, 0.5, 0.8))));
        const int tone = std::clamp(static_cast<int>(reflectance * lit * tones), 0, tones - 1);
        for (const Vec3 &p : {a, b, c}) {
            mesh_.vertices_mm.push_back(front_ + unit_ * (p.x * back_ + p.y * up_ + p.z * side_));
            mesh_.uv.push_back({(tone + 0.5) / tones, 0.5});
        }
        const auto last = static_cast<std::uint32_t>(mesh_.vertices_mm.size());
        mesh_.triangles.push_back({last - 3, last - 2, last - 1});
    }

    void quad(Vec3 a, Vec3 b, Vec3 c, Vec3 d, double reflectance) {
        triangle(a, b, c, reflectance);
        triangle(a, c, d, reflectance);
    }

    void box(Vec3 low, Vec3 high, double reflectance) {
        const auto at = [&](int x, int y, int z) {
            return Vec3(x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z);
        };
        quad(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0), reflectance);
        quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1), reflectance);
        quad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1), reflectance);
        quad(at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0), reflectance);
        quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0), reflectance);
        quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1), reflectance);
    }

    /// From the middle of one end to that of the other, along x or z; radii at both ends.
    void cone(Vec3 from, Vec3 to, double from_radius, double to_radius, double reflectance) {
        const Vec3 axis = glm::normalize(to - from), one(0, 1, 0), other = glm::cross(axis, one);
        for (int k = 0; k < facets; ++k) {
            const auto rim = [&](int index) {
                const double angle = 2 * std::numbers::pi * index / facets;
                return std::cos(angle) * one + std::sin(angle) * other;
            };
            const Vec3 p = rim(k), q = rim(k + 1);
            quad(from + from_radius * p, to + to_radius * p, to + to_radius * q, from + from_radius * q, reflectance);
            triangle(from, from + from_radius * p, from + from_radius * q, 0.4 * reflectance);
            triangle(to, to + to_radius * q, to + to_radius * p, reflectance);
        }
    }

    Mesh finish(double radiance) {
        auto palette = std::make_shared<Texture>(Texture{tones, 1, {}});
        for (int k = 0; k < tones; ++k)
            for (int channel = 0; channel < 3; ++channel)
                palette->rgb.push_back(
                    static_cast<std::uint16_t>(std::lround(65535 * std::min(1.0, radiance) * (k + 0.5) / tones)));
        mesh_.surface = Emissive{palette};
        return std::move(mesh_);
    }

private:
    Vec3 front_, back_, up_, side_;
    double unit_;
    Mesh mesh_;
};

} // namespace

Mesh movie_camera(Vec3 front_mm, Vec3 forward, Vec3 up, double length_mm, double radiance) {
    Painter paint(front_mm, forward, up, length_mm);
    paint.cone({0, 0, 0}, {0.14, 0, 0}, 0.15, 0.10, 0.45);    // hood
    paint.cone({0.14, 0, 0}, {0.34, 0, 0}, 0.09, 0.09, 0.6);  // lens
    paint.box({0.34, -0.16, -0.13}, {0.9, 0.16, 0.13}, 0.85); // body
    paint.box({0.9, -0.05, -0.04}, {1, 0.07, 0.04}, 0.5);     // finder
    for (const double x : {0.46, 0.8}) {                      // reels
        paint.cone({x, 0.34, -0.06}, {x, 0.34, 0.06}, 0.18, 0.18, 0.7);
        paint.cone({x, 0.34, -0.07}, {x, 0.34, 0.07}, 0.05, 0.05, 0.3);
    }
    return paint.finish(radiance);
}

} // namespace threefold
