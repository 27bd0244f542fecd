// SPDX-License-Identifier: MIT
// Where an edge between two known radiances crosses a path in a picture, to a fraction of a pixel, and by how much a
// straight edge jumps. Image positions in pixels (the crop when there is one), row 0 on top.
#pragma once

#include <functional>
#include <vector>

#include "exporter/image/image.h"
#include "scenes/camera.h"

namespace threefold {

/// Where the picture's pixels show this point: the inverse of camera_ray at pixel_sample (film offset taken off). NaN
/// for a point that is not before the camera.
Vec2 image_position(const Camera &camera, Vec3 point_mm);

/// Mean of the channels, bilinear between pixel centres; NaN outside of the outermost pixels' centres.
double radiance_at(const Image &image, Vec2 position_px);

/// The number s in [from, to] at which path(s) crosses the edge, when the radiance is `before` until there and `after`
/// from there on: by the share of each along the path, so that a symmetric blur does not move it. The path must begin
/// and end well inside the two plateaus and run at an even speed. NaN where it leaves the picture.
double edge_along(const Image &image, const std::function<Vec2(double)> &path, double from, double to, double before,
                  double after, int steps);

/// A point of an edge in a frame along the edge: x along it, y across.
using AlongAcross = Vec2;

/// How far the points inside lie, on average, beside the straight line through the points outside (least squares in y).
/// NaN with fewer than two points outside or none inside.
double jump_from_line(const std::vector<AlongAcross> &outside, const std::vector<AlongAcross> &inside);

} // namespace threefold
