// SPDX-License-Identifier: MIT
// Bytes of an OpenEXR file, by the format's own library: it is loaded in a hundredth of the time that OpenImageIO
// takes.
#pragma once

#include <map>
#include <string>

#include "exporter/image/image.h"

namespace threefold {

/// Three channels of 32-bit floats, losslessly compressed; no date. `metadata` becomes attributes.
std::string encode_exr(const Image &image, const std::map<std::string, std::string> &metadata);

} // namespace threefold
