// SPDX-License-Identifier: MIT
// Eight numbers, vectors or rays side by side, and how a function over them is compiled.
//
// Loops over the lanes are written so that the compiler turns them into vector instructions. Functions marked
// THREEFOLD_VECTOR are compiled for several instruction sets, of which the loader takes the best that the machine has;
// without contraction of products and sums all of them give the same bits. Sources that use the marks are listed in
// CMakeLists.txt.
#pragma once

#include <cstdint>

#include "scenes/scene.h"

// The vectoriser sees whole loops: helpers are inlined by force.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define THREEFOLD_VECTOR __attribute__((target_clones("arch=skylake-avx512", "avx2", "default")))
#else
#define THREEFOLD_VECTOR
#endif
#define THREEFOLD_LANES _Pragma("omp simd")
#define THREEFOLD_INLINE inline __attribute__((always_inline))

namespace threefold::tracer {

inline constexpr int lanes = 8;
inline constexpr std::uint32_t all_lanes = (1u << lanes) - 1;

struct alignas(64) Lanes {
    double v[lanes];
    double &operator[](int lane) { return v[lane]; }
    double operator[](int lane) const { return v[lane]; }
};

struct LaneVectors {
    Lanes x, y, z;
    Vec3 at(int lane) const { return {x[lane], y[lane], z[lane]}; }
    void put(int lane, Vec3 p) {
        x[lane] = p.x;
        y[lane] = p.y;
        z[lane] = p.z;
    }
};

/// Every lane holds a ray, of use or not.
struct RayPacket {
    LaneVectors origin, direction;
};

} // namespace threefold::tracer
