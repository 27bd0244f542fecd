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

double grey(Rgb c) { return (c.r + c.g + c.b) / 3; }

/// What is seen first in each pixel of a small picture.
class Canvas {
public:
    explicit Canvas(const Scene &scene)
        : scene_(scene), lights_(lights_on_diffuse(scene)), frame_(camera_frame(scene.camera)),
          width_(scene.camera.image_width_px()), height_(scene.camera.image_height_px()),
          pixels_(
              static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
              {std::numeric_limits<double>::infinity(), Vec3(0), Vec3(0), 0,
               scene.environment ? grey(scene.environment->radiance) : 0}) {}

    void draw(const std::array<Vec3, 3> &corners, const std::array<Vec2, 3> &uv, const Surface &surface) {
        std::array<Vec3, 3> film; // x and y in pixels, z the depth
        for (std::size_t i = 0; i < 3; ++i) {
            film[i] = project(corners[i]);
            if (!(film[i].z > 0)) return; // behind the eye: its share of the picture is not known so simply
        }
        const auto area = [](Vec3 a, Vec3 b, Vec3 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); };
        const double whole = area(film[0], film[1], film[2]);
        if (whole == 0) return;
        const Vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const auto [left, right] = std::minmax({film[0].x, film[1].x, film[2].x});
        const auto [top, bottom] = std::minmax({film[0].y, film[1].y, film[2].y});
        const auto pixel = [](double x, int most) {
            return static_cast<int>(std::clamp(std::ceil(x - 0.5), 0.0, static_cast<double>(most)));
        };
        for (int row = pixel(top, height_); row < pixel(bottom, height_); ++row)
            for (int column = pixel(left, width_); column < pixel(right, width_); ++column) {
                const Vec3 here(column + 0.5, row + 0.5, 0);
                const double a = area(film[1], film[2], here) / whole, b = area(film[2], film[0], here) / whole;
                const double c = 1 - a - b;
                if (std::min({a, b, c}) < 0) continue;
                SeenPoint &p = pixels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                                   static_cast<std::size_t>(column)];
                const double depth = a * film[0].z + b * film[1].z + c * film[2].z;
                if (depth >= p.depth_mm) continue;
                p = seen_at(surface, a * uv[0] + b * uv[1] + c * uv[2], normal, corners[0]);
                p.depth_mm = depth;
                const Ray ray = camera_ray(scene_.camera, Vec2(column + 0.5, row + 0.5));
                p.point_mm = ray.origin_mm + glm::dot(normal, corners[0] - ray.origin_mm) /
                                                 glm::dot(normal, ray.direction) * ray.direction;
            }
    }

    std::vector<SeenPoint> seen() && { return std::move(pixels_); }

private:
    Vec3 project(Vec3 point) const {
        const Camera &camera = scene_.camera;
        const Vec3 d = point - camera.eye_mm;
        const double depth = glm::dot(d, frame_.forward);
        const bool flat = camera.projection == Projection::orthographic;
        const double scale = 0.5 * camera.width_px / film_half_width(camera) / (flat ? 1 : depth);
        const Vec2 corner = camera.crop ? Vec2(camera.crop->x_px, camera.crop->y_px) : Vec2(0);
        return {0.5 * camera.width_px + scale * glm::dot(d, frame_.right) - corner.x,
                0.5 * camera.height_px - scale * glm::dot(d, frame_.up) - corner.y, depth};
    }

    SeenPoint seen_at(const Surface &surface, Vec2 uv, Vec3 normal, Vec3 point) const {
        const bool flat = scene_.camera.projection == Projection::orthographic;
        const Vec3 to_eye = flat ? -frame_.forward : scene_.camera.eye_mm - point;
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
                              [&](const CoordinateCard &) { return made(0, grey({uv.x, uv.y, 1})); },
                          },
                          surface);
    }

    const Scene &scene_;
    std::vector<Directional> lights_;
    CameraFrame frame_;
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
