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

/// The same for many rays of one camera.
class Film {
public:
    explicit Film(const Camera &camera);
    Ray ray(Vec2 image_px) const;
    /// Side of a pixel at unit distance (perspective) or in mm (orthographic).
    double pixel() const { return pixel_; }
    const CameraFrame &frame() const { return frame_; }
    Vec3 eye_mm() const { return eye_mm_; }
    Vec2 corner_px() const { return corner_; } ///< of the image on the full film
    Vec2 middle_px() const { return middle_; } ///< of the full film
    bool is_perspective() const { return projection_ == Projection::perspective; }

private:
    CameraFrame frame_;
    Projection projection_;
    Vec3 eye_mm_;
    Vec2 corner_, middle_; ///< in pixels of the full film
    double pixel_;
};

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
