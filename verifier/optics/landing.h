// SPDX-License-Identifier: MIT
// Where a pinhole's ray lands on a plane behind the orb. Eye, centre and the plane's foot lie on one axis; the plane is
// perpendicular to it. eye_mm and plane_mm are their distances from the centre. The height is that of the outgoing
// line: it has no other meaning where the plane cuts the orb.
#pragma once

#include <optional>

#include "verifier/optics/deflection.h"

namespace threefold::optics {

/// A steeper outgoing ray (above 87.1 degrees to the axis) has no landing: it meets the plane far away or never, and
/// its height is all rounding.
inline constexpr double least_landing_cosine = 0.05;

/// The ray's angle to the axis at the eye, for b < eye.
template <class T>
T eye_angle(T b_mm, T eye_mm) {
    using std::atan2, std::sqrt;
    return atan2(b_mm, T(sqrt((eye_mm - b_mm) * (eye_mm + b_mm))));
}

/// Height of the straight ray that an orb absent would leave.
template <class T>
T straight_landing(T b_mm, T eye_mm, T plane_mm) {
    using std::sqrt;
    return (eye_mm + plane_mm) * b_mm / sqrt((eye_mm - b_mm) * (eye_mm + b_mm));
}

/// Height of a ray of impact b that was turned by t: the orb turns the line about the centre, so the outgoing line has
/// the distance b again and meets the plane at (b + plane sin a) / cos a, a = eye angle - t.
template <class T>
std::optional<T> landing_after_turn(T b_mm, T turn_rad, T eye_mm, T plane_mm) {
    using std::sin, std::cos;
    const T a = eye_angle(b_mm, eye_mm) - turn_rad;
    const T cosine = cos(a);
    if (!(cosine > T(least_landing_cosine))) return std::nullopt;
    return (b_mm + plane_mm * sin(a)) / cosine;
}

/// Height of the ray that goes straight through; nothing where there is none, or where it leaves too steeply.
template <class T>
std::optional<T> landing(const Orb<T> &orb, const Impact<T> &impact, T eye_mm, T plane_mm) {
    const std::optional<T> turn = deflection(orb, impact);
    if (!turn) return std::nullopt;
    return landing_after_turn(impact.b_mm, *turn, eye_mm, plane_mm);
}

} // namespace threefold::optics
