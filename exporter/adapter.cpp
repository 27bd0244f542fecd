// SPDX-License-Identifier: MIT
#include "exporter/adapter.h"

#include <array>

#include "exporter/blender/cycles.h"
#include "exporter/povray/povray.h"

namespace threefold {

std::span<const Adapter> adapters() {
    static const std::array table{povray_adapter(), cycles_adapter()};
    return table;
}

} // namespace threefold
