// SPDX-License-Identifier: MIT
// The sphere as triangles, for renderers that only know meshes. Unit sphere about the origin; lengths in radii.
#pragma once

#include <optional>
#include <vector>

#include "scenes/scene.h"

namespace threefold {

/// Level 0 is the icosahedron; each level splits every triangle in four and puts the new vertices on the sphere.
/// It stands askew: in the usual pose whole rings of edges lie in the planes between the axes, just where a camera that
/// looks along an axis has a row of pixels, and a ray along an edge may slip through between its two triangles.
struct Icosphere {
    std::vector<Vec3> vertices;        ///< at distance 1
    std::vector<glm::uvec3> triangles; ///< anticlockwise seen from outside
};

Icosphere make_icosphere(int level);

/// How a level stands to the true sphere once its vertices are pulled out by `scale`: the triangles then reach as far
/// out of the sphere as into it, which halves the greatest distance.
struct IcosphereFit {
    int level;
    double scale;
    double distance; ///< the greatest from the true sphere, in radii
};

constexpr int finest_icosphere = 8; ///< 1.3 million triangles

IcosphereFit fit_icosphere(int level);
/// The coarsest level within the tolerance; empty when even the finest is not.
std::optional<IcosphereFit> coarsest_icosphere(double tolerance);

} // namespace threefold
