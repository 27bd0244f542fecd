// SPDX-License-Identifier: MIT
#include "scenes/figure/light.h"

#include <cmath>
#include <numbers>

namespace threefold::figure {

namespace {

/// `elevation` is measured from straight down; the study's travel is (-sin e sin a, -cos e, -sin e cos a).
Vec3 travel(double elevation_deg, double azimuth_deg) {
    const double e = elevation_deg * std::numbers::pi / 180, a = azimuth_deg * std::numbers::pi / 180;
    return {std::sin(e) * std::cos(a), -std::cos(e), -std::sin(e) * std::sin(a)};
}

} // namespace

std::vector<Directional> study_lights() {
    constexpr double elevations_deg[]{32.5, 35.5, 38.5, 41.5, 44.5};
    constexpr int azimuths = 20;
    std::vector<Directional> lights;
    for (const double elevation : elevations_deg)
        for (int i = 0; i < azimuths; ++i)
            lights.push_back({travel(elevation, 55 + 30.0 * i / (azimuths - 1)), Rgb(0.0416)});
    lights.push_back({travel(40, 90), Rgb(0.3)});
    lights.push_back({Vec3(0, 0, -1), Rgb(0.6)});
    return lights;
}

} // namespace threefold::figure
