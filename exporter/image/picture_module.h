// SPDX-License-Identifier: MIT
// What reads and writes pictures through OpenImageIO: a module of its own (picture_module.cpp), loaded when first
// needed (load_pictures.h). OpenImageIO draws in some 260 libraries, and a quarter of a second to join them to the
// program.
#pragma once

#include <cstdint>
#include <string>

#include "exporter/image/image.h"
#include "exporter/image/picture_header.h"

namespace threefold {

/// The one symbol of the module, `threefold_pictures`. Functions throw std::runtime_error with the reason alone.
struct PictureModule {
    /// picture_module_version of the sources that the module was made from. Stays the first member.
    const char *version;
    const char *openimageio_version;
    /// Of a file of so many bytes.
    PictureHeader (*header)(const std::string &path, std::int64_t bytes);
    /// As read_image (image_io.h); `undo_curve`: Encoding::declared.
    Image (*read)(const std::string &path, std::int64_t bytes, bool undo_curve);
    /// The bytes of a file of 64-bit floats.
    std::string (*encode_tiff)(const Image &image, const std::string &description);
};

} // namespace threefold
