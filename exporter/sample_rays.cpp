// SPDX-License-Identifier: MIT
#include "exporter/sample_rays.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace threefold {

std::vector<Ray> sample_rays(const Camera &camera) {
    constexpr int most_a_side = 48;
    const int columns = std::min(camera.image_width_px(), most_a_side),
              rows = std::min(camera.image_height_px(), most_a_side);
    const Film film(camera);
    std::vector<Ray> rays;
    rays.reserve(static_cast<std::size_t>(columns * rows));
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            rays.push_back(film.ray(Vec2((column + 0.5) * camera.image_width_px() / columns,
                                         (row + 0.5) * camera.image_height_px() / rows)));
    return rays;
}

Passing pass(const Ray &ray, Vec3 point_mm) {
    const Vec3 to_point = point_mm - ray.origin_mm;
    const double along_mm = glm::dot(to_point, ray.direction);
    return {along_mm, glm::length(along_mm * ray.direction - to_point)};
}

} // namespace threefold
