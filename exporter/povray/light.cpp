// SPDX-License-Identifier: MIT
// Lights and environment.
#include "exporter/povray/writer.h"

#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scenes/light.h"
#include "scenes/validate.h"

namespace threefold::povray {
// A light of colour E / pi gives a white surface with `diffuse 1` that faces it the radiance E / pi.
void write_lights(Writer &writer) {
    const Scene &scene = writer.job.scene;
    if (scene.environment)
        writer.text +=
            fmt::format("background {{ rgb {} }}\n", vector(scene.environment->radiance * writer.radiance_scale));
    if (!needs(scene).direct_light) return;
    for (const Directional &light : lights_on_diffuse(scene))
        writer.text += fmt::format("light_source {{ {}, rgb {} parallel point_at 0 }}\n",
                                   vector(glm::normalize(light.travel) * (-3 * writer.space.extent)),
                                   vector(light.irradiance * (writer.radiance_scale / std::numbers::pi)));
}

} // namespace threefold::povray
