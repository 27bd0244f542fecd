// SPDX-License-Identifier: MIT
// A model of a film camera: what stands at the eye in the picture of the set-up. Frame: that of scenes/scene.h.
#pragma once

#include "scenes/scene.h"

namespace threefold::figure {

/// Its lens opens at `eye_mm` and looks along -z; `length_mm` from lens to back.
Mesh film_camera(Vec3 eye_mm, double length_mm);

} // namespace threefold::figure
