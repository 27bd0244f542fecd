// SPDX-License-Identifier: MIT
// What a picture of the coordinate card says: where each pixel's ray landed. Knows pictures and cards, nothing of who
// made the picture.
#pragma once

#include <optional>
#include <vector>

#include "exporter/image/image.h"
#include "scenes/camera.h"

namespace threefold {

/// Card coordinates (u, v) by the ratios of a pixel: losses along the way cancel. Nothing where hardly any light of the
/// card arrives (blue under `least_blue`).
std::optional<Vec2> card_coordinates(const Rgb &pixel, double least_blue = 1e-3);

/// The point (mm) on the card where the pixel's ray landed.
std::optional<Vec3> landing_point(const Quad &card, const Rgb &pixel);

Vec3 point_on(const Quad &card, Vec2 uv);
Vec2 coordinates_on(const Quad &card, Vec3 point_mm);

/// A pair of distances from the axis point of the card, one pixel: where its ray would land without glass, and where it
/// did, along the same direction (negative: on the other side).
struct LandingPair {
    double straight_mm, landed_mm;
};

/// The slope at the axis of landed over straight: least squares with y = s x + c x^3 + e x^5, odd by symmetry.
/// NaN with fewer than three pairs.
double central_slope(const std::vector<LandingPair> &pairs);

/// The q-quantile (0 to 1), by rank; NaN if empty.
double quantile(std::vector<double> values, double q);

} // namespace threefold
