// SPDX-License-Identifier: MIT
// The ray that an orb sends on, in space: straight through, or by the rim. World frame, millimetres.
#pragma once

#include <optional>

#include "scenes/camera.h"
#include "verifier/optics/orb.h"

namespace threefold::optics {

/// The refracted ray from the point where it leaves the orb. Nothing where the ray starts inside the orb, misses it or
/// is totally reflected. Good to 1e-13 R where the ray itself is known so well and does not graze a surface.
std::optional<Ray> transmitted_ray(const Orb<double> &orb, Vec3 centre_mm, const Ray &ray);

/// The same for an orb whose surfaces reflect only totally: a ray that cannot enter the hollow leaves after one
/// reflection there.
std::optional<Ray> coated_ray(const Orb<double> &orb, Vec3 centre_mm, const Ray &ray);

/// Where the ray meets the plane through `point_mm`; nothing when it runs along the plane or away from it. The normal
/// has any length and either sign.
std::optional<Vec3> landing_on_plane(const Ray &ray, Vec3 point_mm, Vec3 normal);

} // namespace threefold::optics
