// SPDX-License-Identifier: MIT
// A ball or shell of glass as the tracer sees it: where a ray meets it, and every way in which its light leaves.
//
// A ray that enters a concentric orb stays in one plane through the centre and meets each sphere under one angle for
// ever. So it is traced in that plane: (e1, e2) are the radial and the tangential direction at the point of entry, and
// a point on a sphere is a turn. Snell and Fresnel are applied at each sphere; a segment turns the point
// by the angle that its two ends subtend. Two histories with equally many wall crossings and equally many crossings of
// the hollow end at the same point in the same direction: they are merged, and the number of states grows with the
// square of the depth instead of as a power of it.
// No epsilon: a ray knows the sphere it left, and what it can meet next follows from that.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "scenes/scene.h"

namespace threefold::tracer {

template <class Real>
using Vector = glm::vec<3, Real>;

template <class Real>
struct RayOf {
    Vector<Real> origin, direction; ///< direction of unit length
};

template <class Real>
struct Orb {
    Vector<Real> centre;
    Real outer = 1, inner = 0; ///< inner = 0: solid
    Real index = 1, interface_transmittance = 1;
    Coating coating = Coating::fresnel;
    // Deliberate defects (exporter/job.h) may change these three.
    Real hollow_index = 1;         ///< relative to the air outside
    Real inner_transmittance = 1;  ///< of the inner sphere; an honest orb has interface_transmittance there
    int most_interfaces = 1 << 30; ///< a path ends after it met so many spheres
};

/// The point where a ray from outside meets the orb, relative to its centre, and the ray's closest approach.
template <class Real>
struct Entry {
    Real distance;     ///< along the ray
    Real impact;       ///< distance of the ray's line from the centre
    Real depth;        ///< half of the chord that the line cuts from the outer sphere
    Vector<Real> foot; ///< from the centre to the nearest point of the line
};

/// False where the line passes by or the orb lies behind. The origin must be outside.
/// Haines et al., Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems (2019), ch. 7.
template <class Real>
bool intersect(const Orb<Real> &orb, const RayOf<Real> &ray, Entry<Real> &entry) {
    const Vector<Real> to_centre = orb.centre - ray.origin;
    const Real along = glm::dot(to_centre, ray.direction);
    if (along <= 0) return false;
    // From afar the difference leaves a rounding along the ray, as large as the distance: taken out by one more step.
    const Vector<Real> rough = along * ray.direction - to_centre;
    const Vector<Real> foot = rough - glm::dot(rough, ray.direction) * ray.direction;
    const Real impact = glm::length(foot);
    if (!(impact < orb.outer)) return false;
    const Real depth = std::sqrt((orb.outer - impact) * (orb.outer + impact));
    entry = {along - depth, impact, depth, foot};
    return true;
}

/// The shares of light at an interface; `transmitted` is accurate also where it is small.
template <class Real>
struct Split {
    Real reflected, transmitted;
};

/// Unpolarised Fresnel split by the sines and cosines of both angles; n1 on the side of the light. Valid below the
/// critical angle; by reversibility the same for the way back.
template <class Real>
Split<Real> fresnel(Real n1, Real cos1, Real n2, Real cos2) {
    const Real s = n1 * cos1 + n2 * cos2, p = n2 * cos1 + n1 * cos2;
    if (!(s > 0) || !(p > 0)) return {1, 0};
    const Real rs = (n1 * cos1 - n2 * cos2) / s, rp = (n2 * cos1 - n1 * cos2) / p;
    const Real t = 4 * n1 * n2 * cos1 * cos2;
    return {(rs * rs + rp * rp) / 2, t * (1 / (s * s) + 1 / (p * p)) / 2};
}

template <class Real>
struct Angle {
    Real sine, cosine;
    static Angle of_sine(Real s) { return {s, std::sqrt(std::max<Real>(0, (1 - s) * (1 + s)))}; }
};

/// A point on the unit circle, and the turn that leads to it: std::complex without its care for infinities.
template <class Real>
struct Turn {
    Real cosine = 1, sine = 0;

