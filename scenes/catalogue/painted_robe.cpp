// SPDX-License-Identifier: MIT
#include "scenes/catalogue/painted_robe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/catalogue/textures.h"

namespace threefold {

namespace {

/// 1 inside |x| < half, falling to 0 over `soft`.
double band(double x, double half, double soft) { return 1 - smooth_step(half, half + soft, std::abs(x)); }

double box(double x, double y, double left, double right, double bottom, double top, double soft) {
    return band(x - (left + right) / 2, (right - left) / 2, soft) *
           band(y - (bottom + top) / 2, (top - bottom) / 2, soft);
}

Rgb mix(Rgb a, Rgb b, double t) { return a * (1 - t) + b * t; }

Rgb robe_colour(int column, int row) {
    constexpr int side = robe_texture_side;
    // The card's middle is (0, 0). The cloth hangs a little askew: an edge along a row of pixels would make every
    // renderer with a regular grid of samples err by the same amount all along it.
    const double right = (column + 0.5) / side - 0.5, up = 0.5 - (row + 0.5) / side;
    const double cosine = std::cos(0.2), sine = std::sin(0.2);
    const double x = cosine * right + sine * up, y = cosine * up - sine * right;
    const double soft = 0.008;
    const double fold = 0.5 + 0.5 * std::sin(2 * std::numbers::pi * (7 * x + 0.6 * std::sin(5 * y)));
    Rgb colour = mix(Rgb(0.05, 0.09, 0.24), Rgb(0.13, 0.22, 0.46), fold);
    colour = mix(
        colour, Rgb(0.30, 0.34, 0.42),
        0.6 * std::max(band(std::remainder(x, 0.0625), 0.001, 0.006), band(std::remainder(y, 0.0625), 0.001, 0.006)));
    const double bands = std::max(band(y - x + 0.14, 0.022, soft), band(y + x + 0.14, 0.022, soft));
    colour = mix(colour, Rgb(0.72, 0.50, 0.14), bands);
    const double letter =
        std::max({box(x, y, -0.055, -0.03, -0.075, 0.085, soft), box(x, y, -0.055, 0.055, 0.06, 0.085, soft),
                  box(x, y, -0.055, 0.025, -0.005, 0.02, soft)});
    return mix(colour, Rgb(0.92, 0.88, 0.80), letter);
}

} // namespace

std::vector<std::uint16_t> paint_robe_texture() {
    std::vector<std::uint16_t> samples;
    samples.reserve(std::size_t{3} * robe_texture_side * robe_texture_side);
    for (int row = 0; row < robe_texture_side; ++row)
        for (int column = 0; column < robe_texture_side; ++column) {
            const Rgb colour = robe_colour(column, row);
            for (int k = 0; k < 3; ++k) samples.push_back(texture_sample(colour[k]));
        }
    return samples;
}

} // namespace threefold
