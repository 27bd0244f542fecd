// SPDX-License-Identifier: MIT
#include "verifier/measure/dark_line.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace threefold {

namespace {

constexpr double least_dip = 0.1; ///< of the bright level: less is no line
constexpr double border_px = 2;   ///< what cubic convolution needs around a position

/// Weights of the samples at -1, 0, 1, 2 for a position t in [0, 1].
std::array<double, 4> cubic_weights(double t) {
    return {((2 - t) * t - 1) * t / 2, ((3 * t - 5) * t * t + 2) / 2, ((4 - 3 * t) * t + 1) * t / 2,
            (t - 1) * t * t / 2};
}

} // namespace

std::optional<Ray> ray_past(const Camera &camera, Vec3 centre_mm, double impact_mm, double azimuth_rad) {
    const auto [right, up, forward] = camera_frame(camera);
    const Vec3 to_centre = centre_mm - camera.eye_mm;
    switch (camera.projection) {
    case Projection::perspective: {
        const double distance = glm::length(to_centre), sine = impact_mm / distance;
        if (!(sine < 1)) return std::nullopt;
        const Vec3 axis = to_centre / distance;
        const Vec3 rightwards = glm::normalize(right - glm::dot(right, axis) * axis);
        const Vec3 outwards = std::cos(azimuth_rad) * rightwards + std::sin(azimuth_rad) * glm::cross(rightwards, axis);
        return Ray{camera.eye_mm, std::sqrt((1 - sine) * (1 + sine)) * axis + sine * outwards};
    }
    case Projection::orthographic: {
        const Vec3 outwards = std::cos(azimuth_rad) * right + std::sin(azimuth_rad) * up;
        return Ray{centre_mm + impact_mm * outwards - glm::dot(to_centre, forward) * forward, forward};
    }
    }
    return std::nullopt;
}

double straight_place(const PlaneScale &scale, const Ray &ray) {
    const double distance =
        glm::dot(scale.normal, scale.origin_mm - ray.origin_mm) / glm::dot(scale.normal, ray.direction);
    return glm::dot(ray.origin_mm + distance * ray.direction - scale.origin_mm, scale.across);
}

std::vector<PathPoint> circle_path(const Camera &camera, Vec3 centre_mm, double impact_mm, const PlaneScale &scale,
                                   double from_rad, double to_rad, double step_px) {
    std::vector<PathPoint> path;
    const auto start = ray_past(camera, centre_mm, impact_mm, from_rad);
    const auto opposite = ray_past(camera, centre_mm, impact_mm, from_rad + 3.141592653589793);
    if (!start || !opposite) return path;
    const double radius_px = glm::length(image_position(camera, *start) - image_position(camera, *opposite)) / 2;
    const int steps = static_cast<int>(std::clamp((to_rad - from_rad) * radius_px / step_px, 16.0, 1e6));
    for (int k = 0; k <= steps; ++k) {
        const Ray ray = *ray_past(camera, centre_mm, impact_mm, from_rad + (to_rad - from_rad) * k / steps);
        const Vec2 at = image_position(camera, ray);
        if (at.x > border_px && at.y > border_px && at.x < camera.image_width_px() - border_px &&
            at.y < camera.image_height_px() - border_px)
            path.push_back({at, straight_place(scale, ray)});
    }
    return path;
}

double value_at(const Image &image, const Camera &camera, Vec2 image_px, int channel) {
    const Vec2 at = image_px - camera.film_offset_px - Vec2(0.5);
    const int column = static_cast<int>(std::floor(at.x)), row = static_cast<int>(std::floor(at.y));
    const auto x = cubic_weights(at.x - column), y = cubic_weights(at.y - row);
    double sum = 0;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            sum += x[static_cast<std::size_t>(i)] * y[static_cast<std::size_t>(j)] *
                   image.at(std::clamp(column + i - 1, 0, image.width - 1),
                            std::clamp(row + j - 1, 0, image.height - 1))[channel];
    return sum;
}

std::optional<DarkCentre> dark_centre(const Image &image, const Camera &camera, std::span<const PathPoint> path,
                                      int channel, double bright) {
    if (path.size() < 3) return std::nullopt;
    std::vector<double> dark;
    for (const PathPoint &p : path) dark.push_back(1 - value_at(image, camera, p.image_px, channel) / bright);
    const auto darkest = static_cast<std::size_t>(std::ranges::max_element(dark) - dark.begin());
    if (!(dark[darkest] > least_dip)) return std::nullopt;
    std::size_t first = darkest, last = darkest;
    while (first > 0 && dark[first] > dip_ends * dark[darkest]) --first;
    while (last + 1 < dark.size() && dark[last] > dip_ends * dark[darkest]) ++last;
    if (first == 0 || last + 1 == dark.size()) return std::nullopt;
    double sum = 0, first_moment = 0;
    Vec2 centre(0);
    for (std::size_t k = first + 1; k < last; ++k) {
        const double weight = dark[k] * std::abs(path[k + 1].place - path[k - 1].place);
        sum += weight;
        first_moment += weight * path[k].place;
        centre += weight * path[k].image_px;
    }
    return DarkCentre{first_moment / sum, centre / sum};
}

} // namespace threefold
