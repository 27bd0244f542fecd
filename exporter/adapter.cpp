// SPDX-License-Identifier: MIT
#include "exporter/adapter.h"

#include <array>

#include "exporter/blender/cycles.h"
#include "exporter/povray/povray.h"
#include "scenes/validate.h"

namespace threefold {

std::span<const Adapter> adapters() {
    static const std::array table{povray_adapter(), cycles_adapter()};
    return table;
}

RenderJob for_renderer(const Adapter &adapter, RenderJob job) {
    const Needs needed = needs(job.scene);
    if (job.sampling == Sampling::box && (needed.ray_tree || needed.many_lights))
        job.samples_per_pixel *= adapter.sample_factor;
    return job;
}

} // namespace threefold
