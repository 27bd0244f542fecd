// SPDX-License-Identifier: MIT
// The radiance of surfaces that shine by themselves and the reflectance of those that do not, looked up without a
// detour: most rays end on one.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "scenes/scene.h"
#include "verifier/tracer/sights.h"

namespace threefold::tracer {

class Paints {
public:
    explicit Paints(const Scene &scene) : paints_(scene.objects.size()) {
        for (std::size_t i = 0; i < scene.objects.size(); ++i)
            std::visit(overloaded{
                           [](const GlassBall &) {},
                           [](const GlassShell &) {},
                           [&](const Quad &quad) { add(quad.surface, paints_[i]); },
                           [&](const Mesh &mesh) { add(mesh.surface, paints_[i]); },
                       },
                       scene.objects[i].shape);
    }

    /// Does every surface shine, and none reflect?
    bool all_shine() const { return all_shine_; }
    bool shines(std::size_t object) const { return paints_[object].shines; }

    /// Radiance if the object shines, otherwise reflectance.
    Rgb colour(std::size_t object, double u, double v) const {
        const Look &look = paints_[object];
        switch (look.kind) {
        case Sight::Kind::constant:
            return look.colour;
        case Sight::Kind::coordinates:
            return {u, v, 1};
        case Sight::Kind::texture:
            return bilinear(*look.texture, u, v);
        }
        return Rgb(0);
    }

    /// For sights.h; none where the object's texture is too narrow for that.
    std::optional<Sight> sight(std::size_t object) const {
        const Look &look = paints_[object];
        if (look.kind != Sight::Kind::texture) return Sight{look.kind, look.colour};
        const Texture &t = *look.texture;
        if (t.width < 2 || t.height < 2) return std::nullopt;
        return Sight{look.kind, look.colour, t.rgb.data(), static_cast<double>(t.width), static_cast<double>(t.height)};
    }

private:
    struct Look {
        Sight::Kind kind = Sight::Kind::constant;
        bool shines = true;
        Rgb colour{0};
        const Texture *texture = nullptr; ///< owned by the scene
    };

    void add(const Surface &surface, Look &look) {
        const auto paint = [&look](const Paint &p) {
            std::visit(overloaded{
                           [&](const Rgb &colour) { look.colour = colour; },
                           [&](const std::shared_ptr<const Texture> &texture) {
                               look.kind = Sight::Kind::texture;
                               look.texture = texture.get();
                           },
                       },
                       p);
        };
        std::visit(overloaded{
                       [&](const Diffuse &diffuse) {
                           all_shine_ = look.shines = false;
                           paint(diffuse.reflectance);
                       },
                       [&](const Emissive &emissive) { paint(emissive.radiance); },
                       [&](const CoordinateCard &) { look.kind = Sight::Kind::coordinates; },
                   },
                   surface);
    }

    /// As `sample` in scenes/texture.h.
    static Rgb bilinear(const Texture &t, double u, double v) {
        const double x = std::clamp(u * t.width - 0.5, 0.0, t.width - 1.0);
        const double y = std::clamp((1 - v) * t.height - 0.5, 0.0, t.height - 1.0);
        const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
        const double fx = x - x0, fy = y - y0;
        const std::size_t row = static_cast<std::size_t>(t.width) * 3;
        const std::uint16_t *a = t.rgb.data() + static_cast<std::size_t>(y0) * row + static_cast<std::size_t>(x0) * 3;
        const std::uint16_t *b = a + (x0 + 1 < t.width ? 3 : 0);
        const std::size_t down = y0 + 1 < t.height ? row : 0;
        const double w11 = fx * fy, w01 = fx - w11, w10 = fy - w11, w00 = 1 - fx - w10; // of right (x) and lower (y)
        Rgb sum;
        for (int c = 0; c < 3; ++c) sum[c] = w00 * a[c] + w01 * b[c] + w10 * (a + down)[c] + w11 * (b + down)[c];
        return sum * (1 / 65535.0);
    }

    std::vector<Look> paints_;
    bool all_shine_ = true;
};

} // namespace threefold::tracer
