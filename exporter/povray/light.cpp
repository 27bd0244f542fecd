// SPDX-License-Identifier: MIT
// Lights and environment, and the constant that keeps every radiance under the 1 at which a 16-bit picture clips.
#include "exporter/povray/writer.h"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace threefold::povray {
namespace {

double greatest(const Rgb &colour) { return std::max({colour.r, colour.g, colour.b}); }

} // namespace

Rgb greatest_value(const Paint &paint) {
    return std::visit(overloaded{[](const Rgb &colour) { return colour; },
                                 [](const std::shared_ptr<const Texture> &texture) {
                                     Rgb most(0);
                                     for (std::size_t i = 0; i + 2 < texture->rgb.size(); i += 3)
                                         most = glm::max(
                                             most, Rgb(texture->rgb[i], texture->rgb[i + 1], texture->rgb[i + 2]));
                                     return most / 65535.0;
                                 }},
                      paint);
}

double greatest_radiance(const Scene &scene) {
    Rgb irradiance(0);
    for (const Directional &light : scene.lights) irradiance += light.irradiance;
    double most = scene.environment ? greatest(scene.environment->radiance) : 0;
    for (const Object &object : scene.objects)
        if (const Surface *surface = surface_of(object.shape))
            most = std::max(
                most,
                std::visit(
                    overloaded{[&](const Diffuse &diffuse) {
                                   return greatest(greatest_value(diffuse.reflectance) * irradiance) / std::numbers::pi;
                               },
                               [](const Emissive &emissive) { return greatest(greatest_value(emissive.radiance)); },
                               [](const CoordinateCard &) { return 1.0; }},
                    *surface));
    return most;
}

// A light of colour E / pi gives a white surface with `diffuse 1` that faces it the radiance E / pi.
void write_lights(Writer &writer) {
    const Scene &scene = writer.job.scene;
    if (scene.environment)
        writer.text +=
            fmt::format("background {{ rgb {} }}\n", vector(scene.environment->radiance * writer.radiance_scale));
    for (const Directional &light : scene.lights)
        writer.text += fmt::format("light_source {{ {}, rgb {} parallel point_at 0 }}\n",
                                   vector(glm::normalize(light.travel) * (-3 * writer.space.extent)),
                                   vector(light.irradiance * (writer.radiance_scale / std::numbers::pi)));
}

} // namespace threefold::povray
