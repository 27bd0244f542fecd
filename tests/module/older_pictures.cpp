// SPDX-License-Identifier: MIT
// A module for picture files as an earlier version of Threefold had it.
#include "exporter/image/picture_module.h"

extern "C" const threefold::PictureModule threefold_pictures{"threefold 0.0.1, pictures 1, C++ interface 1", "2.0",
                                                             nullptr, nullptr, nullptr};
