// SPDX-License-Identifier: MIT
#include "verifier/measure/double_image.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

namespace threefold {

namespace {

double root_mean(std::vector<double> squares) {
    std::ranges::sort(squares);
    const auto left_out = static_cast<std::size_t>(left_out_share * static_cast<double>(squares.size()));
    squares.resize(squares.size() - left_out);
    return std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) / static_cast<double>(squares.size()));
}

} // namespace

DoubleImage double_image(const std::vector<DoubleLanding> &landings) {
    std::vector<double> ordinary, extraordinary, middle, apart;
    for (const DoubleLanding &l : landings) {
        const Vec3 o = l.ordinary_mm - l.straight_mm, e = l.extraordinary_mm - l.straight_mm;
        ordinary.push_back(glm::dot(o, o));
        extraordinary.push_back(glm::dot(e, e));
        middle.push_back(glm::dot(o + e, o + e) / 4);
        apart.push_back(glm::dot(o - e, o - e));
    }
    return {root_mean(std::move(ordinary)), root_mean(std::move(extraordinary)), root_mean(std::move(middle)),
            root_mean(std::move(apart))};
}

} // namespace threefold
