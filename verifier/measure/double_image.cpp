// SPDX-License-Identifier: MIT
#include "verifier/measure/double_image.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace threefold {

DoubleImage double_image(const std::vector<DoubleLanding> &landings) {
    double ordinary = 0, extraordinary = 0, middle = 0, apart = 0;
    for (const DoubleLanding &l : landings) {
        const Vec3 o = l.ordinary_mm - l.straight_mm, e = l.extraordinary_mm - l.straight_mm;
        ordinary += glm::dot(o, o);
        extraordinary += glm::dot(e, e);
        middle += glm::dot(o + e, o + e) / 4;
        apart += glm::dot(o - e, o - e);
    }
    const auto n = static_cast<double>(landings.size());
    return {std::sqrt(ordinary / n), std::sqrt(extraordinary / n), std::sqrt(middle / n), std::sqrt(apart / n)};
}

} // namespace threefold
