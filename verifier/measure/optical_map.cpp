// SPDX-License-Identifier: MIT
#include "verifier/measure/optical_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace threefold {

std::optional<Vec2> card_coordinates(const Rgb &pixel, double least_blue) {
    if (!(pixel.b > least_blue)) return std::nullopt;
    return Vec2(pixel.r, pixel.g) / pixel.b;
}

Vec3 point_on(const Quad &card, Vec2 uv) {
    return card.centre_mm + (2 * uv.x - 1) * card.half_u_mm + (2 * uv.y - 1) * card.half_v_mm;
}

Vec2 coordinates_on(const Quad &card, Vec3 point_mm) {
    const Vec3 d = point_mm - card.centre_mm;
    return {0.5 + 0.5 * glm::dot(d, card.half_u_mm) / glm::dot(card.half_u_mm, card.half_u_mm),
            0.5 + 0.5 * glm::dot(d, card.half_v_mm) / glm::dot(card.half_v_mm, card.half_v_mm)};
}

std::optional<Vec3> landing_point(const Quad &card, const Rgb &pixel) {
    const auto uv = card_coordinates(pixel);
    if (!uv) return std::nullopt;
    return point_on(card, *uv);
}

double central_slope(const std::vector<LandingPair> &pairs) {
    if (pairs.size() < 3) return std::numeric_limits<double>::quiet_NaN();
    double greatest = 0;
    for (const LandingPair &p : pairs) greatest = std::max(greatest, std::abs(p.straight_mm));
    if (!(greatest > 0)) return std::numeric_limits<double>::quiet_NaN();
    glm::dmat3 normal(0);
    Vec3 right(0);
    for (const LandingPair &p : pairs) {
        const double x = p.straight_mm / greatest;
        const Vec3 basis(x, x * x * x, x * x * x * x * x);
        normal += glm::outerProduct(basis, basis);
        right += basis * (p.landed_mm / greatest);
    }
    return (glm::inverse(normal) * right).x;
}

double quantile(std::vector<double> values, double q) {
    if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto last = static_cast<double>(values.size() - 1);
    const auto rank = values.begin() + static_cast<std::ptrdiff_t>(std::ceil(q * last));
    std::ranges::nth_element(values, rank);
    return *rank;
}

} // namespace threefold
