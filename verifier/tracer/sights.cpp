// SPDX-License-Identifier: MIT
#include "verifier/tracer/sights.h"

#include <bit>
#include <cstring>

namespace threefold::tracer {

namespace {

// Four channels side by side: a texel's three and its neighbour's first, or the last one of that before it and its own
// three. So all reads lie within the texture.
typedef std::uint16_t Four16 __attribute__((vector_size(8)));
typedef std::int32_t Four32 __attribute__((vector_size(16)));
typedef double Four __attribute__((vector_size(32)));

THREEFOLD_INLINE void add(const std::uint16_t *from, double share, Four &sum) {
    Four16 channels;
    std::memcpy(&channels, from, sizeof channels);
    sum += share * __builtin_convertvector(__builtin_convertvector(channels, Four32), Four);
}

} // namespace

THREEFOLD_VECTOR
void glance(const std::vector<Sight> &sights, const RectangleHits &hits, const Lanes &weight, double factor,
            std::uint32_t asked, Glance &glance, Seen &seen) {
    Lanes width, height, offset;
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) width.v[l] = height.v[l] = 2;
    for (std::size_t i = 1; i < sights.size(); ++i) {
        const double which = static_cast<double>(i - 1), w = sights[i].width, h = sights[i].height;
        THREEFOLD_LANES
        for (int l = 0; l < lanes; ++l) {
            width.v[l] = hits.which.v[l] == which ? w : width.v[l];
            height.v[l] = hits.which.v[l] == which ? h : height.v[l];
        }
    }
    THREEFOLD_LANES
    for (int l = 0; l < lanes; ++l) {
        const double w = width.v[l], h = height.v[l];
        double x = hits.u.v[l] * w - 0.5, y = (1 - hits.v.v[l]) * h - 0.5;
        x = x > 0 ? x : 0;
        x = x < w - 1 ? x : w - 1;
        y = y > 0 ? y : 0;
        y = y < h - 1 ? y : h - 1;
        double x0 = static_cast<double>(static_cast<std::int32_t>(x));
        double y0 = static_cast<double>(static_cast<std::int32_t>(y));
        x0 = x0 < w - 2 ? x0 : w - 2;
        y0 = y0 < h - 2 ? y0 : h - 2;
        const double fx = x - x0, fy = y - y0, all = factor * weight.v[l] * (1 / 65535.0);
        const double lower_right = fx * fy;
        offset.v[l] = 3 * (y0 * w + x0);
        glance.lower_right.v[l] = all * lower_right;
        glance.upper_right.v[l] = all * (fx - lower_right);
        glance.lower_left.v[l] = all * (fy - lower_right);
        glance.upper_left.v[l] = all * (1 - fx - (fy - lower_right));
    }
    glance.textured = 0;
    for (std::uint32_t bits = asked; bits; bits &= bits - 1) {
        const int l = std::countr_zero(bits);
        const Sight &sight = sights[static_cast<std::size_t>(static_cast<std::int64_t>(hits.which.v[l]) + 1)];
        switch (sight.kind) {
        case Sight::Kind::constant:
            for (int c = 0; c < 3; ++c) seen.left[l][c] += factor * weight.v[l] * sight.colour[c];
            break;
        case Sight::Kind::coordinates:
            seen.left[l][0] += factor * weight.v[l] * hits.u.v[l];
            seen.left[l][1] += factor * weight.v[l] * hits.v.v[l];
            seen.left[l][2] += factor * weight.v[l];
            break;
        case Sight::Kind::texture:
            glance.textured |= 1u << l;
            glance.texel[l] = sight.texels + static_cast<std::ptrdiff_t>(offset.v[l]);
            glance.down[l] = 3 * static_cast<std::ptrdiff_t>(sight.width);
            __builtin_prefetch(glance.texel[l]);
            __builtin_prefetch(glance.texel[l] + glance.down[l]);
            break;
        }
    }
}

THREEFOLD_VECTOR
void read(const Glance &glance, Seen &seen) {
    for (std::uint32_t bits = glance.textured; bits; bits &= bits - 1) {
        const int l = std::countr_zero(bits);
        const std::uint16_t *upper = glance.texel[l], *lower = upper + glance.down[l];
        Four left, right;
        std::memcpy(&left, seen.left[l], sizeof left);
        std::memcpy(&right, seen.right[l], sizeof right);
        add(upper, glance.upper_left.v[l], left);
        add(lower, glance.lower_left.v[l], left);
        add(upper + 2, glance.upper_right.v[l], right);
        add(lower + 2, glance.lower_right.v[l], right);
        std::memcpy(seen.left[l], &left, sizeof left);
        std::memcpy(seen.right[l], &right, sizeof right);
    }
}

} // namespace threefold::tracer
