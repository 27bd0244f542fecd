// SPDX-License-Identifier: MIT
// For the two sides of PictureModule alone; THREEFOLD_MODULE_VERSION is the project's version.
#pragma once

namespace threefold {

#define THREEFOLD_TEXT_OF(x) #x
#define THREEFOLD_TEXT(x) THREEFOLD_TEXT_OF(x)
/// A module of another version is refused. The number after "pictures" counts changes of PictureModule and Image; the
/// last one is the compiler's binary interface.
inline constexpr const char *picture_module_version =
    "threefold " THREEFOLD_MODULE_VERSION ", pictures 2, C++ interface " THREEFOLD_TEXT(__GXX_ABI_VERSION);
#undef THREEFOLD_TEXT
#undef THREEFOLD_TEXT_OF

} // namespace threefold