    friend Turn operator*(Turn a, Turn b) {
        return {a.cosine * b.cosine - a.sine * b.sine, a.cosine * b.sine + a.sine * b.cosine};
    }
};

/// How a tree of rays ends. `cut`: it is followed until the weight still inside is below this. `roulette`: branches
/// lighter than this survive at random, with their weight raised to it; 0: none.
template <class Real>
struct TreeEnd {
    Real cut = Real(1e-6);
    Real roulette = 0;
};

/// Scratch memory of one thread.
template <class Real>
struct TreeScratch {
    struct State {
        Turn<Real> at; ///< where on its sphere
        Real weight = 0;
    };
    /// One generation: `inward` leave the outer sphere into the glass, `outward` leave the inner sphere into the glass,
    /// `hollow` leave it into the hollow. Entry j has crossed the wall 2j (inward) or 2j + 1 times.
    struct Generation {
        std::vector<State> inward, outward, hollow;
        void grow(std::size_t n) {
            if (n <= inward.size()) return;
            inward.resize(n);
            outward.resize(n);
            hollow.resize(n);
        }
    };
    Generation now, next;
};

/// Follows all light of a ray that enters at `entry`. Calls `leave(origin relative to the centre, direction, weight)`
/// for each way out, the reflection at the front among them, and returns the weight that was dropped.
/// `random()` gives numbers in [0, 1); only asked with roulette.
template <class Real, class Leave, class Random>
Real trace_orb(const Orb<Real> &orb, const RayOf<Real> &ray, const Entry<Real> &entry, const TreeEnd<Real> &end,
               TreeScratch<Real> &scratch, Leave &&leave, Random &&random) {
    using State = typename TreeScratch<Real>::State;

    // The plane of incidence.
    const Real n = orb.index, tau = orb.interface_transmittance;
    const Real hollow_n = orb.hollow_index, inner_tau = orb.inner_transmittance;
    const Angle<Real> air{entry.impact / orb.outer, entry.depth / orb.outer};
    const Vector<Real> e1 = (entry.foot - entry.depth * ray.direction) / orb.outer;
    const Vector<Real> away = entry.impact > 0 ? entry.foot / entry.impact : Vector<Real>(0);
    const Vector<Real> e2 = air.cosine * away + air.sine * ray.direction; // unit unless the ray aims at the centre
    const auto point = [&](Turn<Real> at) { return at.cosine * e1 + at.sine * e2; };
    const auto exit = [&](Turn<Real> at, Real weight) {
        const Vector<Real> radial = point(at), tangential = point(Turn<Real>{-at.sine, at.cosine});
        leave(orb.outer * radial, air.cosine * radial + air.sine * tangential, weight);
    };

    const auto split = [&](Real n1, Angle<Real> a1, Real n2, Real sine2) -> Split<Real> {
        if (sine2 >= 1) return {1, 0};
        if (orb.coating == Coating::antireflective) return {0, 1};
        return fresnel(n1, a1.cosine, n2, Angle<Real>::of_sine(sine2).cosine);
    };

    // Outer sphere, from either side.
    const Angle<Real> glass = Angle<Real>::of_sine(air.sine / n);
    const Split<Real> outer = split(Real(1), air, n, glass.sine);
    if (outer.reflected > 0) {
        // The mirror image of the way in: as if it left where it came in.
        exit(Turn<Real>{}, outer.reflected);
    }
    const Real entered = outer.transmitted * tau;
    if (!(entered > 0)) return 0;

    const Real inner_sine = orb.inner > 0 ? orb.outer * glass.sine / orb.inner : Real(2);
    if (inner_sine >= 1) {
        // Solid, or glass so thick that the ray passes the hollow by: one chord after another.
        const Turn<Real> chord{2 * glass.sine * glass.sine - 1, 2 * glass.sine * glass.cosine}; // by pi - 2 theta
        Turn<Real> at;
        Real weight = entered;
        for (int met = 2; weight > end.cut && met <= orb.most_interfaces; ++met) {
            if (weight < end.roulette) {
                if (random() * end.roulette >= weight) return 0;
                weight = end.roulette;
            }
            at = at * chord;
            exit(at, weight * outer.transmitted * tau);
            weight *= outer.reflected;
        }
        return weight;
    }

    // Inner sphere, from either side; `wall` turns from the outer to the inner sphere or back.
    const Angle<Real> inside = Angle<Real>::of_sine(inner_sine);
    const Turn<Real> wall{inside.cosine * glass.cosine + inside.sine * glass.sine,
                          inside.sine * glass.cosine - inside.cosine * glass.sine};
    const Real hollow_sine = n * inside.sine / hollow_n;
    const Angle<Real> hollow = Angle<Real>::of_sine(std::min<Real>(1, hollow_sine));
    const Split<Real> inner = split(n, inside, hollow_n, hollow_sine);
    const Turn<Real> across{2 * hollow.sine * hollow.sine - 1, 2 * hollow.sine * hollow.cosine};

    // A generation is a list by wall crossings; all its states have met equally many spheres, so that equal wall
    // crossings mean equal crossings of the hollow.
    auto &now = scratch.now, &next = scratch.next;
    std::size_t from = 0, to = 1; // live entries
    now.grow(2);
    now.inward[0] = {Turn<Real>{}, entered};
    now.outward[0].weight = now.hollow[0].weight = 0;
    Real live = entered, dropped = 0;
    const Real negligible = end.cut * Real(1e-3);
    const auto survives = [&](State &state) {
        if (!(state.weight > 0)) return false;
        if (state.weight < end.roulette) {
            if (random() * end.roulette >= state.weight) return false;
            state.weight = end.roulette;
        } else if (state.weight < negligible) {
            dropped += state.weight;
            return false;
        }
        return true;
    };
    const auto arrive = [](State &state, Turn<Real> at, Real weight) {
        if (!(state.weight > 0)) state.at = at;
        state.weight += weight;
    };
    for (int met = 2; live > end.cut && from < to && met <= orb.most_interfaces; ++met) {
        next.grow(to + 1);
        for (std::size_t j = from; j <= to; ++j)
            next.inward[j].weight = next.outward[j].weight = next.hollow[j].weight = 0;
        live = 0;
        std::size_t first = to, last = from;
        const auto used = [&](std::size_t j, Real weight) {
            live += weight;
            first = std::min(first, j);
            last = std::max(last, j + 1);
        };
        for (std::size_t j = from; j < to; ++j) {
            if (State &s = now.inward[j]; survives(s)) {
                const Turn<Real> at = s.at * wall;
                if (inner.reflected > 0) arrive(next.outward[j], at, s.weight * inner.reflected);
                if (inner.transmitted > 0) arrive(next.hollow[j], at, s.weight * inner.transmitted * inner_tau);
                used(j, s.weight * (inner.reflected + inner.transmitted * inner_tau));
            }
            if (State &s = now.hollow[j]; survives(s)) {
                const Turn<Real> at = s.at * across;
                if (inner.reflected > 0) arrive(next.hollow[j], at, s.weight * inner.reflected);
                arrive(next.outward[j], at, s.weight * inner.transmitted * inner_tau);
                used(j, s.weight * (inner.reflected + inner.transmitted * inner_tau));
            }
            if (State &s = now.outward[j]; survives(s)) {
                const Turn<Real> at = s.at * wall;
                exit(at, s.weight * outer.transmitted * tau);
                if (outer.reflected > 0) {
                    arrive(next.inward[j + 1], at, s.weight * outer.reflected);
                    used(j + 1, s.weight * outer.reflected);
                }
            }
        }
        std::swap(now, next);
        now.grow(last + 1);
        from = first;
        to = last;
    }
    return dropped + live;
}

} // namespace threefold::tracer
