// SPDX-License-Identifier: MIT
// A scene as a Python script that builds and renders it in Blender's Cycles (3.4 and later).
#pragma once

#include "exporter/adapter.h"

namespace threefold {

Exported compile_cycles(const RenderJob &job);
Adapter cycles_adapter();

} // namespace threefold
