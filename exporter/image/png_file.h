// SPDX-License-Identifier: MIT
// Bytes of a PNG file, by the format's own library: it is loaded in a hundredth of the time that OpenImageIO takes.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace threefold {

/// Three samples a pixel, 8 bits, sRGB. `metadata` becomes lines of text.
std::string encode_png8(int width, int height, const std::vector<std::uint8_t> &samples,
                        const std::map<std::string, std::string> &metadata);
/// Three samples a pixel, 16 bits, linear: with the gamma chunk 1.0, the only declaration that stops every reader from
/// converting.
std::string encode_png16(int width, int height, const std::vector<std::uint16_t> &samples);

} // namespace threefold
