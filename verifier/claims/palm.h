// SPDX-License-Identifier: MIT
// What exact optics shows of the palm: the part of the hand that lies behind the orb as seen from the eye. Millimetres.
#pragma once

#include <memory>
#include <vector>

#include "verifier/claims/prediction.h"
#include "verifier/measure/mesh_rays.h"

namespace threefold {

/// The scene of figure and orb as rays see it. Objects are called "hand" and "robe"; what lies behind both is neither.
class Palm {
public:
    explicit Palm(const Scene &scene);

    /// Would this ray, if no orb bent it, pass the place of the orb and then meet the hand? It is then the palm's.
    bool is_palm(const Ray &ray) const;
    /// Does it, bent by the orb, meet the hand? Not where it is totally reflected: what it then shows is not seen
    /// through the orb.
    bool shows_hand(const OrbInScene &orb, const Ray &ray) const;

    /// Rays of the palm on a grid of `side` x `side` over the orb, as the camera sees it.
    std::vector<Ray> rays(int side) const;
    /// Share of the rays that show the hand through this orb.
    double share_in_place(const OrbInScene &orb, const std::vector<Ray> &rays) const;

private:
    OrbInScene orb_;
    Camera camera_;
    MeshRays hand_, robe_;
};

/// Rectangle of pixels that holds the orb; nothing where the picture does not show it.
std::optional<Crop> crop_around(const OrbInScene &orb, const Camera &camera);

} // namespace threefold
