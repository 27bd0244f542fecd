// SPDX-License-Identifier: MIT
// Face, hair, neck and chest.
#include <numbers>

#include "scenes/figure/painting.h"

namespace threefold::figure {

namespace {

constexpr Rgb face_skin{0.50, 0.335, 0.165}, face_shadow{0.105, 0.048, 0.018}, lips{0.27, 0.105, 0.055};
constexpr Rgb hair_dark{0.014, 0.0062, 0.0026}, hair_light{0.30, 0.155, 0.055};
constexpr Rgb eye_white{0.22, 0.165, 0.10}, iris{0.055, 0.032, 0.016}, line_brown{0.05, 0.022, 0.010};

/// Mirrors the face about its axis: x from the axis, positive to the image's right.
constexpr double axis_x = -0.018;

struct Features {
    double relief = 0; ///< height above the face's mass
    Rgb colour = face_skin;

    void tint(double share, Rgb towards) { colour = mix(colour, towards, std::clamp(share, 0.0, 1.0)); }
};

void model_eye(Features &f, Vec2 q, double side) {
    const double x = 0.142 * side, y = 0.675;
    f.relief -= 0.019 * bump(q, x - 0.01 * side, y + 0.008, 0.075, 0.050);
    f.relief += 0.016 * bump(q, x, y - 0.004, 0.045, 0.026);
    f.tint(0.34 * bump(q, x - 0.016 * side, y + 0.03, 0.080, 0.034), face_shadow);
    f.tint(0.30 * bump(q, 0.085 * side, y + 0.01, 0.022, 0.05), face_shadow); // beside the nose's root
    f.tint(0.30 * bump(q, x, y - 0.058, 0.07, 0.014), face_shadow);           // lower lid's bag
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
        f.tint(0.55 * ends * std::exp(-std::pow((q.y - upper - 0.026) / 0.007, 2)), face_shadow); // the lid's crease
    }
    // The brow, faint as in the sitter's time.
    const double v = (q.x - x) * side / 0.095;
    const double brow = 0.765 + 0.022 * (1 - v * v) - 0.008 * v;
    f.tint(0.40 * soft_step(1.15, 0.6, std::abs(v)) * std::exp(-std::pow((q.y - brow) / 0.016, 2)), line_brown);
    f.relief += 0.006 * bump(q, x, 0.785, 0.085, 0.040);
}

void model_nose(Features &f, Vec2 q) {
    const double down = std::clamp((0.76 - q.y) / 0.30, 0.0, 1.0); // 0 between the brows, 1 at the tip
    const double width = mix(0.030, 0.040, down);
    const double end = soft_step(0.440, 0.485, q.y) * soft_step(0.82, 0.74, q.y);
    f.relief += (0.016 + 0.034 * down * down) * end * std::exp(-std::pow(q.x / width, 2));
    f.relief += 0.016 * bump(q, 0, 0.486, 0.030, 0.022);
    for (const double side : {-1.0, 1.0}) {
        f.relief += 0.018 * bump(q, 0.047 * side, 0.482, 0.019, 0.020);
        f.tint(0.85 * bump(q, 0.027 * side, 0.4565, 0.014, 0.0065), line_brown);
        f.tint(0.45 * bump(q, 0.066 * side, 0.478, 0.007, 0.022), face_shadow);
        f.tint((side > 0 ? 0.42 : 0.16) * bump(q, 0.050 * side, 0.60, 0.017, 0.095), face_shadow);
    }
    f.tint(0.40 * bump(q, 0, 0.452, 0.040, 0.010), face_shadow);
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
    for (const double side : {-1.0, 1.0}) f.tint(0.5 * bump(q, 0.106 * side, 0.372, 0.014, 0.013), face_shadow);
    f.tint(0.35 * bump(q, 0, 0.308, 0.050, 0.012), face_shadow); // under the lower lip
    f.tint(0.16 * bump(q, 0, 0.415, 0.012, 0.020), face_shadow); // between nose and mouth
}

/// How far the middle of the hair hangs from the face's axis, from the crown down.
double hang_of_hair(double y) {
    constexpr std::array<Vec2, 8> middle{Vec2(-0.50, 0.555), Vec2(-0.30, 0.535), Vec2(0.00, 0.455), Vec2(0.30, 0.375),
                                         Vec2(0.60, 0.325),  Vec2(0.85, 0.27),   Vec2(1.02, 0.17),  Vec2(1.11, 0.02)};
    if (y <= middle.front().x) return middle.front().y;
    for (std::size_t i = 0; i + 1 < middle.size(); ++i)
        if (y < middle[i + 1].x)
            return mix(middle[i].y, middle[i + 1].y, (y - middle[i].x) / (middle[i + 1].x - middle[i].x));
    return middle.back().y - 0.6 * (y - middle.back().x);
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
    f.tint(0.72 * soft_step(0.02, 0.26, q.x + 0.15 * (0.7 - q.y)), face_shadow);
    f.tint(0.48 * soft_step(0.12, 0.26, -q.x), face_shadow);
    f.tint(0.62 * soft_step(0.10, 0.0, depth), face_shadow);
    f.tint(0.34 * soft_step(0.40, 0.22, q.y) * soft_step(0.03, 0.15, std::abs(q.x)), face_shadow);
    f.tint(0.18 * soft_step(0.34, 0.25, q.y), face_shadow);
    f.tint(0.20 * soft_step(0.93, 1.02, q.y), face_shadow);
    f.colour *= 1 + 0.05 * noise(p * 14.0, 3, 11);
    // A wide, flat mass: a cheek turns away from the light late.
    const double mass = 0.150 + 0.095 * std::pow(shoulder(depth / 0.24), 0.9);
    spot.cover(soft_step(-0.012, 0.016, depth), mass + f.relief * soft_step(-0.01, 0.05, depth), f.colour);
}

void Painting::paint_hair(Vec2 p, Spot &spot) const {
    const double curl = soft_step(0.60, -0.05, p.y);
    const Vec2 sway(0.016 * curl * std::sin(24 * p.y + 5 * noise(p * 3.0, 1, 21)), 0);
    const double depth = hair_.depth(p + sway);
    if (depth < -0.03) return;
    const double side = p.x > axis_x ? 1 : -1;
    const double across = std::abs(p.x + sway.x - axis_x) - hang_of_hair(p.y);
    const double strand = noise(Vec2(42 * across + 7 * side, 2.2 * p.y), 3, 23);
    // Corkscrews: in each lock, bands that wind downwards, dark between the locks.
    const double locks = across / 0.052 + 0.5 * noise(p * Vec2(2.0, 3.0), 1, 25);
    const double lock = std::floor(locks), s = locks - lock;
    const double round = std::sin(std::numbers::pi * s);
    const double phase = 44 * p.y + side * 4.2 * s + 2.3 * lock + 1.2 * noise(p * 6.0, 1, 24);
    const double coil = round * std::pow(0.5 + 0.5 * std::sin(phase), 1.3);
    const double light = std::clamp(mix(0.36 + 0.55 * strand, 0.85 * coil + 0.25 * strand, 0.85 * curl), 0.0, 1.0);
    Rgb colour = mix(hair_dark, hair_light, light * light);
    colour = mix(colour, hair_dark, 0.75 * soft_step(0.05, 0.0, face_.depth(p) + 0.06)); // beside the face
    colour = mix(colour, hair_dark, 0.35 * soft_step(0.1, 0.3, p.x));
    colour =
        mix(colour, hair_dark,
            0.8 * std::exp(-std::pow((p.x - axis_x + 0.004) / 0.008, 2)) * soft_step(1.0, 1.05, p.y)); // the parting
    const double height = 0.03 + mix(0.135, 0.125, curl) * shoulder(depth / 0.11) + 0.008 * strand +
                          0.026 * curl * (coil + 0.5 * round - 0.5) * soft_step(0, 0.04, depth);
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
    Rgb colour = face_skin;
    for (const double side : {-1.0, 1.0}) {
        const Vec2 bone(0.10 * side, -0.145), outer(0.36 * side, -0.10);
        const Beside clavicle = beside({bone, outer}, q);
        const double ridge = std::exp(-std::pow(clavicle.distance / 0.022, 2)) * soft_step(1.0, 0.7, clavicle.along);
        height += 0.004 * ridge;
        colour = mix(colour, face_shadow, 0.25 * std::exp(-std::pow((clavicle.distance - 0.03) / 0.02, 2)));
        const Beside tendon = beside({Vec2(0.035 * side, -0.15), Vec2(0.17 * side, 0.16)}, q);
        height += 0.006 * std::exp(-std::pow(tendon.distance / 0.035, 2)) * soft_step(0, 0.3, tendon.along);
    }
    colour = mix(colour, face_shadow, 0.30 * bump(q, 0, -0.165, 0.035, 0.03));
    colour = mix(colour, face_shadow, 0.80 * soft_step(-0.06, 0.24, p.y)); // under the chin
    colour = mix(colour, face_shadow, 0.45 * soft_step(0.08, 0.30, q.x));
    colour = mix(colour, face_shadow, 0.40 * soft_step(0.20, 0.36, -q.x));
    colour *= 1 + 0.05 * noise(p * 12.0, 3, 31);
    spot.cover(soft_step(-0.01, 0.01, depth), height, colour);
}

} // namespace threefold::figure
