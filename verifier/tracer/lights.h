// SPDX-License-Identifier: MIT
// Which lights a sample looks at: the samples of a pixel share the many weak ones among themselves.
#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include <glm/geometric.hpp>

#include "scenes/light.h"

namespace threefold::tracer {

struct Light {
    Vec3 towards; ///< unit length
    Rgb irradiance;
    std::uint32_t number = 0; ///< its place in Lights::all()
};

class Lights {
public:
    Lights(const Scene &scene, int samples) {
        constexpr std::size_t fewest = 8; // lights in a share: fewer are seen as noise in a single sample
        const std::vector<Directional> given = lights_on_diffuse(scene);
        // A divisor of the number of samples, so that they ask for each share equally often.
        const auto asked = static_cast<std::size_t>(std::max(samples, 1));
        std::size_t shares = std::clamp<std::size_t>(given.size() / fewest, 1, asked);
        while (asked % shares != 0) --shares;
        for (const std::vector<Directional> &part : shared_lights(given, shares)) {
            std::vector<Light> &share = shares_.emplace_back();
            for (const Directional &light : part) share.push_back({-glm::normalize(light.travel), light.irradiance});
            all_.insert(all_.end(), share.begin(), share.end());
        }
        // Strong lights are in every share, and are one.
        const auto key = [](const Light &l) {
            return std::tuple(near(l.towards), l.towards.x, l.towards.y, l.towards.z, l.irradiance.r, l.irradiance.g,
                              l.irradiance.b);
        };
        std::ranges::sort(all_, {}, key);
        const auto same = [&](const Light &a, const Light &b) { return key(a) == key(b); };
        all_.erase(std::unique(all_.begin(), all_.end(), same), all_.end()); // not of std::ranges, for Clang 14
        for (std::size_t i = 0; i < all_.size(); ++i) all_[i].number = static_cast<std::uint32_t>(i);
        for (std::vector<Light> &share : shares_)
            for (Light &light : share) light.number = std::ranges::lower_bound(all_, key(light), {}, key)->number;
    }

    /// For sample `k` of a pixel; `turn` differs between pixels.
    const std::vector<Light> &share(std::size_t k, std::size_t turn) const {
        return shares_[(k + turn) % shares_.size()];
    }

    /// Every light once, with the irradiance that it has in its share; neighbours in the list shine much alike.
    const std::vector<Light> &all() const { return all_; }

private:
    /// A number that is about the same for directions near each other: the bits of the coordinates in turn.
    static std::uint32_t near(Vec3 d) {
        std::uint32_t bits = 0;
        for (int bit = 9; bit >= 0; --bit)
            for (int k = 0; k < 3; ++k)
                bits = bits << 1 | (static_cast<std::uint32_t>(std::clamp(d[k] * 512 + 512, 0.0, 1023.0)) >> bit & 1u);
        return bits;
    }

    std::vector<std::vector<Light>> shares_;
    std::vector<Light> all_;
};

} // namespace threefold::tracer
