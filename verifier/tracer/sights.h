// SPDX-License-Identifier: MIT
// What eight rays see at once of a few shining rectangles and of the surroundings. A texture's texels are asked for
// first and read later: between the two the memory has time to bring them.
#pragma once

#include <cstdint>
#include <vector>

#include "verifier/tracer/rectangles.h"

namespace threefold::tracer {

/// The look of one thing.
struct Sight {
    enum class Kind { constant, coordinates, texture };
    Kind kind = Kind::constant;
    Rgb colour{0};                         ///< constant
    const std::uint16_t *texels = nullptr; ///< texture: owned by the scene; at least two texels wide and high
    double width = 2, height = 2;
};

/// Eight points on their way to be seen: for those in `textured`, four texels by lane, and the share of each texel in
/// the sum.
struct Glance {
    std::uint32_t textured = 0;
    const std::uint16_t *texel[lanes]; ///< upper left
    std::ptrdiff_t down[lanes];        ///< from there to the lower left
    Lanes upper_left, upper_right, lower_left, lower_right;
};

/// What was seen, by lane: four channels each that hold a colour from the first on, and from the second on.
struct Seen {
    alignas(64) double left[lanes][4], right[lanes][4];

    Seen() : left{}, right{} {}
    Rgb at(int lane) const {
        return {left[lane][0] + right[lane][1], left[lane][1] + right[lane][2], left[lane][2] + right[lane][3]};
    }
    Rgb sum() const {
        Rgb all(0);
        for (int l = 0; l < lanes; ++l) all += at(l);
        return all;
    }
};

/// Takes the lanes of `asked`, each `factor` times its `weight`: adds what does not need memory to `seen`, and asks for
/// the texels of the others. sights[0] is the surroundings, sights[1 + i] the rectangle i of `hits`.
void glance(const std::vector<Sight> &sights, const RectangleHits &hits, const Lanes &weight, double factor,
            std::uint32_t asked, Glance &glance, Seen &seen);

/// Adds what the texels are, bilinear as `sample` in scenes/texture.h.
void read(const Glance &glance, Seen &seen);

} // namespace threefold::tracer
