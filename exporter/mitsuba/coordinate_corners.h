// SPDX-License-Identifier: MIT
// The coordinate card as Mitsuba can say it: (u, v, 1) at its corners, between which a texture is bilinear.
#pragma once

#include "scenes/scene.h"

namespace threefold {

inline Texture coordinate_corners() {
    constexpr std::uint16_t one = 65535;
    return {2, 2, {0, one, one, one, one, one, 0, 0, one, one, 0, one}};
}

} // namespace threefold
