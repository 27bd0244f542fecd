// SPDX-License-Identifier: MIT
// How much light an interface, and the straight path through an orb, lets through: shares of power, without absorption.
// Fresnel's equations (Born & Wolf 1.5.2), for transparent media and a plane wave at each interface.
#pragma once

#include <cmath>
#include <optional>

#include "verifier/optics/orb.h"

namespace threefold::optics {

/// Shares of power for the field across (s) and in (p) the plane of incidence. The same from both sides.
template <class T>
struct Fresnel {
    T reflectance_s, reflectance_p, transmittance_s, transmittance_p;

    /// Of unpolarised light.
    T reflectance() const { return (reflectance_s + reflectance_p) / 2; }
    T transmittance() const { return (transmittance_s + transmittance_p) / 2; }
};

/// From both cosines, which are better known than the sine near grazing. 1 - R and differences of cosines would cancel:
/// n1 c1 - n2 c2 is (n1^2 - n2^2) / (n1 c1 + n2 c2) by Snell, and n2 c1 - n1 c2 has the factor c1^2 + c2^2 - 1, whose
/// zero is Brewster's angle.
template <class T>
Fresnel<T> fresnel_at_cosines(T n1, T c1, T n2, T c2) {
    if (n1 == n2) return {T(0), T(0), T(1), T(1)};
    const T s = n1 * c1 + n2 * c2, p = n2 * c1 + n1 * c2;
    const T squares = (n2 - n1) * (n2 + n1), through = 4 * n1 * n2 * c1 * c2;
    const T rs = squares / (s * s), rp = squares * (c1 * c1 + c2 * c2 - 1) / (p * p);
    return {rs * rs, rp * rp, through / (s * s), through / (p * p)};
}

/// From the sine of incidence in medium n1, 0 to 1; all is reflected at and above the critical angle.
template <class T>
Fresnel<T> fresnel(T sine, T n1, T n2) {
    using std::sqrt;
    if (n1 == n2) return {T(0), T(0), T(1), T(1)};
    const T refracted = n1 * sine / n2;
    if (refracted >= 1) return {T(1), T(1), T(0), T(0)};
    return fresnel_at_cosines(n1, T(sqrt((1 - sine) * (1 + sine))), n2, T(sqrt((1 - refracted) * (1 + refracted))));
}

template <class T>
Fresnel<T> fresnel_outer(const Orb<T> &orb, const Impact<T> &impact) {
    const auto [air, glass] = outer_chords(orb, impact);
    return fresnel_at_cosines(T(1), T(air / orb.outer_mm), orb.index, T(glass / orb.outer_mm));
}

/// Of a shell's inner wall; all is reflected from b = r on.
template <class T>
Fresnel<T> fresnel_inner(const Orb<T> &orb, const Impact<T> &impact) {
    if (impact.below_inner_mm <= 0) return {T(1), T(1), T(0), T(0)};
    const auto [air, glass] = inner_chords(orb, impact);
    return fresnel_at_cosines(orb.index, T(glass / orb.inner_mm), T(1), T(air / orb.inner_mm));
}

/// Of the straight path, for unpolarised light. Every interface has the same plane of incidence, so s stays s and p
/// stays p: `polarised` is the truth. `unpolarised` averages anew at every interface, as renderers do.
template <class T>
struct PathTransmittance {
    T unpolarised, polarised;
};

template <class T>
std::optional<PathTransmittance<T>> path_transmittance(const Orb<T> &orb, const Impact<T> &impact) {
    const Course way = course(orb, impact);
    if (way == Course::misses || way == Course::totally_reflected) return std::nullopt;
    const Fresnel<T> outer = fresnel_outer(orb, impact);
    T mean = outer.transmittance(), s = outer.transmittance_s, p = outer.transmittance_p;
    if (way == Course::through_hollow) {
        const Fresnel<T> inner = fresnel_inner(orb, impact);
        mean *= inner.transmittance();
        s *= inner.transmittance_s;
        p *= inner.transmittance_p;
    }
    // The way out equals the way in.
    return PathTransmittance<T>{mean * mean, (s * s + p * p) / 2};
}

} // namespace threefold::optics
