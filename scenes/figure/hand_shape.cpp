// SPDX-License-Identifier: MIT
#include "scenes/figure/hand_shape.h"

#include <array>

#include "scenes/figure/drawing.h"
#include "scenes/figure/surface_net.h"

namespace threefold::figure {

namespace {

struct Knuckle {
    Vec3 centre;
    double radius;
};

using Chain = std::vector<Knuckle>;

/// Distance to a chain of balls and the cones between them (good to the slope of the cones).
double distance_to_chain(Vec3 p, const Chain &chain) {
    double least = 1e9;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const Vec3 a = chain[i].centre, d = chain[i + 1].centre - a;
        const double t = std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0);
        least = std::min(least, glm::length(p - a - t * d) - mix(chain[i].radius, chain[i + 1].radius, t));
    }
    return least;
}

/// Smooth minimum (Quilez): blends over `width`.
double blend(double a, double b, double width) {
    const double h = std::max(width - std::abs(a - b), 0.0) / width;
    return std::min(a, b) - h * h * width / 4;
}

/// A direction from the orb's centre: `tilt` from straight down, towards the azimuth (0: the eye, 90: image right).
Vec3 direction(double tilt_deg, double azimuth_deg) {
    const double t = tilt_deg * 3.141592653589793 / 180, a = azimuth_deg * 3.141592653589793 / 180;
    return {std::sin(t) * std::sin(a), -std::cos(t), std::sin(t) * std::cos(a)};
}

/// A finger that lies on the orb from its root to its tip: four joints, thickest at the root.
Chain finger(Vec3 root, Vec3 tip, double root_radius, double tip_radius) {
    Chain chain;
    constexpr int joints = 6;
    for (int i = 0; i <= joints; ++i) {
        const double t = static_cast<double>(i) / joints;
        const Vec3 way = glm::normalize(root * (1 - t) + tip * t);
        // Thicker at the joints, thinner between; the pad of the tip rests on the glass.
        const double radius = mix(root_radius, tip_radius, t) + 0.006 * std::cos(6 * 3.141592653589793 * t);
        const double bow = 0.05 * std::sin(3.141592653589793 * t);
        chain.push_back({way * (1 + 0.90 * radius + bow), radius});
    }
    return chain;
}

double body(Vec3 p) {
    static const std::array<Chain, 5> fingers{
        finger(direction(24, 100), direction(47, 20), 0.140, 0.098),   // index
        finger(direction(9, 60), direction(52, -22), 0.145, 0.100),    // middle
        finger(direction(14, -120), direction(56, -55), 0.138, 0.094), // ring
        finger(direction(30, -135), direction(61, -86), 0.120, 0.080), // little
        finger(direction(44, 150), direction(66, 84), 0.165, 0.108),   // thumb
    };
    static const Chain palm{
        {direction(8, 90) * 1.24, 0.21}, {direction(12, 180) * 1.27, 0.25}, {direction(36, 180) * 1.32, 0.30}};
    static const Chain ball_of_thumb{
        {direction(30, 120) * 1.19, 0.20}, {direction(46, 145) * 1.25, 0.27}, {direction(54, 165) * 1.30, 0.27}};
    static const Chain edge_of_hand{
        {direction(20, -110) * 1.17, 0.17}, {direction(42, -145) * 1.21, 0.22}, {direction(54, -165) * 1.27, 0.25}};
    static const Chain wrist{
        {direction(50, 180) * 1.42, 0.30}, {Vec3(0.05, -1.25, -1.75), 0.30}, {Vec3(0.10, -1.75, -2.35), 0.33}};
    double mass = blend(distance_to_chain(p, palm), distance_to_chain(p, ball_of_thumb), 0.14);
    mass = blend(mass, distance_to_chain(p, edge_of_hand), 0.14);
    mass = blend(mass, distance_to_chain(p, wrist), 0.20);
    double distance = 1e9;
    for (const Chain &f : fingers) distance = blend(distance, blend(mass, distance_to_chain(p, f), 0.09), 0.015);
    return distance;
}

/// The body without what the orb takes.
double skin(Vec3 p) { return std::max(body(p), 1 - glm::length(p)); }

} // namespace

Mesh make_hand_shape() { return surface_net(skin, hand_low, hand_high, 0.024); }

} // namespace threefold::figure
