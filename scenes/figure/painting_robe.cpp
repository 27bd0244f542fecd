// SPDX-License-Identifier: MIT
// Robe, crossed bands, and the five folds above the orb.
#include <numbers>

#include "scenes/figure/painting.h"

namespace threefold::figure {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr Rgb blue_dark{0.006, 0.013, 0.030}, blue{0.042, 0.086, 0.175}, blue_light{0.125, 0.215, 0.36};
constexpr Rgb gold_dark{0.085, 0.034, 0.009}, gold{0.235, 0.105, 0.028}, gold_light{0.62, 0.37, 0.12};

/// Directions in which the folds cross the orb's boundary, from the orb's centre; the last three points up.
constexpr std::array<double, 5> crossing_deg{96, 78, 66, 54, 42};
/// The leftmost leans like its neighbours but passes the centre by.
constexpr double leftmost_lean_deg = 70;

Vec2 towards(double angle_deg) { return {std::cos(angle_deg * degree), std::sin(angle_deg * degree)}; }

/// Cloth that hangs along `fall`: ridges, no valleys as wide as they.
double drape(Vec2 p, Vec2 fall, double across_scale, double along_scale, std::uint32_t seed) {
    const Vec2 across(-fall.y, fall.x);
    const Vec2 q(across_scale * glm::dot(p, across), along_scale * glm::dot(p, fall));
    const double bend = 0.8 * noise(q * 0.4, 1, seed + 7);
    const double a = 1 - std::abs(noise(q + Vec2(bend, 0), 1, seed));
    const double b = 1 - std::abs(noise(q * 2.1 + Vec2(bend, 3), 1, seed + 1));
    return 0.7 * a * a + 0.3 * b * b - 0.45;
}

Rgb cloth(double light) {
    return light < 0 ? mix(blue, blue_dark, std::min(1.0, -light)) : mix(blue, blue_light, std::min(1.0, light));
}

/// A knot of interlaced threads on a band, `a` along it and `s` across (-1 to 1): how much gold lies on top.
double knots(double a, double s) {
    const double pi = std::numbers::pi;
    double thread = 0;
    for (const double edge : {0.93, 0.76}) thread = std::max(thread, std::exp(-std::pow((std::abs(s) - edge) / 0.05, 2)));
    const double period = 0.105;
    for (int k = 0; k < 3; ++k) {
        const double centre = 0.62 * std::sin(2 * pi * a / period + 2 * pi * k / 3.0);
        thread = std::max(thread, std::exp(-std::pow((s - centre) / 0.085, 2)));
    }
    for (const double sign : {-1.0, 1.0}) {
        const double diagonal = std::remainder(a + sign * 0.045 * s, period / 2);
        thread = std::max(thread, 0.8 * std::exp(-std::pow(diagonal / 0.0032, 2)) * soft_step(0.74, 0.66, std::abs(s)));
    }
    return thread;
}

void jewel(Vec2 p, Vec2 centre, Vec2 radii, Spot &spot) {
    const Vec2 q = (p - centre) / radii;
    const double r = glm::length(q);
    if (r > 1.6) return;
    spot.cover(soft_step(1.5, 1.4, r), spot.height + 0.004, mix(gold, gold_light, 0.5 + 0.5 * std::cos(9 * r)));
    const double dome = std::sqrt(std::max(0.0, 1 - r * r));
    const Rgb stone = mix(Rgb(0.012, 0.006, 0.004), Rgb(0.11, 0.05, 0.03), soft_step(0.2, -0.9, q.y) * r);
    spot.cover(soft_step(1.03, 0.95, r), spot.height + 0.014 * dome, stone);
    spot.colour = mix(spot.colour, Rgb(0.8, 0.75, 0.65), bump(q, -0.3, 0.45, 0.16, 0.10));
}

} // namespace

std::array<Fold, 5> five_folds() {
    std::array<Fold, 5> folds;
    for (std::size_t i = 0; i < folds.size(); ++i) {
        const bool aimed = i > 0;
        const Vec2 crossing = orb_place + orb_size * towards(crossing_deg[i]);
        const Vec2 lean = towards(aimed ? crossing_deg[i] : leftmost_lean_deg);
        folds[i] = {crossing - 0.62 * orb_size * lean, crossing + 1.15 * orb_size * lean, aimed};
    }
    return folds;
}

double fold_height(Vec2 p) {
    static const std::array<Fold, 5> folds = five_folds();
    double height = 0;
    for (const Fold &fold : folds) {
        const Vec2 along = fold.outer - fold.inner;
        const double length = glm::length(along), a = glm::dot(p - fold.inner, along) / (length * length);
        if (a < -0.1 || a > 1.1) continue;
        const double s = (along.x * (p.y - fold.inner.y) - along.y * (p.x - fold.inner.x)) / length;
        // It spreads away from the orb, in proportion to the distance from its centre.
        const double width = 0.058 * (0.25 + glm::length(p - orb_place));
        height += soft_step(-0.05, 0.25, a) * soft_step(1.08, 0.75, a) * std::exp(-std::pow(s / width, 2));
    }
    return height;
}

