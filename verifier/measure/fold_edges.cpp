// SPDX-License-Identifier: MIT
#include "verifier/measure/fold_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace threefold {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double grey(const Rgb &c) { return (c.r + c.g + c.b) / 3; }

/// Sums of a straight line's least squares, about the mean of x.
struct LineSums {
    double count = 0, mean_x = 0, mean_y = 0, xx = 0, xy = 0;

    explicit LineSums(const std::vector<AlongAcross> &points) {
        count = static_cast<double>(points.size());
        for (const AlongAcross &p : points) {
            mean_x += p.x / count;
            mean_y += p.y / count;
        }
        for (const AlongAcross &p : points) {
            xx += (p.x - mean_x) * (p.x - mean_x);
            xy += (p.x - mean_x) * (p.y - mean_y);
        }
    }
};

} // namespace

Vec2 image_position(const Camera &camera, Vec3 point_mm) {
    const auto [right, up, forward] = camera_frame(camera);
    const Vec3 d = point_mm - camera.eye_mm;
    const double depth = glm::dot(d, forward);
    if (!(depth > 0)) return Vec2(nan);
    const double unit = camera.projection == Projection::perspective ? depth : 1;
    const double per_px = 2 * film_half_width(camera) / camera.width_px * unit;
    const Vec2 film(camera.width_px / 2.0 + glm::dot(d, right) / per_px,
                    camera.height_px / 2.0 - glm::dot(d, up) / per_px);
    const Vec2 corner = camera.crop ? Vec2(camera.crop->x_px, camera.crop->y_px) : Vec2(0);
    return film - corner - camera.film_offset_px;
}

double radiance_at(const Image &image, Vec2 position_px) {
    const Vec2 p = position_px - Vec2(0.5);
    if (!(p.x >= 0 && p.y >= 0 && p.x <= image.width - 1 && p.y <= image.height - 1)) return nan;
    const int left = std::min(static_cast<int>(p.x), std::max(0, image.width - 2));
    const int top = std::min(static_cast<int>(p.y), std::max(0, image.height - 2));
    const int right = std::min(left + 1, image.width - 1), bottom = std::min(top + 1, image.height - 1);
    const double x = p.x - left, y = p.y - top;
    return (1 - y) * ((1 - x) * grey(image.at(left, top)) + x * grey(image.at(right, top))) +
           y * ((1 - x) * grey(image.at(left, bottom)) + x * grey(image.at(right, bottom)));
}

double edge_along(const Image &image, const std::function<Vec2(double)> &path, double from, double to, double before,
                  double after, int steps) {
    double share = 0;
    for (int k = 0; k < steps; ++k)
        share += (radiance_at(image, path(from + (to - from) * (k + 0.5) / steps)) - after) / (before - after) / steps;
    return from + (to - from) * share;
}

double jump_from_line(const std::vector<AlongAcross> &outside, const std::vector<AlongAcross> &inside) {
    const LineSums line(outside), within(inside);
    if (outside.size() < 2 || inside.empty() || !(line.xx > 0)) return nan;
    return within.mean_y - line.mean_y - line.xy / line.xx * (within.mean_x - line.mean_x);
}

} // namespace threefold
