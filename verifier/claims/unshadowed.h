// SPDX-License-Identifier: MIT
// A picture's mean radiance known before any renderer is asked: each surface in its full light, without shadows and
// without glass. Good to some ten per cent.
#pragma once

#include "scenes/scene.h"

namespace threefold {

/// Mean over the picture and the three channels.
double unshadowed_mean_radiance(const Scene &scene);

} // namespace threefold