void Painting::paint_robe(Vec2 p, Spot &spot) const {
    const double depth = body_.depth(p);
    if (depth < -0.02) return;
    // Which cloth: on either side of the crossed bands, or the bodice between them.
    const auto side_of = [&](const std::vector<Vec2> &band) {
        const Vec2 d = glm::normalize(band[1] - band[0]), q = p - band[1];
        return d.x * q.y - d.y * q.x; // positive: left of the band's direction
    };
    const double under_left = -side_of(left_band_), under_right = side_of(right_band_);
    const double mantle = soft_step(-0.01, 0.01, under_right), sleeve = soft_step(-0.01, 0.01, under_left) * (1 - mantle);
    const double bodice = std::max(0.0, 1 - mantle - sleeve);

    const double neckline = beside(neck_band_, p).distance;
    const bool above_neckline = p.y > -0.455 && std::abs(p.x) < 0.52 && bodice > 0.5 && neckline > 0;
    const double skin_shows = above_neckline ? soft_step(-0.005, 0.01, chest_.depth(p)) *
                                                   soft_step(-0.47, -0.455, p.y)
                                             : 0;

    const double mass = 0.04 + 0.10 * shoulder(depth / 0.30);
    const double near_folds = soft_step(1.05, 0.5, glm::length(p - orb_place - orb_size * 1.2 * towards(68)) / orb_size / 1.25);

    const double pleats = std::sin(2 * std::numbers::pi * (p.x / 0.040 + 0.9 * noise(Vec2(3 * p.x, 2 * p.y), 2, 40)));
    const double hang = drape(p, glm::normalize(Vec2(0.30, -1)), 6.5, 1.6, 41);
    const double sweep = drape(p, glm::normalize(Vec2(-0.62, -0.78)), 8.0, 1.3, 43);
    const double folds = fold_height(p);
    const double mantle_fold = mix(0.030 * sweep, 0.004 * sweep, near_folds) + 0.026 * folds;
    const double relief = mantle * mantle_fold + sleeve * 0.034 * hang + bodice * 0.006 * pleats;

    const double weave = 0.10 * noise(p * 30.0, 3, 44);
    const double mantle_light = mix(0.9 * sweep, 0.25 * sweep - 0.18, near_folds) + 0.62 * folds;
    double light = mantle * mantle_light + sleeve * (1.0 * hang - 0.25) + bodice * (0.28 * pleats - 0.25) + weave;
    light -= 0.55 * mantle * soft_step(-0.95, -1.40, p.y);
    light -= 0.35 * sleeve * soft_step(-0.55, -0.80, p.y) + 0.25 * soft_step(-1.2, -1.45, p.y);
    light += 0.22 * mantle * soft_step(-0.95, -0.30, p.y);
    // The bodice is greyer, nearly violet in its folds.
    Rgb colour = mix(cloth(light), cloth(light) * Rgb(1.15, 0.85, 0.80), bodice);
    const double edge = soft_step(-0.012, 0.012, depth + 0.004 * noise(p * 30.0, 2, 45));
    spot.cover(edge * (1 - skin_shows), mass + relief * soft_step(0, 0.05, depth), colour);
}

void Painting::paint_bands(Vec2 p, Spot &spot) const {
    if (body_.depth(p) < 0.004) return;
    struct Band {
        const std::vector<Vec2> *line;
        double half_width, length;
    };
    for (const Band &band : {Band{&right_band_, 0.074, 1.45}, Band{&left_band_, 0.078, 1.2}, Band{&neck_band_, 0.056, 0.95}}) {
        const Beside here = beside(*band.line, p);
        if (here.distance > 1.4 * band.half_width) continue;
        const double s = here.distance / band.half_width;
        // A shade beside it, where it stands off the cloth.
        spot.colour *= 1 - 0.5 * soft_step(1.35, 1.0, s);
        const double signed_s = p.y + p.x * (band.line == &right_band_ ? -1 : 1) >
                                        band.line->front().y +
                                            band.line->front().x * (band.line == &right_band_ ? -1 : 1)
                                    ? s
                                    : -s;
        const double thread = knots(here.along * band.length, signed_s);
        Rgb colour = mix(gold_dark, gold, 0.55 + 0.5 * noise(p * 22.0, 2, 50));
        colour = mix(colour, gold_light, 0.75 * thread);
        const double height = spot.height + 0.010 + 0.003 * thread;
        spot.cover(soft_step(1.02, 0.95, s), height, colour);
    }
    // The plaque under the neckline, with its stone; another stone where the bands cross.
    const Vec2 plaque = p - sketch(449, 938);
    const double taper = 1 - 0.35 * soft_step(0.02, -0.14, plaque.y);
    const double inside = std::max(std::abs(plaque.x) / (0.108 * taper), std::abs(plaque.y) / 0.125);
    if (inside < 1.25) {
        spot.colour *= 1 - 0.5 * soft_step(1.22, 1.0, inside);
        const double thread = std::max(std::exp(-std::pow((inside - 0.9) / 0.05, 2)),
                                       0.6 * knots(plaque.y + 0.03, std::clamp(plaque.x / 0.10, -1.0, 1.0)));
        spot.cover(soft_step(1.02, 0.96, inside), spot.height + 0.008 + 0.003 * thread,
                   mix(mix(gold_dark, gold, 0.5), gold_light, 0.6 * thread));
    }
    jewel(p, sketch(449, 945), {0.034, 0.050}, spot);
    jewel(p, sketch(441, 1146), {0.030, 0.030}, spot);
}

} // namespace threefold::figure
