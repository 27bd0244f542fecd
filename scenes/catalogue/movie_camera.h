// SPDX-License-Identifier: MIT
// A simple movie camera with two reels, to stand for the eye in pictures of a set-up. Generated; seen, never measured.
#pragma once

#include "scenes/scene.h"

namespace threefold {

/// About `length_mm` long, its lens's front at `front_mm`, looking along `forward`, its reels towards `up`
/// (perpendicular to it). It emits painted light and shade, the brightest being `radiance` (at most 1).
Mesh movie_camera(Vec3 front_mm, Vec3 forward, Vec3 up, double length_mm, double radiance);

} // namespace threefold
