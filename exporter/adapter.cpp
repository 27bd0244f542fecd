// SPDX-License-Identifier: MIT
#include "exporter/adapter.h"

#include <array>
#include <limits>

#include <fmt/format.h>

#include "exporter/blender/cycles.h"
#include "exporter/povray/povray.h"
#include "scenes/error.h"
#include "scenes/validate.h"

namespace threefold {

std::span<const Adapter> adapters() {
    static const std::array table{povray_adapter(), cycles_adapter()};
    return table;
}

RenderJob for_renderer(const Adapter &adapter, RenderJob job) {
    const Needs needed = needs(job.scene);
    if (job.sampling == Sampling::box && (needed.ray_tree || needed.many_lights)) {
        const int most = std::numeric_limits<int>::max() / adapter.sample_factor;
        if (job.samples_per_pixel > most)
            throw Error(Exit::bad_data, fmt::format("{} can take at most {} samples per pixel here, not {}",
                                                    adapter.title, most, job.samples_per_pixel));
        job.samples_per_pixel *= adapter.sample_factor;
    }
    return job;
}

} // namespace threefold
