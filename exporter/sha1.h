// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace threefold {

/// 40 hexadecimal digits (FIPS 180-4, section 6.1).
std::string sha1(std::string_view bytes);

} // namespace threefold
