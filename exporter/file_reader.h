// SPDX-License-Identifier: MIT
// The reader of a user's meshes and pictures. A file is read once in a process, and again when it has changed.
#pragma once

#include "scenes/file_reader.h"

namespace threefold {

const FileReader &file_reader();

} // namespace threefold
