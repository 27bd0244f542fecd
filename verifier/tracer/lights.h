// SPDX-License-Identifier: MIT
// Which lights a sample looks at: the samples of a pixel share the many weak ones among themselves.
#pragma once

#include <algorithm>
#include <vector>

#include <glm/geometric.hpp>

#include "scenes/light.h"

namespace threefold::tracer {

struct Light {
    Vec3 towards; ///< unit length
    Rgb irradiance;
};

class Lights {
public:
    Lights(const Scene &scene, int samples) {
        constexpr std::size_t fewest = 8; // lights in a share: fewer are seen as noise in a single sample
        const std::vector<Directional> all = lights_on_diffuse(scene);
        // A divisor of the number of samples, so that they ask for each share equally often.
        const auto asked = static_cast<std::size_t>(std::max(samples, 1));
        std::size_t shares = std::clamp<std::size_t>(all.size() / fewest, 1, asked);
        while (asked % shares != 0) --shares;
        for (const std::vector<Directional> &part : shared_lights(all, shares)) {
            std::vector<Light> &share = shares_.emplace_back();
            for (const Directional &light : part) share.push_back({-glm::normalize(light.travel), light.irradiance});
        }
    }

    /// For sample `k` of a pixel; `turn` differs between pixels.
    const std::vector<Light> &share(std::size_t k, std::size_t turn) const {
        return shares_[(k + turn) % shares_.size()];
    }

private:
    std::vector<std::vector<Light>> shares_;
};

} // namespace threefold::tracer
