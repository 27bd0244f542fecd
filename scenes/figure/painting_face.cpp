// SPDX-License-Identifier: MIT
// Face, hair, neck and chest.
#include <numbers>

#include "scenes/figure/painting.h"

namespace threefold::figure {

namespace {

constexpr Rgb skin{0.56, 0.40, 0.215}, skin_shadow{0.20, 0.105, 0.045}, lips{0.34, 0.15, 0.085};
constexpr Rgb hair_dark{0.022, 0.0105, 0.0045}, hair_light{0.20, 0.105, 0.042};
constexpr Rgb eye_white{0.34, 0.27, 0.17}, iris{0.055, 0.032, 0.016}, line_brown{0.05, 0.022, 0.010};

/// Mirrors the face about its axis: x from the axis, positive to the image's right.
constexpr double axis_x = -0.018;

struct Features {
    double relief = 0; ///< height above the face's mass
    Rgb colour = skin;

    void tint(double share, Rgb towards) { colour = mix(colour, towards, std::clamp(share, 0.0, 1.0)); }
};

void model_eye(Features &f, Vec2 q, double side) {
    const double x = 0.142 * side, y = 0.675;
    f.relief -= 0.026 * bump(q, x - 0.01 * side, y + 0.012, 0.075, 0.046);
    f.relief += 0.016 * bump(q, x, y - 0.004, 0.045, 0.026);
    f.tint(0.42 * bump(q, x - 0.012 * side, y + 0.03, 0.085, 0.034), skin_shadow);
    f.tint(0.30 * bump(q, x, y - 0.058, 0.07, 0.014), skin_shadow); // lower lid's bag
    // Lids: two arcs that meet in the corners; the eye is open between them, a little.
    const double u = (q.x - x) / 0.062;
    if (std::abs(u) < 1.25) {
        const double arc = 1 - u * u;
        const double upper = y + 0.021 * arc + 0.004 * u * side, lower = y - 0.018 * arc - 0.002;
        const double open = soft_step(-0.004, 0.004, upper - q.y) * soft_step(-0.004, 0.004, q.y - lower) *
                            soft_step(1.05, 0.95, std::abs(u));
        f.tint(open, eye_white);
        const double r = std::hypot((q.x - x) / 0.024, (q.y - y - 0.003) / 0.024);
        f.tint(open * soft_step(1.1, 0.85, r), iris);
        f.tint(open * soft_step(0.5, 0.35, r), Rgb(0.006));
        f.tint(open * bump(q, x - 0.010, y + 0.012, 0.0045, 0.0045), Rgb(0.75));
        f.tint(open * 0.6 * soft_step(0.012, 0.0, upper - q.y), line_brown); // the lid's shade on the eye
        const double ends = soft_step(1.22, 0.9, std::abs(u));
        f.tint(0.85 * ends * std::exp(-std::pow((q.y - upper) / 0.0065, 2)), line_brown);
        f.tint(0.55 * ends * std::exp(-std::pow((q.y - lower) / 0.005, 2)), line_brown);
        f.tint(0.55 * ends * std::exp(-std::pow((q.y - upper - 0.026) / 0.007, 2)), skin_shadow); // the lid's crease
    }
    // The brow, faint as in the sitter's time.
    const double v = (q.x - x) * side / 0.095;
    const double brow = 0.765 + 0.022 * (1 - v * v) - 0.008 * v;
    f.tint(0.40 * soft_step(1.15, 0.6, std::abs(v)) * std::exp(-std::pow((q.y - brow) / 0.016, 2)), line_brown);
    f.relief += 0.013 * bump(q, x, 0.775, 0.085, 0.035);
}

void model_nose(Features &f, Vec2 q) {
    const double down = std::clamp((0.76 - q.y) / 0.30, 0.0, 1.0); // 0 between the brows, 1 at the tip
    const double width = mix(0.026, 0.036, down);
    const double end = soft_step(0.448, 0.474, q.y) * soft_step(0.82, 0.74, q.y);
    f.relief += (0.020 + 0.052 * down * down) * end * std::exp(-std::pow(q.x / width, 2));
    f.relief += 0.020 * bump(q, 0, 0.486, 0.028, 0.022);
    for (const double side : {-1.0, 1.0}) {
        f.relief += 0.026 * bump(q, 0.047 * side, 0.480, 0.017, 0.020);
        f.tint(0.85 * bump(q, 0.027 * side, 0.4565, 0.014, 0.0065), line_brown);
        f.tint(0.45 * bump(q, 0.066 * side, 0.478, 0.007, 0.022), skin_shadow);
        f.tint((side > 0 ? 0.42 : 0.16) * bump(q, 0.050 * side, 0.60, 0.017, 0.095), skin_shadow);
    }
    f.tint(0.40 * bump(q, 0, 0.452, 0.040, 0.010), skin_shadow);
    f.tint(0.25 * bump(q, -0.006, 0.60, 0.012, 0.09), Rgb(0.8, 0.66, 0.45)); // light on its ridge
    f.tint(0.22 * bump(q, 0, 0.49, 0.03, 0.02), Rgb(0.62, 0.36, 0.2));
}

void model_mouth(Features &f, Vec2 q) {
    const double x = q.x / 0.098;
    const double line = 0.368 + 0.006 * x * x - 0.004 * std::exp(-std::pow(x / 0.22, 2));
    const double across = soft_step(1.05, 0.72, std::abs(x));
    const double bow = 0.020 * (1 - x * x) - 0.006 * std::exp(-std::pow(x / 0.16, 2)), full = 0.032 * (1 - x * x);
    const double upper = across * soft_step(-0.004, 0.004, q.y - line) * soft_step(0.006, -0.006, q.y - line - bow);
    const double lower = across * soft_step(-0.004, 0.004, line - q.y) * soft_step(0.008, -0.008, line - full - q.y);
    f.relief += 0.011 * bump(q, 0, 0.384, 0.06, 0.012) + 0.016 * bump(q, 0, 0.345, 0.050, 0.016);
    f.relief -= 0.008 * bump(q, 0, 0.312, 0.045, 0.014);
    f.tint(0.75 * upper, mix(lips, line_brown, 0.25));
    f.tint(0.60 * lower, lips);
    f.tint(0.90 * soft_step(1.22, 0.85, std::abs(x)) * std::exp(-std::pow((q.y - line) / 0.0062, 2)), line_brown);
    for (const double side : {-1.0, 1.0}) f.tint(0.5 * bump(q, 0.106 * side, 0.372, 0.014, 0.013), skin_shadow);
    f.tint(0.35 * bump(q, 0, 0.308, 0.050, 0.012), skin_shadow); // under the lower lip
    f.tint(0.16 * bump(q, 0, 0.415, 0.012, 0.020), skin_shadow); // between nose and mouth
}

} // namespace

void Painting::paint_face(Vec2 p, Spot &spot) const {
    const double depth = face_.depth(p);
    if (depth < -0.03) return;
    const Vec2 q(p.x - axis_x, p.y);
    Features f;
    f.relief = 0.010 * bump(q, 0, 0.90, 0.16, 0.10);
    for (const double side : {-1.0, 1.0}) {
        f.relief += 0.014 * bump(q, 0.155 * side, 0.575, 0.06, 0.05);
        f.relief -= 0.012 * bump(q, 0.135 * side, 0.43, 0.05, 0.06);
        f.tint(0.20 * bump(q, 0.155 * side, 0.52, 0.05, 0.06), Rgb(0.55, 0.29, 0.15)); // the cheek's red
        model_eye(f, q, side);
    }
    f.relief += 0.022 * bump(q, 0, 0.238, 0.07, 0.042);
    model_nose(f, q);
    model_mouth(f, q);
    // Sfumato: the far cheek, the jaw and the beard's shade sink into the dark.
    f.tint(0.62 * soft_step(0.09, 0.25, q.x + 0.15 * (0.7 - q.y)), skin_shadow);
    f.tint(0.40 * soft_step(0.16, 0.26, -q.x), skin_shadow);
    f.tint(0.50 * soft_step(0.085, 0.0, depth), skin_shadow);
    f.tint(0.34 * soft_step(0.40, 0.22, q.y) * soft_step(0.03, 0.15, std::abs(q.x)), skin_shadow);
    f.tint(0.18 * soft_step(0.34, 0.25, q.y), skin_shadow);
    f.tint(0.20 * soft_step(0.93, 1.02, q.y), skin_shadow);
    f.colour *= 1 + 0.05 * noise(p * 14.0, 3, 11);
    // A wide, flat mass: a cheek turns away from the light late.
    const double mass = 0.10 + 0.135 * std::pow(shoulder(depth / 0.23), 0.9);
    spot.cover(soft_step(-0.012, 0.016, depth), mass + f.relief * soft_step(-0.01, 0.05, depth), f.colour);
}

void Painting::paint_hair(Vec2 p, Spot &spot) const {
    // Locks: what is drawn is the distance from the outline, so that strands run along it; further down they curl.
    const double curl = soft_step(0.55, -0.15, p.y);
    const Vec2 sway(0.022 * curl * std::sin(30 * p.y + 5 * noise(p * 3.0, 1, 21)),
                    0.012 * curl * std::sin(34 * p.x + 4 * noise(p * 3.0, 1, 22)));
    const double depth = hair_.depth(p + sway);
    if (depth < -0.03) return;
    const double right = p.x > axis_x ? 1 : -1;
    const Beside lock = beside(right > 0 ? parting_right_ : parting_left_, p + sway);
    const Vec2 far = right > 0 ? Vec2(0.9, 0.9) : Vec2(-0.9, 0.9);
    const double side = glm::length(p - far) < glm::length(Vec2(0.35 * right, p.y) - far) ? 1 : -1;
    const double across = side * lock.distance;
    const double strand = noise(Vec2(34 * across, 5 * lock.along + 3 * right), 3, 23);
    // Corkscrews: bright ridges that wind across each lock.
    const double phase = 46 * p.y + 62 * across * (noise(Vec2(9 * across, 2 * p.y), 1, 25) > 0 ? 1 : -1) +
                         2.5 * noise(p * 7.0, 2, 24);
    const double coil = std::pow(0.5 + 0.5 * std::sin(phase), 1.5);
    const double light = std::clamp(mix(0.42 + 0.55 * strand, 0.72 * coil + 0.30 * strand, 0.8 * curl), 0.0, 1.0);
    Rgb colour = mix(hair_dark, hair_light, light * light);
    colour = mix(colour, hair_dark, 0.75 * soft_step(0.05, 0.0, face_.depth(p) + 0.06)); // beside the face
    colour = mix(colour, hair_dark, 0.35 * soft_step(0.1, 0.3, p.x));
    colour = mix(colour, hair_dark, 0.8 * std::exp(-std::pow((p.x - axis_x + 0.004) / 0.008, 2)) *
                                        soft_step(1.0, 1.05, p.y)); // the parting
    const double height = 0.03 + mix(0.15, 0.125, curl) * shoulder(depth / 0.11) + 0.010 * strand +
                          0.022 * curl * (coil - 0.4) * soft_step(0, 0.04, depth);
    const double edge = soft_step(-0.012, 0.012, depth + 0.012 * noise(p * 40.0, 2, 26));
    spot.cover(edge, height, colour);
}

void Painting::paint_chest(Vec2 p, Spot &spot) const {
    const double depth = chest_.depth(p);
    if (depth < -0.02) return;
    const Vec2 q(p.x - axis_x - 0.01, p.y);
    const double neck = soft_step(-0.02, 0.2, p.y);
    const double column = std::sqrt(std::max(0.0, 1 - std::pow(q.x / 0.25, 2)));
    double height = mix(0.095 + 0.02 * std::exp(-std::pow(q.x / 0.3, 2)), 0.02 + 0.085 * column, neck);
    Rgb colour = skin;
    for (const double side : {-1.0, 1.0}) {
        const Vec2 bone(0.10 * side, -0.145), outer(0.36 * side, -0.10);
        const Beside clavicle = beside({bone, outer}, q);
        const double ridge = std::exp(-std::pow(clavicle.distance / 0.022, 2)) * soft_step(1.0, 0.7, clavicle.along);
        height += 0.008 * ridge;
        colour = mix(colour, skin_shadow, 0.25 * std::exp(-std::pow((clavicle.distance - 0.03) / 0.02, 2)));
        const Beside tendon = beside({Vec2(0.035 * side, -0.15), Vec2(0.17 * side, 0.16)}, q);
        height += 0.010 * std::exp(-std::pow(tendon.distance / 0.022, 2));
    }
    colour = mix(colour, skin_shadow, 0.30 * bump(q, 0, -0.165, 0.035, 0.03));
    colour = mix(colour, skin_shadow, 0.80 * soft_step(-0.06, 0.24, p.y)); // under the chin
    colour = mix(colour, skin_shadow, 0.45 * soft_step(0.08, 0.30, q.x));
    colour = mix(colour, skin_shadow, 0.40 * soft_step(0.20, 0.36, -q.x));
    colour *= 1 + 0.05 * noise(p * 12.0, 3, 31);
    spot.cover(soft_step(-0.01, 0.01, depth), height, colour);
}

} // namespace threefold::figure
