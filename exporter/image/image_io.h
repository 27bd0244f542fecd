// SPDX-License-Identifier: MIT
// Pictures on disk: read by OpenImageIO, in a module that is loaded when first needed (load_pictures.h). Every writer
// makes the file appear whole or not at all.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <glm/vec2.hpp>

#include "exporter/image/image.h"
#include "exporter/image/picture_header.h"

namespace threefold {

/// What the samples of a picture mean. `declared`: what the file says; sRGB and gamma curves are undone, and 8-bit
/// pictures that say nothing are sRGB. `linear`: the samples as they stand, whatever the file says.
enum class Encoding { declared, linear };

/// Reads the first three channels; one channel, or one and alpha, is grey. Integers become 0 to 1 and are never
/// multiplied by alpha. Throws Error(input_output) when the file is missing or cannot be read, Error(bad_data) when it
/// is corrupt, truncated, empty, or holds NaN or infinity; the message names the file.
Image read_image(const std::filesystem::path &path, Encoding encoding = Encoding::declared);

/// Throws like read_image.
PictureHeader read_picture_header(const std::filesystem::path &path);

/// The format follows the extension: .exr (32-bit float), .tif (64-bit float, lossless for the tracer), .png (8-bit
/// sRGB preview of radiance 0 to 1). `metadata` becomes header attributes (in a .tif, lines of the image description).
/// Throws Error(usage) for another extension, Error(bad_data) for NaN, infinity, or what the format cannot hold.
void write_image(const std::filesystem::path &path, const Image &image,
                 const std::map<std::string, std::string> &metadata = {});

/// Bytes of an 8-bit sRGB PNG of radiance 0 to `white`.
std::string encode_png_preview(const Image &image, double white = 1);
/// Bytes of a 16-bit linear PNG with just the samples of the texture; `border_texels` repeats the edges outwards.
std::string encode_png16(const Texture &texture, int border_texels = 0);
/// Bytes of an 8-bit sRGB PNG of it, for programs that take all textures to be that.
std::string encode_png_srgb(const Texture &texture);

/// Mean of every `factor` x `factor` block; both sides of the image are multiples of `factor`.
Image average_blocks(const Image &image, int factor);

} // namespace threefold
