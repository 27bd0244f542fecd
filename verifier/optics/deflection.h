// SPDX-License-Identifier: MIT
// By how much an orb turns a ray, from Bouguer's invariant. Lengths in millimetres, angles in radians, positive towards
// the axis. Textbooks write sums of inverse sines; those cancel for thin walls, small b and n near 1. Here every angle
// is an atan2 whose sine is a product of positive terms, so that double keeps its digits throughout.
#pragma once

#include <optional>

#include "verifier/optics/orb.h"

namespace threefold::optics {

/// asin(b/R) - asin(b/(n R)): the turn at the outer surface. Valid for 0 <= b <= R.
template <class T>
T turn_at_outer(const Orb<T> &orb, const Impact<T> &impact) {
    using std::atan2;
    if (orb.index == 1) return T(0);
    const auto [air, glass] = outer_chords(orb, impact);
    const T n = orb.index, b = impact.b_mm, glass_b = b / n;
    const T sine = glass_b * (n - 1) * (n + 1) / (n * glass + air);
    const T cosine = (air * glass + b * glass_b) / (orb.outer_mm * orb.outer_mm);
    return atan2(sine, cosine);
}

/// asin(b/(n r)) - asin(b/(n R)): the angle about the centre of one crossing of the wall. Valid for b <= n r.
template <class T>
T wall_angle(const Orb<T> &orb, const Impact<T> &impact) {
    using std::atan2;
    const T outer = outer_chords(orb, impact).glass_mm, inner = inner_chords(orb, impact).glass_mm;
    const T glass_b = impact.b_mm / orb.index;
    return atan2(T(glass_b * orb.wall_mm * (orb.outer_mm + orb.inner_mm) / (outer + inner)),
                 T(outer * inner + glass_b * glass_b));
}

/// What the wall alone turns, outwards, at one crossing: [asin(b/r) - asin(b/R)] - [asin(b/(n r)) - asin(b/(n R))].
/// Valid for b < r. With P, p the half chords in air and Q, q in glass (outer, inner) and g = b/n, the sine is
/// g (n-1) (R^2-r^2) {R^2 q + r^2 Q + (n+1) g^2 [R^2/(p+q) + r^2/(P+Q)]} / {(R r)^2 (P+p) (Q+q)}: no term is negative.
template <class T>
T wall_turn(const Orb<T> &orb, const Impact<T> &impact) {
    using std::atan2;
    if (orb.index == 1 || impact.b_mm == 0) return T(0);
    const T n = orb.index, b = impact.b_mm, g = b / n;
    const T R2 = orb.outer_mm * orb.outer_mm, r2 = orb.inner_mm * orb.inner_mm;
    const auto [P, Q] = outer_chords(orb, impact);
    const auto [p, q] = inner_chords(orb, impact);
    const T squares = orb.wall_mm * (orb.outer_mm + orb.inner_mm);
    const T sine_air = b * squares / (P + p), cosine_air = P * p + b * b;
    const T sine_glass = g * squares / (Q + q), cosine_glass = Q * q + g * g;
    const T sum = R2 * q + r2 * Q + (n + 1) * g * g * (R2 / (p + q) + r2 / (P + Q));
    return atan2(T(g * (n - 1) * squares * sum / ((P + p) * (Q + q))),
                 T(cosine_air * cosine_glass + sine_air * sine_glass));
}

/// Turn of the ray that goes straight through; nothing where it misses or is totally reflected at the inner wall.
template <class T>
std::optional<T> deflection(const Orb<T> &orb, const Impact<T> &impact) {
    switch (course(orb, impact)) {
    case Course::through_glass:
        return 2 * turn_at_outer(orb, impact);
    case Course::through_hollow:
        return T(0) - 2 * wall_turn(orb, impact); // on the axis 0, not -0
    case Course::misses:
    case Course::totally_reflected:
        break;
    }
    return std::nullopt;
}

/// Turn of the ray that is totally reflected once at the inner wall: 2 (wall angle - acos(b/R)), r <= b < min(R, n r).
template <class T>
std::optional<T> rim_deflection(const Orb<T> &orb, const Impact<T> &impact) {
    using std::atan2;
    if (course(orb, impact) != Course::totally_reflected) return std::nullopt;
    return 2 * (wall_angle(orb, impact) - atan2(outer_chords(orb, impact).air_mm, impact.b_mm));
}

} // namespace threefold::optics
