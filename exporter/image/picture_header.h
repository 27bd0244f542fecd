// SPDX-License-Identifier: MIT
// What a picture file says of itself, without its pixels.
#pragma once

#include <glm/vec2.hpp>

namespace threefold {

struct PictureHeader {
    glm::ivec2 size_px;    ///< of the pixels that are stored (OpenEXR: the data window)
    glm::ivec2 offset_px;  ///< of their upper left corner from that of the display window
    glm::ivec2 display_px; ///< the display window; other formats: size_px
    int orientation;       ///< EXIF: 1 is as it is stored, 2 to 8 are turned or mirrored
};

} // namespace threefold
