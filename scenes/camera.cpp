// SPDX-License-Identifier: MIT
#include "scenes/camera.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace threefold {

CameraFrame camera_frame(const Camera &camera) {
    const Vec3 forward = glm::normalize(camera.target_mm - camera.eye_mm);
    const Vec3 right = glm::normalize(glm::cross(forward, camera.up));
    return {right, glm::cross(right, forward), forward};
}

double film_half_width(const Camera &camera) {
    switch (camera.projection) {
    case Projection::perspective:
        return std::tan(camera.horizontal_fov_deg * std::numbers::pi / 360);
    case Projection::orthographic:
        return camera.orthographic_width_mm / 2;
    }
    return 0;
}

Ray camera_ray(const Camera &camera, Vec2 image_px) {
    const auto [right, up, forward] = camera_frame(camera);
    const Vec2 corner = camera.crop ? Vec2(camera.crop->x_px, camera.crop->y_px) : Vec2(0);
    const Vec2 film = corner + image_px;
    const double pixel = 2 * film_half_width(camera) / camera.width_px;
    const double x = (film.x - camera.width_px / 2.0) * pixel;
    const double y = (camera.height_px / 2.0 - film.y) * pixel;
    switch (camera.projection) {
    case Projection::perspective:
        return {camera.eye_mm, glm::normalize(forward + x * right + y * up)};
    case Projection::orthographic:
        return {camera.eye_mm + x * right + y * up, forward};
    }
    return {};
}

Vec2 image_position(const Camera &camera, const Ray &ray) {
    const auto [right, up, forward] = camera_frame(camera);
    const Vec2 corner = camera.crop ? Vec2(camera.crop->x_px, camera.crop->y_px) : Vec2(0);
    const double pixel = 2 * film_half_width(camera) / camera.width_px;
    Vec2 film(0);
    switch (camera.projection) {
    case Projection::perspective:
        film = Vec2(glm::dot(ray.direction, right), glm::dot(ray.direction, up)) / glm::dot(ray.direction, forward);
        break;
    case Projection::orthographic:
        film = {glm::dot(ray.origin_mm - camera.eye_mm, right), glm::dot(ray.origin_mm - camera.eye_mm, up)};
        break;
    }
    return Vec2(film.x / pixel + camera.width_px / 2.0, camera.height_px / 2.0 - film.y / pixel) - corner;
}

} // namespace threefold
