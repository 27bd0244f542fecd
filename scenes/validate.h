// SPDX-License-Identifier: MIT
// Is a scene meaningful, and what does it require of a renderer?
#pragma once

#include <string>
#include <vector>

#include "scenes/scene.h"

namespace threefold {

/// Throws one clear Error(bad_data) for a scene without meaning: a number that is not finite, an empty or overlapping
/// body, an eye inside glass, a picture without size or too large for this machine's memory, nothing that gives light.
void validate(const Scene &scene);

/// What the picture of a scene needs; adapters enable just that, and refuse what they cannot do.
struct Needs {
    bool glass = false;
    bool ray_tree = false;               ///< some glass splits a ray (Coating::fresnel)
    bool direct_light = false;           ///< parallel lights reach a diffuse surface, those of a dome among them
    bool many_lights = false;            ///< more than one of them: a renderer may choose between them at random
    bool environment_on_diffuse = false; ///< the environment lights a diffuse surface, and no dome stands for it
    bool glass_shadow = false;           ///< glass stands between a light and a diffuse surface by the scene's rule
    bool caustics = false;
};

Needs needs(const Scene &scene);

/// Upper bound over the picture, whatever the camera: glass never amplifies. Reads every texel.
double greatest_radiance(const Scene &scene);

/// The least of what shines: of the environment, of each emitter and each lit surface the greatest radiance, unless
/// that is 0. 0 where nothing shines. A number format that is fine enough for it is fine enough for the picture.
double least_shining_radiance(const Scene &scene);

/// Bytes that one picture of this camera takes while it is made and measured (an upper estimate).
double picture_memory_bytes(const Camera &camera);

} // namespace threefold
