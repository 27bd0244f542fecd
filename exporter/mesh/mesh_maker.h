// SPDX-License-Identifier: MIT
// Polygons of a file to one mesh: cut into triangles, corners joined that are equal to the last bit. Errors are
// std::runtime_error with the reason alone: the reader runs in a child (mesh_file.h).
#pragma once

#include <span>
#include <vector>

#include "scenes/scene.h"

namespace threefold {

class MeshMaker {
public:
    /// `corners`: about how many of all polygons will come.
    MeshMaker(std::size_t corners, bool with_uv);

    /// `uv` is empty without. What has fewer than three corners, or no area, covers nothing and is left out.
    void add(std::span<const Vec3> places, std::span<const Vec2> uv);
    /// Throws where nothing is left.
    Mesh take();

private:
    std::uint32_t vertex(Vec3 place, Vec2 uv);

    bool with_uv_, any_ = false;
    std::vector<std::uint32_t> slots_; ///< a hash table of vertices
    Mesh mesh_;
};

/// What the rounding of the file's text puts beside the unit square is meant to lie in it. Throws where not finite.
Vec2 uv_in_file(double u, double v);

} // namespace threefold
