// SPDX-License-Identifier: MIT
// What an orb does near its axis, in the limit b -> 0, and the radii that follow from total reflection. Lengths in
// millimetres from the orb's centre, where both principal planes of a ball and of a concentric shell lie.
#pragma once

#include <algorithm>
#include <optional>

#include "verifier/optics/orb.h"

namespace threefold::optics {

/// d(deflection)/db at b = 0, the reciprocal focal length: 2 (n-1)/n * (1/R - 1/r), the last term for a shell only.
template <class T>
T power_per_mm(const Orb<T> &orb) {
    const T bend = 2 * (orb.index - 1) / orb.index;
    if (orb.is_solid()) return bend / orb.outer_mm;
    return -bend * orb.wall_mm / (orb.outer_mm * orb.inner_mm);
}

/// Ball: n R / (2 (n-1)) > 0. Shell: negative, it is a weak diverging lens. Nothing when there is no power.
template <class T>
std::optional<T> focal_length(const Orb<T> &orb) {
    const T power = power_per_mm(orb);
    if (power == 0) return std::nullopt;
    return 1 / power;
}

/// d(landing)/d(straight landing) on the axis. Exact for b -> 0; negative: the orb shows the plane inverted.
template <class T>
T paraxial_slope(const Orb<T> &orb, T eye_mm, T plane_mm) {
    return 1 - power_per_mm(orb) * eye_mm * plane_mm / (eye_mm + plane_mm);
}

/// Size of the plane's image on the axis over its size without the orb. Nothing where one point fills the view.
template <class T>
std::optional<T> image_magnification(const Orb<T> &orb, T eye_mm, T plane_mm) {
    const T slope = paraxial_slope(orb, eye_mm, plane_mm);
    if (slope == 0) return std::nullopt;
    return 1 / slope;
}

/// The index above which a solid ball shows the plane inverted: n > 2f / (2f - R), 1/f = 1/eye + 1/plane. Nothing for
/// 2f <= R: no index does.
template <class T>
std::optional<T> critical_inversion_index(T outer_mm, T eye_mm, T plane_mm) {
    const T twice = 2 * eye_mm * plane_mm / (eye_mm + plane_mm);
    if (twice <= outer_mm) return std::nullopt;
    return twice / (twice - outer_mm);
}

/// The plane distance at which the inverted image of a solid ball is as large as the plane itself (slope -1); nearer
/// inverted planes are magnified, farther ones reduced. Nothing for an eye within two focal lengths: it magnifies all.
template <class T>
std::optional<T> plane_where_magnifying_ends(const Orb<T> &ball, T eye_mm) {
    const T rest = power_per_mm(ball) / 2 - 1 / eye_mm;
    if (!ball.is_solid() || rest <= 0) return std::nullopt;
    return 1 / rest;
}

/// R/n. In a shell with r > R/n every ray meets the inner wall. It is also the largest distance from the centre at
/// which light that entered from outside can travel in the glass.
template <class T>
T critical_radius(const Orb<T> &orb) {
    return orb.outer_mm / orb.index;
}

/// Width in b of the totally reflecting ring r <= b < min(R, n r). For r >= R/n it is the wall, whatever the index. For
/// r < R/n it is (n-1) r, and the outermost rays, n r <= b < R, pass through glass only.
template <class T>
T rim_width(const Orb<T> &orb) {
    using std::min;
    return min(orb.wall_mm, T((orb.index - 1) * orb.inner_mm));
}

} // namespace threefold::optics
