// SPDX-License-Identifier: MIT
// Where the centre of a dark line crosses a path over a picture (a circle about an orb, or any scan line), to a small
// part of a pixel. Knows pictures and cameras, nothing of who made the picture.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "exporter/image/image.h"
#include "scenes/camera.h"

namespace threefold {

/// The camera's ray that passes `impact_mm` from a point, on the side `azimuth_rad` (0: image right, pi/2: image up).
/// Nothing where the eye is nearer than that.
std::optional<Ray> ray_past(const Camera &camera, Vec3 centre_mm, double impact_mm, double azimuth_rad);

/// A scale on a plane: the place of a point is its coordinate (mm) along `across` (unit) from `origin_mm`.
struct PlaneScale {
    Vec3 origin_mm, across, normal;
};

/// The place at which a ray would meet the plane if nothing bent it; infinite or NaN when it runs along the plane.
double straight_place(const PlaneScale &scale, const Ray &ray);

struct PathPoint {
    Vec2 image_px;
    double place; ///< what a centre on the path is told in; monotone along the path
};

/// The circle of rays that pass `impact_mm` from a point, between two azimuths, in steps of about `step_px`; points
/// within two pixels of the picture's border are left out.
std::vector<PathPoint> circle_path(const Camera &camera, Vec3 centre_mm, double impact_mm, const PlaneScale &scale,
                                   double from_rad, double to_rad, double step_px = 0.1);

/// One channel at an image position, by cubic convolution of the samples (Keys 1981, a = -1/2): smooth profiles lose
/// nothing to second order. The camera says where in its pixel each sample was taken.
double value_at(const Image &image, const Camera &camera, Vec2 image_px, int channel);

/// Of a dip's depth: there it is over.
inline constexpr double dip_ends = 2e-3;

struct DarkCentre {
    double place;
    Vec2 image_px;
};

/// The centre of darkness of the darkest dip of one channel below `bright`. Nothing where there is no dip, or where it
/// reaches an end of the path.
std::optional<DarkCentre> dark_centre(const Image &image, const Camera &camera, std::span<const PathPoint> path,
                                      int channel, double bright = 1);

} // namespace threefold
