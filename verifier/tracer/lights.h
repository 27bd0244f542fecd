// SPDX-License-Identifier: MIT
// Which lights a sample looks at. A pixel's samples share the many weak lights among themselves: each asks for every
// m-th of them, m times as strong, so that m samples together ask for all. Lights that alone are a good part of the
// whole are asked for by every sample: left out of some, they would leave much noise.
#pragma once

#include <algorithm>
#include <vector>

#include <glm/geometric.hpp>

#include "scenes/light.h"

namespace threefold::tracer {

/// The part of the weak lights that one sample asks for: those with index `first`, `first + stride`, ...
struct LightShare {
    std::size_t first = 0, stride = 1;
};

class Lights {
public:
    struct Light {
        Vec3 towards; ///< unit length
        Rgb irradiance;
    };

    explicit Lights(const std::vector<Directional> &lights) {
        constexpr double strong = 0.02; // of all light
        double sum = 0;
        for (const Directional &light : lights) sum += strength(light);
        for (const Directional &light : lights)
            if (strength(light) > 0)
                (strength(light) > strong * sum ? strong_ : weak_)
                    .push_back({-glm::normalize(light.travel), light.irradiance});
    }

    /// Calls `ask(light, factor)` for every light that the share holds. Over all shares of one stride each light is
    /// asked for with factors that average to 1.
    template <class Ask>
    void for_each(LightShare share, Ask &&ask) const {
        for (const Light &light : strong_) ask(light, 1.0);
        for (std::size_t i = share.first; i < weak_.size(); i += share.stride)
            ask(weak_[i], static_cast<double>(share.stride));
    }

    /// The share of sample `k` of a pixel with so many; `turn` differs between pixels.
    LightShare share(std::size_t k, std::size_t samples, std::size_t turn) const {
        constexpr std::size_t fewest = 4; // lights in a share: their noise would be seen in a single sample
        const std::size_t stride = std::clamp<std::size_t>(weak_.size() / fewest, 1, std::max<std::size_t>(samples, 1));
        return {(k + turn) % stride, stride};
    }

private:
    static double strength(const Directional &light) {
        return std::max({light.irradiance.r, light.irradiance.g, light.irradiance.b});
    }

    std::vector<Light> strong_, weak_;
};

} // namespace threefold::tracer
