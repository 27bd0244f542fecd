// SPDX-License-Identifier: MIT
// A scene in POV-Ray's scene description language (3.7).
#pragma once

#include "exporter/adapter.h"

namespace threefold {

Exported compile_povray(const RenderJob &job);
Adapter povray_adapter();

} // namespace threefold
