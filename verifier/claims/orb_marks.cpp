// SPDX-License-Identifier: MIT
#include "verifier/claims/orb_marks.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace threefold {

Vec2 image_of(const Camera &camera, Vec3 point_mm) {
    const CameraFrame frame = camera_frame(camera);
    const Vec3 d = point_mm - camera.eye_mm;
    const double depth = glm::dot(d, frame.forward);
    const double pixels = camera.width_px / (2 * film_half_width(camera));
    const Vec2 corner = camera.crop ? Vec2(camera.crop->x_px, camera.crop->y_px) : Vec2(0);
    return Vec2(camera.width_px / 2.0 + pixels * glm::dot(d, frame.right) / depth,
                camera.height_px / 2.0 - pixels * glm::dot(d, frame.up) / depth) -
           corner;
}

double column_of(const Camera &camera, const OrbInScene &orb, double impact_mm, double row) {
    double low = 0, high = camera.image_width_px();
    for (int step = 0; step < 60; ++step) {
        const double middle = (low + high) / 2;
        (impact_parameter(camera_ray(camera, {middle, row}), orb.centre_mm) < impact_mm ? low : high) = middle;
    }
    return low;
}

Mark impact_circle(const Camera &camera, const OrbInScene &orb, double impact_mm, Mark::Meaning meaning,
                   std::string label) {
    const double eye = glm::length(camera.eye_mm - orb.centre_mm);
    const double tangent = impact_mm / std::sqrt((eye - impact_mm) * (eye + impact_mm));
    Mark mark;
    mark.kind = Mark::Kind::circle;
    mark.from_px = image_of(camera, orb.centre_mm);
    mark.radius_px = tangent * camera.width_px / (2 * film_half_width(camera));
    mark.meaning = meaning;
    mark.label = std::move(label);
    return mark;
}

} // namespace threefold
