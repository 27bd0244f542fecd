// SPDX-License-Identifier: MIT
#include "scenes/light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace threefold {

std::vector<Directional> dome(const Environment &environment) {
    std::vector<Directional> lights;
    if (environment.radiance == Rgb(0)) return lights;
    const int n = environment.dome_directions;
    const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
    for (int i = 0; i < n; ++i) {
        const double height = 1 - (2.0 * i + 1) / n, radius = std::sqrt((1 - height) * (1 + height));
        const double azimuth = golden_angle * i;
        lights.push_back({{-radius * std::cos(azimuth), -height, -radius * std::sin(azimuth)},
                          environment.radiance * (4 * std::numbers::pi / n)});
    }
    return lights;
}

std::vector<Directional> lights_on_diffuse(const Scene &scene) {
    std::vector<Directional> lights = scene.lights;
    if (scene.environment)
        for (const Directional &light : dome(*scene.environment)) lights.push_back(light);
    return lights;
}

std::vector<std::vector<Directional>> shared_lights(const std::vector<Directional> &lights, std::size_t shares) {
    constexpr double strong = 0.02; // of all light
    const auto strength = [](const Directional &light) {
        return std::max({light.irradiance.r, light.irradiance.g, light.irradiance.b});
    };
    double sum = 0;
    for (const Directional &light : lights) sum += strength(light);
    std::vector<std::vector<Directional>> parts(shares);
    std::size_t next = 0;
    for (const Directional &light : lights) {
        if (!(strength(light) > 0)) continue;
        if (strength(light) > strong * sum)
            for (auto &part : parts) part.push_back(light);
        else
            parts[next++ % shares].push_back({light.travel, light.irradiance * static_cast<double>(shares)});
    }
    return parts;
}

} // namespace threefold
