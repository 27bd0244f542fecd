// SPDX-License-Identifier: MIT
// Where a ray first meets a mesh: in double precision, and by nobody's renderer. Millimetres.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "scenes/camera.h"
#include "scenes/geometry.h"

namespace threefold {

/// Triangles in a tree of boxes, so that meshes of a million triangles can be asked.
class MeshRays {
public:
    explicit MeshRays(const Mesh &mesh);

    /// Distance to the first triangle from either side (Moeller and Trumbore, 1997); infinite where there is none.
    double first_hit_mm(const Ray &ray) const;

private:
    struct Node {
        Vec3 low, high;
        std::uint32_t first, count; ///< triangles of a leaf; count 0: its children are at first and first + 1
    };
    void build(std::uint32_t node, std::uint32_t first, std::uint32_t count);

    std::vector<Triangle> triangles_;
    std::vector<Node> nodes_;
};

} // namespace threefold
