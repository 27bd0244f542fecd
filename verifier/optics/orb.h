// SPDX-License-Identifier: MIT
// A ball or a shell of glass in air, and a ray's impact parameter b: the distance of the ray's line from the centre.
// Bouguer (1729; Born & Wolf, Principles of Optics, 3.2): in concentric spheres index * distance from the centre *
// sin(angle to the radius) stays the same along a ray, so that b alone says what happens at every interface.
// Lengths in millimetres. T is double or Quad.
#pragma once

#include <cmath>

namespace threefold::optics {

/// The wall is carried beside the radii: the difference of two rounded radii would lose a thin wall.
template <class T>
struct Orb {
    T outer_mm;
    T inner_mm; ///< 0: solid
    T wall_mm;  ///< outer - inner, exactly as far as known
    T index;    ///< at least 1

    bool is_solid() const { return inner_mm == 0; }
};

template <class T>
Orb<T> solid_ball(T outer_mm, T index) {
    return {outer_mm, T(0), outer_mm, index};
}

template <class T>
Orb<T> shell(T outer_mm, T wall_mm, T index) {
    return {outer_mm, outer_mm - wall_mm, wall_mm, index};
}

/// The gaps are carried beside b: near grazing everything depends on them, and b rounded to T has lost them.
template <class T>
struct Impact {
    T b_mm;
    T below_outer_mm; ///< R - b
    T below_inner_mm; ///< r - b; of no meaning in a solid ball
};

/// For a b that is exact in T. (R - b) - wall keeps more of a small gap than inner - b, where inner is rounded already.
template <class T>
Impact<T> impact_at(const Orb<T> &orb, T b_mm) {
    const T below_outer = orb.outer_mm - b_mm;
    return {b_mm, below_outer, below_outer - orb.wall_mm};
}

/// Differences are formed in the finer type and rounded once.
template <class To, class From>
Orb<To> rounded(const Orb<From> &orb) {
    return {static_cast<To>(orb.outer_mm), static_cast<To>(orb.inner_mm), static_cast<To>(orb.wall_mm),
            static_cast<To>(orb.index)};
}

template <class To, class From>
Impact<To> rounded(const Impact<From> &impact) {
    return {static_cast<To>(impact.b_mm), static_cast<To>(impact.below_outer_mm),
            static_cast<To>(impact.below_inner_mm)};
}

/// What the light that enters at b does.
enum class Course {
    misses,            ///< b > R
    through_glass,     ///< a solid ball, or a shell so thick that the ray passes outside its hollow: n r <= b <= R
    through_hollow,    ///< b < r
    totally_reflected, ///< r <= b < n r: nothing enters the hollow
};

template <class T>
Course course(const Orb<T> &orb, const Impact<T> &impact) {
    if (impact.below_outer_mm < 0) return Course::misses;
    if (orb.is_solid()) return Course::through_glass;
    if (impact.below_inner_mm > 0) return Course::through_hollow;
    const bool meets_inner = (orb.index - 1) * orb.inner_mm + impact.below_inner_mm > 0;
    return meets_inner ? Course::totally_reflected : Course::through_glass;
}

/// Half of the chord that a line cuts from one sphere: in air at distance b from the centre, in glass at b / n.
/// Divided by the radius they are the cosines of the angles on the two sides. 0 where the line misses the sphere.
template <class T>
struct HalfChords {
    T air_mm, glass_mm;
};

template <class T>
HalfChords<T> half_chords(T radius_mm, T below_mm, T b_mm, T index) {
    using std::sqrt;
    const T glass_b = b_mm / index;
    const T below_glass = ((index - 1) * radius_mm + below_mm) / index;
    return {below_mm > 0 ? T(sqrt(below_mm * (radius_mm + b_mm))) : T(0),
            below_glass > 0 ? T(sqrt(below_glass * (radius_mm + glass_b))) : T(0)};
}

template <class T>
HalfChords<T> outer_chords(const Orb<T> &orb, const Impact<T> &impact) {
    return half_chords(orb.outer_mm, impact.below_outer_mm, impact.b_mm, orb.index);
}

template <class T>
HalfChords<T> inner_chords(const Orb<T> &orb, const Impact<T> &impact) {
    return half_chords(orb.inner_mm, impact.below_inner_mm, impact.b_mm, orb.index);
}

} // namespace threefold::optics
