// SPDX-License-Identifier: MIT
#include "scenes/figure/drawing.h"

#include <limits>

namespace threefold::figure {

Beside beside(const std::vector<Vec2> &line, Vec2 p) {
    Beside best{std::numeric_limits<double>::infinity(), 0};
    const double pieces = static_cast<double>(line.size() - 1);
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec2 d = line[i + 1] - line[i];
        const double t = std::clamp(glm::dot(p - line[i], d) / glm::dot(d, d), 0.0, 1.0);
        const double distance = glm::length(p - line[i] - t * d);
        if (distance < best.distance) best = {distance, (static_cast<double>(i) + t) / pieces};
    }
    return best;
}

namespace {

double lattice(std::int64_t x, std::int64_t y, std::uint32_t seed) {
    auto h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^ static_cast<std::uint32_t>(y) * 0xd8163841u ^
             seed * 0xcb1ab31fu;
    h = (h ^ (h >> 13)) * 0x5bd1e995u;
    h = (h ^ (h >> 15)) * 0x27d4eb2fu;
    return static_cast<double>(h ^ (h >> 16)) / 2147483647.5 - 1;
}

double smooth_noise(Vec2 p, std::uint32_t seed) {
    const double fx = std::floor(p.x), fy = std::floor(p.y);
    const auto x = static_cast<std::int64_t>(fx), y = static_cast<std::int64_t>(fy);
    const double u = soft_step(0, 1, p.x - fx), v = soft_step(0, 1, p.y - fy);
    return mix(mix(lattice(x, y, seed), lattice(x + 1, y, seed), u),
               mix(lattice(x, y + 1, seed), lattice(x + 1, y + 1, seed), u), v);
}

} // namespace

double noise(Vec2 p, int octaves, std::uint32_t seed) {
    double sum = 0, weight = 1, total = 0;
    for (int i = 0; i < octaves; ++i) {
        sum += weight * smooth_noise(p, seed + static_cast<std::uint32_t>(i));
        total += weight;
        weight /= 2;
        p = Vec2(1.6 * p.x - 1.2 * p.y, 1.2 * p.x + 1.6 * p.y); // turned, so that lattices do not line up
    }
    return sum / total;
}

std::vector<Vec2> curve_through(const std::vector<Vec2> &points, bool closed, int steps) {
    const auto n = static_cast<int>(points.size());
    const auto at = [&](int i) {
        return points[static_cast<std::size_t>(closed ? (i + n) % n : std::clamp(i, 0, n - 1))];
    };
    std::vector<Vec2> curve;
    for (int i = 0; i < (closed ? n : n - 1); ++i)
        for (int k = 0; k < steps; ++k) {
            const double t = static_cast<double>(k) / steps;
            const Vec2 a = at(i - 1), b = at(i), c = at(i + 1), d = at(i + 2);
            curve.push_back(b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a))));
        }
    curve.push_back(closed ? curve.front() : points.back());
    return curve;
}

Outline::Outline(const std::vector<Vec2> &points)
    : curve_(curve_through(points, true)) {
    Vec2 high = low_ = curve_.front();
    for (const Vec2 p : curve_) {
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    low_ -= Vec2(2 * cell);
    columns_ = static_cast<int>((high.x - low_.x) / cell) + 4;
    rows_ = static_cast<int>((high.y - low_.y) / cell) + 4;
    depths_.reserve(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (int row = 0; row < rows_; ++row)
        for (int column = 0; column < columns_; ++column)
            depths_.push_back(exact_depth(low_ + cell * Vec2(column, row)));
}

double Outline::exact_depth(Vec2 p) const {
    bool inside = false;
    for (std::size_t i = 0; i + 1 < curve_.size(); ++i) {
        const Vec2 a = curve_[i], b = curve_[i + 1];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
    const double distance = beside(curve_, p).distance;
    return inside ? distance : -distance;
}

double Outline::depth(Vec2 p) const {
    const Vec2 g = (p - low_) / cell;
    if (!(g.x >= 0 && g.y >= 0 && g.x < columns_ - 1 && g.y < rows_ - 1)) return -1;
    const auto x = static_cast<int>(g.x), y = static_cast<int>(g.y);
    const auto at = [&](int column, int row) {
        return depths_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                       static_cast<std::size_t>(column)];
    };
    return mix(mix(at(x, y), at(x + 1, y), g.x - x), mix(at(x, y + 1), at(x + 1, y + 1), g.x - x), g.y - y);
}

} // namespace threefold::figure
