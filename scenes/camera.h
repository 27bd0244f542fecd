// SPDX-License-Identifier: MIT
// Where a film position looks. One definition for the tracer, the measuring and the predictions.
#pragma once

#include "scenes/scene.h"

namespace threefold {

struct Ray {
    Vec3 origin_mm;
    Vec3 direction; ///< unit length
};

/// The camera's orthonormal frame: `right` is image right, `up` image up, `forward` the viewing direction.
struct CameraFrame {
    Vec3 right, up, forward;
};

CameraFrame camera_frame(const Camera &camera);

/// The ray through a position on the image (the crop when there is one) in pixels, film offset not yet added.
Ray camera_ray(const Camera &camera, Vec2 image_px);

/// The inverse: where on the image a ray of this camera passes. For a ray that does not come from the camera only its
/// direction (perspective) or only its origin (orthographic) counts.
Vec2 image_position(const Camera &camera, const Ray &ray);

/// Image position of the centre of the pixel (column, row) as the camera samples it: film offset added.
inline Vec2 pixel_sample(const Camera &camera, int column, int row) {
    return Vec2(column + 0.5, row + 0.5) + camera.film_offset_px;
}

/// Half of the film's width at unit distance (perspective) or in mm (orthographic).
double film_half_width(const Camera &camera);

} // namespace threefold
