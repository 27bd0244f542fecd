// SPDX-License-Identifier: MIT
// The blessing hand, and the sleeve's pale lining under it.
#include "scenes/figure/painting.h"

namespace threefold::figure {

namespace {

constexpr Rgb hand_skin{0.44, 0.285, 0.135}, hand_shadow{0.085, 0.038, 0.014}, linen{0.34, 0.31, 0.25},
    linen_dark{0.05, 0.042, 0.034};

/// A finger or a limb: round, along a line of points, its radius changing from end to end.
struct Limb {
    std::vector<Vec2> line;
    double radius_from, radius_to, lift; ///< `lift`: height of its axis
    double shade;                        ///< how far it lies in the dark
};

void lay(const Limb &limb, Vec2 p, Spot &spot) {
    const Beside here = beside(limb.line, p);
    const double radius = mix(limb.radius_from, limb.radius_to, here.along), t = here.distance / radius;
    if (t > 1.5) return;
    // The dark line between fingers.
    spot.colour *= 1 - 0.55 * soft_step(1.45, 0.95, t);
    const double round = std::sqrt(std::max(0.0, 1 - t * t));
    Rgb colour = mix(hand_skin, hand_shadow, std::clamp(limb.shade + 0.75 * (1 - round), 0.0, 1.0));
    colour = mix(colour, Rgb(0.50, 0.26, 0.14), 0.25 * soft_step(0.8, 1.0, here.along));
    spot.cover(soft_step(1.03, 0.94, t), limb.lift + 0.9 * radius * round, colour);
}

std::vector<Limb> limbs() {
    const auto line = [](std::initializer_list<Vec2> points) {
        std::vector<Vec2> places;
        for (const Vec2 p : points) places.push_back(sketch(p.x, p.y));
        return curve_through(places, false, 4);
    };
    return {
        {line({{100, 1010}, {102, 950}, {110, 880}, {118, 810}}), 0.112, 0.128, 0.035, 0.25}, // wrist
        {line({{122, 890}, {118, 830}, {108, 780}}), 0.128, 0.138, 0.045, 0.05},              // palm
        {line({{150, 850}, {172, 800}, {164, 745}, {151, 700}}), 0.085, 0.046, 0.050, 0.18},  // thumb
        {line({{100, 790}, {92, 720}, {104, 650}, {122, 590}}), 0.072, 0.040, 0.050, 0.25},   // middle finger
        {line({{72, 790}, {72, 715}, {88, 655}, {124, 603}}), 0.075, 0.036, 0.075, 0.0},      // index
        {line({{108, 745}, {148, 752}, {152, 795}}), 0.064, 0.048, 0.085, 0.10},              // ring, folded
        {line({{70, 770}, {108, 768}, {130, 800}, {126, 822}}), 0.066, 0.042, 0.105, 0.0},    // little, folded
    };
}

} // namespace

void Painting::paint_sleeve(Vec2 p, Spot &spot) const {
    const double depth = cuff_.depth(p);
    if (depth < -0.02) return;
    const Vec2 q = p - sketch(-70, 985);
    const double turn = std::atan2(q.y, q.x), r = glm::length(q);
    const double ridge = std::sin(34 * r + 5 * turn + 2.5 * noise(p * 5.0, 2, 60));
    const double light = std::clamp(0.45 + 0.45 * ridge + 0.3 * noise(p * 18.0, 3, 61), 0.0, 1.0);
    spot.cover(soft_step(-0.008, 0.008, depth), 0.07 + 0.09 * shoulder(depth / 0.12) + 0.018 * ridge,
               mix(linen_dark, linen, light * light));
}

void Painting::paint_blessing_hand(Vec2 p, Spot &spot) const {
    static const std::vector<Limb> all = limbs();
    if (p.x > -0.55 || p.y < -1.0 || p.y > 0.3) return;
    for (const Limb &limb : all) lay(limb, p, spot);
}

} // namespace threefold::figure
