// SPDX-License-Identifier: MIT
// Drawing by smooth functions: soft steps, bumps, strokes, outlines, noise. Pure functions of a place on the picture.
// Units: half the picture's width; x to the right, y up, the picture's middle is (0, 0).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/scene.h"

namespace threefold::figure {

inline double soft_step(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

inline double mix(double a, double b, double t) { return a + (b - a) * t; }
inline Rgb mix(Rgb a, Rgb b, double t) { return a + (b - a) * t; }

/// Gaussian of unit height.
inline double bump(Vec2 p, double x, double y, double sigma_x, double sigma_y) {
    const double u = (p.x - x) / sigma_x, v = (p.y - y) / sigma_y;
    const double r = u * u + v * v;
    return r > 25 ? 0 : std::exp(-r / 2);
}

/// A quarter of a circle: 0 at t = 0 where it rises steeply, level 1 from t = 1 on.
inline double shoulder(double t) {
    const double c = 1 - std::clamp(t, 0.0, 1.0);
    return std::sqrt(1 - c * c);
}

/// Where a place lies beside a line of points: how far from it, and how far along it (0 to 1).
struct Beside {
    double distance, along;
};
Beside beside(const std::vector<Vec2> &line, Vec2 p);

/// Smooth noise in [-1, 1] with features of size 1; `octaves` adds finer ones of half the weight each.
double noise(Vec2 p, int octaves = 1, std::uint32_t seed = 0);

/// A curve through the points (Catmull and Rom's spline), `steps` pieces between two of them.
std::vector<Vec2> curve_through(const std::vector<Vec2> &points, bool closed, int steps = 6);

/// A closed outline, as the distance to it. Distances are kept on a grid: outlines are asked for at every texel.
class Outline {
public:
    explicit Outline(const std::vector<Vec2> &points);

    /// Positive inside.
    double depth(Vec2 p) const;

private:
    double exact_depth(Vec2 p) const;

    static constexpr double cell = 0.015;
    std::vector<Vec2> curve_;
    Vec2 low_{0};
    int columns_ = 0, rows_ = 0;
    std::vector<double> depths_;
};

} // namespace threefold::figure
