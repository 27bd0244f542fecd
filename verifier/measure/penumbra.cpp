// SPDX-License-Identifier: MIT
#include "verifier/measure/penumbra.h"

#include <cmath>
#include <limits>
#include <numeric>

namespace threefold {

std::vector<double> row_means(const Image &image) {
    std::vector<double> rows;
    for (int row = 0; row < image.height; ++row) {
        double sum = 0;
        for (int column = 0; column < image.width; ++column) {
            const Rgb &p = image.at(column, row);
            sum += (p.r + p.g + p.b) / 3;
        }
        rows.push_back(sum / image.width);
    }
    return rows;
}

Penumbra measure_penumbra(std::span<const double> rows) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    if (rows.size() < 32) return {unknown, unknown, unknown, unknown};
    const std::size_t end = rows.size() / 16;
    const auto mean = [](std::span<const double> part) {
        return std::accumulate(part.begin(), part.end(), 0.0) / static_cast<double>(part.size());
    };
    Penumbra p{mean(rows.first(end)), mean(rows.last(end)), unknown, unknown};
    if (!(p.light - p.dark > 1e-3 * std::abs(p.light))) return p;
    // For a distribution on [0, n] with distribution function F: E y = n - integral F, E y^2 = n^2 - 2 integral y F.
    const auto n = static_cast<double>(rows.size());
    double first = 0, second = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const double share = (rows[k] - p.dark) / (p.light - p.dark);
        first += share;
        second += share * (2 * static_cast<double>(k) + 1); // the integral of 2 y over the row
    }
    p.middle_row = n - first;
    p.width_rows = std::sqrt(12 * (n * n - second - p.middle_row * p.middle_row));
    return p;
}

} // namespace threefold
