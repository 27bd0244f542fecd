// SPDX-License-Identifier: MIT
// The extraordinary ray through a ball of a uniaxial crystal in air: exact geometric optics, walk-off included. The
// ordinary ray is that of an isotropic ball (transmitted_ray.h). World frame, millimetres.
//
// With k in units of the vacuum wave number, the extraordinary wave surface is (k.c)^2 / n_o^2 + |k x c|^2 / n_e^2 = 1
// (Born & Wolf 15.3.2); along a smooth surface the tangential part of k stays; energy goes along the surface's normal
// in k space, which is the ray. Valid for any two indices above that of air.
#pragma once

#include <optional>

#include "scenes/camera.h"

namespace threefold::optics {

struct Uniaxial {
    double ordinary, extraordinary; ///< principal indices
    Vec3 axis;                      ///< optic axis; any length but 0
};

/// From where it leaves the ball. Nothing where the ray misses it, starts inside, or would be totally reflected.
std::optional<Ray> extraordinary_ray(double radius_mm, const Uniaxial &crystal, Vec3 centre_mm, const Ray &ray);

/// The greatest angle between wave normal and ray: atan(|n_o^2 - n_e^2| / (2 n_o n_e)).
double greatest_walk_off_rad(const Uniaxial &crystal);

} // namespace threefold::optics
