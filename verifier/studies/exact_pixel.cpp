// SPDX-License-Identifier: MIT
#include "verifier/studies/exact_pixel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <boost/math/constants/constants.hpp>

#include "scenes/error.h"
#include "verifier/optics/deflection.h"
#include "verifier/optics/quad.h"

namespace threefold {

namespace {

using Real = optics::Quad;

struct V {
    Real x, y, z;
};
V operator+(const V &a, const V &b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
V operator-(const V &a, const V &b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
V operator*(const Real &s, const V &v) { return {s * v.x, s * v.y, s * v.z}; }
Real dot(const V &a, const V &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
V cross(const V &a, const V &b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Real length(const V &v) { return sqrt(dot(v, v)); }
V unit(const V &v) { return (1 / length(v)) * v; }

/// Every number that the scene gives.
enum Input {
    eye = 0,
    target = 3,
    up = 6,
    view = 9,
    centre = 10,
    outer = 13,
    wall = 14,
    index = 15,
    card = 16,
    half_u = 19,
    half_v = 22,
    inputs = 25
};
using Inputs = std::array<Real, inputs>;

V vector_at(const Inputs &x, int first) {
    const auto i = static_cast<std::size_t>(first);
    return {x[i], x[i + 1], x[i + 2]};
}

struct Setting {
    Inputs given;
    bool solid = false, perspective = true;
    Real right_px, down_px; ///< of the pixel's sample from the middle of the film
    int width_px = 1;
};

void put(Inputs &x, int first, Vec3 v) {
    for (int k = 0; k < 3; ++k) x[static_cast<std::size_t>(first + k)] = v[k];
}

Setting setting_of(const Scene &scene, int column, int row) {
    Setting s;
    const Camera &camera = scene.camera;
    put(s.given, eye, camera.eye_mm);
    put(s.given, target, camera.target_mm);
    put(s.given, up, camera.up);
    s.perspective = camera.projection == Projection::perspective;
    s.given[view] = s.perspective ? camera.horizontal_fov_deg : camera.orthographic_width_mm;
    s.width_px = camera.width_px;
    const Vec2 corner = camera.crop ? Vec2(camera.crop->x_px, camera.crop->y_px) : Vec2(0);
    s.right_px = Real(corner.x + column + 0.5) + camera.film_offset_px.x - Real(camera.width_px) / 2;
    s.down_px = Real(corner.y + row + 0.5) + camera.film_offset_px.y - Real(camera.height_px) / 2;
    int orbs = 0, cards = 0;
    const auto orb = [&](Vec3 centre_mm, double outer_mm, double wall_mm, const Glass &glass) {
        ++orbs;
        put(s.given, centre, centre_mm);
        s.given[outer] = outer_mm;
        s.given[wall] = wall_mm;
        s.given[index] = glass.index;
    };
    for (const Object &object : scene.objects)
        std::visit(overloaded{[&](const GlassBall &b) {
                                  s.solid = true;
                                  orb(b.centre_mm, b.radius_mm, b.radius_mm, b.glass);
                              },
                              [&](const GlassShell &b) { orb(b.centre_mm, b.outer_radius_mm, b.wall_mm, b.glass); },
                              [&](const Quad &q) {
                                  ++cards;
                                  put(s.given, card, q.centre_mm);
                                  put(s.given, half_u, q.half_u_mm);
                                  put(s.given, half_v, q.half_v_mm);
                              },
                              [](const Mesh &) { throw Error(Exit::internal, "exact_pixel knows no meshes"); }},
                   object.shape);
    if (orbs != 1 || cards != 1) throw Error(Exit::internal, "exact_pixel wants one orb and one card");
    // Exact in quad; what a place far from the origin loses in the numbers of the scene is no matter of the renderer.
    for (std::size_t k = 0; k < 3; ++k) {
        for (const Input place : {eye, target, card}) s.given[place + k] -= s.given[centre + k];
        s.given[centre + k] = 0;
    }
    return s;
}

struct RayQ {
    V origin, direction;
};

RayQ camera_ray(const Setting &s, const Inputs &x) {
    const V from = vector_at(x, eye), forward = unit(vector_at(x, target) - from);
    const V right = unit(cross(forward, vector_at(x, up))), above = cross(right, forward);
    const Real pi = boost::math::constants::pi<Real>();
    const Real width = s.perspective ? Real(2 * tan(x[view] * pi / 360)) : x[view];
    const V aside = (width / s.width_px) * (s.right_px * right - s.down_px * above);
    if (s.perspective) return {from, unit(forward + aside)};
    return {from + aside, forward};
}

/// Of a ray's line and the orb, relative to its centre.
struct Meeting {
    V foot, away; ///< nearest point of the line, and the unit vector to it
    Real impact, along;
    bool meets;
};

Meeting meeting(const RayQ &ray, const Inputs &x) {
    const V to_centre = vector_at(x, centre) - ray.origin;
    Meeting m;
    m.along = dot(to_centre, ray.direction);
    m.foot = m.along * ray.direction - to_centre;
    m.impact = length(m.foot);
    m.away = m.impact > 0 ? (1 / m.impact) * m.foot : V{0, 0, 0};
    m.meets = m.along > 0 && m.impact < x[outer];
    return m;
}

struct Landing {
    Real u_mm, v_mm; ///< from the card's centre along its sides
};

std::optional<Landing> land(const RayQ &ray, const Inputs &x) {
    const V u = vector_at(x, half_u), v = vector_at(x, half_v), normal = cross(u, v);
    const Real distance = dot(vector_at(x, card) - ray.origin, normal) / dot(ray.direction, normal);
    if (!(distance >= 0) || !isfinite(distance)) return std::nullopt;
    const V on = ray.origin + distance * ray.direction - vector_at(x, card);
    return Landing{dot(on, unit(u)), dot(on, unit(v))};
}

/// By the closed forms: the orb turns the whole line about its centre.
std::optional<RayQ> leaving_by_turn(const Setting &s, const RayQ &ray, const Meeting &m, const Inputs &x) {
    const optics::Orb<Real> orb{x[outer], s.solid ? Real(0) : Real(x[outer] - x[wall]), x[wall], x[index]};
    const optics::Impact<Real> impact = optics::impact_at(orb, m.impact);
    auto turn = optics::deflection(orb, impact);
    if (!turn) turn = optics::rim_deflection(orb, impact);
    if (!turn) return std::nullopt;
    const Real c = cos(*turn), sine = sin(*turn);
    const V direction = c * ray.direction - sine * m.away;
    const V foot = m.impact * (c * m.away + sine * ray.direction);
    const Real half_chord = optics::outer_chords(orb, impact).air_mm;
    return RayQ{vector_at(x, centre) + foot + half_chord * direction, direction};
}

/// Bends or, beyond the critical angle, mirrors a direction at a point of a sphere about the origin.
bool bend(V &direction, const V &normal_out, const Real &from, const Real &to) {
    Real cosine = dot(direction, normal_out);
    const V normal = cosine > 0 ? normal_out : Real(-1) * normal_out; // along the ray
    cosine = abs(cosine);
    const Real ratio = from / to, radicand = 1 - ratio * ratio * (1 - cosine) * (1 + cosine);
    if (radicand < 0) {
        direction = direction - 2 * cosine * normal;
        return false;
    }
    direction = ratio * direction + (sqrt(radicand) - ratio * cosine) * normal;
    return true;
}

/// By Snell's law at each surface.
std::optional<RayQ> leaving_by_snell(const Setting &s, const RayQ &ray, const Meeting &m, const Inputs &x) {
    const Real R = x[outer], r = s.solid ? Real(0) : Real(R - x[wall]), n = x[index];
    V at = m.foot - sqrt((R - m.impact) * (R + m.impact)) * ray.direction, direction = ray.direction;
    bend(direction, (1 / R) * at, 1, n);
    // Half of what a line through `at` cuts from the sphere of this radius, if it meets it ahead.
    const auto chord = [&](const Real &radius) -> std::optional<Real> {
        const V foot = at - dot(at, direction) * direction;
        const Real b = length(foot);
        if (!(b < radius)) return std::nullopt;
        return Real(sqrt((radius - b) * (radius + b)));
    };
    if (r > 0)
        if (const auto inner = chord(r)) {
            at = at + (-dot(at, direction) - *inner) * direction;
            if (bend(direction, (1 / r) * at, n, 1)) {
                const auto across = chord(r);
                if (!across) return std::nullopt;
                at = at + 2 * *across * direction;
                bend(direction, (1 / r) * at, 1, n);
            }
        }
    const auto out = chord(R);
    if (!out) return std::nullopt;
    at = at + (-dot(at, direction) + *out) * direction;
    if (!bend(direction, (1 / R) * at, n, 1)) return std::nullopt;
    return RayQ{vector_at(x, centre) + at, direction};
}

/// What is moved to see what depends on it.
struct Answer {
    std::optional<Landing> landing;
    Real impact;
};

Answer answer(const Setting &s, const Inputs &x) {
    const RayQ ray = camera_ray(s, x);
    const Meeting m = meeting(ray, x);
    if (!m.meets) return {land(ray, x), m.impact};
    const auto out = leaving_by_snell(s, ray, m, x);
    return {out ? land(*out, x) : std::nullopt, m.impact};
}

double moved(const Answer &from, const Answer &to) {
    if (!from.landing || !to.landing) return 0;
    const Real u = to.landing->u_mm - from.landing->u_mm, v = to.landing->v_mm - from.landing->v_mm;
    return static_cast<double>(Real(sqrt(u * u + v * v)));
}

double edge_distance(const Setting &s, const Real &impact) {
    const Real R = s.given[outer], r = R - s.given[wall];
    Real least = abs(Real(impact - R));
    if (!s.solid) {
        least = std::min(least, Real(abs(Real(impact - r))));
        least = std::min(least, Real(abs(Real(impact - s.given[index] * r))));
    }
    return static_cast<double>(least);
}

/// Small beside every gap that a double can tell, large beside quad's own rounding.
constexpr double relative_step = 1e-24;

} // namespace

ExactPixel exact_pixel(const Scene &scene, int column, int row) {
    const Setting s = setting_of(scene, column, row);
    const Inputs &x = s.given;
    const RayQ ray = camera_ray(s, x);
    const Meeting m = meeting(ray, x);
    const std::optional<RayQ> out = m.meets ? leaving_by_turn(s, ray, m, x) : std::optional(ray);
    const std::optional<Landing> landing = out ? land(*out, x) : std::nullopt;

    ExactPixel p;
    p.impact_mm = static_cast<double>(m.impact);
    p.to_edge_mm = edge_distance(s, m.impact);
    p.lands = landing.has_value();
    const Answer here = answer(s, x);
    p.disagreement_mm = moved({landing, m.impact}, here);
    if (landing.has_value() != here.landing.has_value()) p.disagreement_mm = std::numeric_limits<double>::infinity();
    if (landing)
        p.uv = {static_cast<double>(Real((1 + landing->u_mm / length(vector_at(x, half_u))) / 2)),
                static_cast<double>(Real((1 + landing->v_mm / length(vector_at(x, half_v))) / 2))};

    const auto change = [&](const Setting &other, const Real &step) {
        const Answer there = answer(other, other.given);
        return std::pair(moved(here, there) / static_cast<double>(step),
                         static_cast<double>(Real(abs(Real(there.impact - here.impact)) / step)));
    };
    const Real h = relative_step;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (x[i] == 0 || (s.solid && i == wall)) continue;
        Setting other = s;
        other.given[i] *= 1 + h;
        const auto [by, impact_by] = change(other, h);
        p.condition_mm += by;
        p.impact_condition_mm += impact_by;
    }
    const Real step_mm = h * x[outer];
    double squares = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        Setting other = s;
        other.given[centre + k] += step_mm;
        const double by = change(other, step_mm).first;
        squares += by * by;
    }
    p.per_shift = std::sqrt(squares);
    Setting other = s;
    other.given[outer] += step_mm;
    if (!s.solid) other.given[wall] += step_mm;
    p.per_outer = change(other, step_mm).first;
    if (!s.solid) {
        other = s;
        other.given[wall] += step_mm;
        p.per_inner = change(other, step_mm).first;
    }
    for (Real Setting::*axis : {&Setting::right_px, &Setting::down_px}) {
        other = s;
        other.*axis += h;
        const auto [by, impact_by] = change(other, h);
        p.per_pixel_mm = std::hypot(p.per_pixel_mm, by);
        p.impact_per_pixel_mm = std::hypot(p.impact_per_pixel_mm, impact_by);
    }
    return p;
}

} // namespace threefold
