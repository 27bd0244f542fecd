// SPDX-License-Identifier: MIT
// A texture from a user's own picture, in any format that OpenImageIO reads.
#pragma once

#include <filesystem>
#include <memory>

#include "scenes/scene.h"

namespace threefold {

/// `gamma` 0: linear by what the file declares (image_io.h). Else each sample as it stands, 0 to 1, to this power: the
/// study darkens its photograph so. Samples are rounded to 16 bits. Throws what read_image throws, and Error(bad_data)
/// for a picture of more than 2^26 pixels (8192 x 8192) or with samples outside 0 to 1, which are not shrunk or cut;
/// and for one that is to be turned (EXIF orientation) or whose data window is not its display window.
std::shared_ptr<const Texture> read_texture(const std::filesystem::path &path, double gamma);

} // namespace threefold
