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

Film::Film(const Camera &camera)
    : frame_(camera_frame(camera)), projection_(camera.projection), eye_mm_(camera.eye_mm),
      corner_(camera.crop ? Vec2(camera.crop->x_px, camera.crop->y_px) : Vec2(0)),
      middle_(camera.width_px / 2.0, camera.height_px / 2.0), pixel_(2 * film_half_width(camera) / camera.width_px) {}

Ray Film::ray(Vec2 image_px) const {
    const Vec2 film = corner_ + image_px;
    const double x = (film.x - middle_.x) * pixel_, y = (middle_.y - film.y) * pixel_;
    switch (projection_) {
    case Projection::perspective:
        return {eye_mm_, glm::normalize(frame_.forward + x * frame_.right + y * frame_.up)};
    case Projection::orthographic:
        return {eye_mm_ + x * frame_.right + y * frame_.up, frame_.forward};
    }
    return {};
}

Ray camera_ray(const Camera &camera, Vec2 image_px) { return Film(camera).ray(image_px); }

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
