// SPDX-License-Identifier: MIT
#include "verifier/claims/visible.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>

#include "scenes/access.h"
#include "scenes/camera.h"
#include "scenes/light.h"
#include "scenes/texture.h"

namespace threefold {

namespace {

/// What is seen first in each pixel of a small picture.
class Canvas {
public:
    explicit Canvas(const Scene &scene)
        : scene_(scene), lights_(lights_on_diffuse(scene)), film_(scene.camera), width_(scene.camera.image_width_px()),
          height_(scene.camera.image_height_px()),
          pixels_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                  {std::numeric_limits<double>::infinity(), Vec3(0), Vec3(0), 0,
                   scene.environment ? grey(scene.environment->radiance) : 0}) {}

    void draw(const std::array<Vec3, 3> &corners, const std::array<Vec2, 3> &uv, const Surface &surface) {
        const Vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double whole = glm::dot(normal, normal);
        if (whole == 0) return;
        const Box box = pixels_of(corners);
        for (int row = box.top; row < box.bottom; ++row)
            for (int column = box.left; column < box.right; ++column) {
                const Ray ray = film_.ray(Vec2(column + 0.5, row + 0.5));
                const double along = glm::dot(normal, corners[0] - ray.origin_mm) / glm::dot(normal, ray.direction);
                if (!(along > 0 && along < std::numeric_limits<double>::infinity())) continue;
                const Vec3 here = ray.origin_mm + along * ray.direction;
                const auto share = [&](Vec3 from, Vec3 to) {
                    return glm::dot(glm::cross(from - here, to - here), normal) / whole;
                };
                const double a = share(corners[1], corners[2]), b = share(corners[2], corners[0]), c = 1 - a - b;
                if (std::min({a, b, c}) < -1e-12) continue; // no gap between neighbours
                SeenPoint &p = pixels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                                       static_cast<std::size_t>(column)];
                const double depth = glm::dot(here - scene_.camera.eye_mm, film_.frame().forward);
                if (depth >= p.depth_mm) continue;
                p = seen_at(surface, a * uv[0] + b * uv[1] + c * uv[2], normal, corners[0]);
                p.depth_mm = depth;
                p.point_mm = here;
            }
    }

    std::vector<SeenPoint> seen() && { return std::move(pixels_); }

private:
    struct Box {
        int left, right, top, bottom;
    };

    /// Those whose centres a triangle can cover: all of them where it reaches behind the eye, and nothing projects.
    Box pixels_of(const std::array<Vec3, 3> &corners) const {
        std::array<Vec2, 3> seen;
        int in_front = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 to = corners[i] - film_.eye_mm();
            in_front += glm::dot(to, film_.frame().forward) > 0;
            seen[i] = image_position(scene_.camera, {corners[i], to});
        }
        if (in_front == 0) return {0, 0, 0, 0};
        if (in_front < 3) return {0, width_, 0, height_};
        const auto [left, right] = std::minmax({seen[0].x, seen[1].x, seen[2].x});
        const auto [top, bottom] = std::minmax({seen[0].y, seen[1].y, seen[2].y});
        const auto pixel = [](double x, int most) {
            return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(most)));
        };
        return {pixel(left, width_), pixel(right, width_), pixel(top, height_), pixel(bottom, height_)};
    }

    SeenPoint seen_at(const Surface &surface, Vec2 uv, Vec3 normal, Vec3 point) const {
        const bool flat = scene_.camera.projection == Projection::orthographic;
        const Vec3 to_eye = flat ? -film_.frame().forward : scene_.camera.eye_mm - point;
        const Vec3 n = glm::normalize(glm::dot(normal, to_eye) > 0 ? normal : -normal);
        const auto made = [&](double reflectance, double radiance) {
            return SeenPoint{0, Vec3(0), n, reflectance, radiance};
        };
        return std::visit(overloaded{
                              [&](const Diffuse &diffuse) {
                                  double irradiance = 0;
                                  for (const Directional &light : lights_)
                                      irradiance += grey(light.irradiance) *
                                                    std::max(0.0, -glm::dot(n, glm::normalize(light.travel)));
                                  const double reflectance = grey(sample(diffuse.reflectance, uv));
                                  return made(reflectance, reflectance * irradiance / std::numbers::pi);
                              },
                              [&](const Emissive &emissive) { return made(0, grey(sample(emissive.radiance, uv))); },
                              [&](const CoordinateCard &) {
                                  return made(0, grey({uv.x, uv.y, 1}));
                              },
                          },
                          surface);
    }

    const Scene &scene_;
    std::vector<Directional> lights_;
    Film film_;
    int width_, height_;
    std::vector<SeenPoint> pixels_;
};

void draw(Canvas &canvas, const Mesh &mesh) {
    for (const glm::uvec3 &t : mesh.triangles) {
        std::array<Vec2, 3> uv{};
        if (!mesh.uv.empty()) uv = {mesh.uv[t.x], mesh.uv[t.y], mesh.uv[t.z]};
        canvas.draw({mesh.vertices_mm[t.x], mesh.vertices_mm[t.y], mesh.vertices_mm[t.z]}, uv, mesh.surface);
    }
}

void draw(Canvas &canvas, const Quad &quad) {
    const Vec3 a = quad.centre_mm - quad.half_u_mm - quad.half_v_mm, u = 2.0 * quad.half_u_mm, v = 2.0 * quad.half_v_mm;
    canvas.draw({a, a + u, a + u + v}, {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1)}, quad.surface);
    canvas.draw({a, a + u + v, a + v}, {Vec2(0, 0), Vec2(1, 1), Vec2(0, 1)}, quad.surface);
}

} // namespace

std::vector<SeenPoint> first_seen(const Scene &scene) {
    Canvas canvas(scene);
    for (const Object &object : scene.objects)
        std::visit(overloaded{
                       [](const GlassBall &) {},
                       [](const GlassShell &) {},
                       [&](const Quad &quad) { draw(canvas, quad); },
                       [&](const Mesh &mesh) { draw(canvas, mesh); },
                   },
                   object.shape);
    return std::move(canvas).seen();
}

} // namespace threefold
