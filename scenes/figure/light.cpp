// SPDX-License-Identifier: MIT
#include "scenes/figure/light.h"

#include <cmath>
#include <numbers>

namespace threefold {

namespace {

/// The study's files turn a light by both angles; in their frame it travels along (-sin p sin a, -cos p, -sin p cos a),
/// and their x is our z, their z our -x.
Directional light(double polar_deg, double azimuth_deg, double irradiance) {
    const double p = polar_deg * std::numbers::pi / 180, a = azimuth_deg * std::numbers::pi / 180;
    return {{std::sin(p) * std::cos(a), -std::cos(p), -std::sin(p) * std::sin(a)}, Rgb(irradiance)};
}

} // namespace

std::vector<Directional> key_lights() {
    constexpr int polar_angles = 5, azimuths = key_light_directions / polar_angles;
    std::vector<Directional> lights;
    for (int i = 0; i < polar_angles; ++i)
        for (int j = 0; j < azimuths; ++j)
            lights.push_back(light(32.5 + 3 * i, 55 + 30.0 * j / (azimuths - 1), key_light_irradiance));
    return lights;
}

std::vector<Directional> study_lights() {
    std::vector<Directional> lights = key_lights();
    lights.push_back(light(40, 90, side_light_irradiance));
    lights.push_back({{0, 0, -1}, Rgb(front_light_irradiance)});
    return lights;
}

} // namespace threefold
