// SPDX-License-Identifier: MIT
// Lights and environment.
#include "exporter/povray/writer.h"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scenes/light.h"
#include "scenes/validate.h"

namespace threefold::povray {

namespace {

/// Two pictures are a mirrored pair of the same light: their gradients cancel.
std::size_t shares_of(const Grid &grid) { return grid.pictures > 2 ? static_cast<std::size_t>(grid.pictures) : 1; }

} // namespace

// A light of colour E / pi gives a white surface with `diffuse 1` that faces it the radiance E / pi.
void write_lights(Writer &writer) {
    const Scene &scene = writer.job.scene;
    if (scene.environment)
        writer.text +=
            fmt::format("background {{ rgb {} }}\n", vector(scene.environment->radiance * writer.radiance_scale));
    if (!needs(scene).direct_light) return;
    const auto write = [&](const std::vector<Directional> &lights) {
        for (const Directional &light : lights)
            writer.text += fmt::format("light_source {{ {}, rgb {} parallel point_at 0 }}\n",
                                       vector(glm::normalize(light.travel) * (-3 * writer.space.extent)),
                                       vector(light.irradiance * (writer.radiance_scale / std::numbers::pi)));
    };
    const auto shares = shared_lights(lights_on_diffuse(scene), shares_of(writer.grid));
    if (shares.size() == 1) {
        write(shares.front());
        return;
    }
    writer.text += fmt::format("// Each picture has its share of the lights: their mean has all.\n"
                               "#switch (mod(frame_number - 1, {}))\n",
                               shares.size());
    for (std::size_t k = 0; k < shares.size(); ++k) {
        writer.text += fmt::format("#case ({})\n", k);
        write(shares[k]);
        writer.text += "#break\n";
    }
    writer.text += "#end\n";
}

double greatest_share(const Scene &scene, const Grid &grid) {
    const auto sum = [](const std::vector<Directional> &lights) {
        Rgb all(0);
        for (const Directional &light : lights) all += light.irradiance;
        return all;
    };
    const std::vector<Directional> lights = lights_on_diffuse(scene);
    const Rgb whole = sum(lights);
    double most = 1;
    for (const auto &share : shared_lights(lights, shares_of(grid))) {
        const Rgb part = sum(share);
        for (int k = 0; k < 3; ++k)
            if (whole[k] > 0) most = std::max(most, part[k] / whole[k]);
    }
    return most;
}

} // namespace threefold::povray
