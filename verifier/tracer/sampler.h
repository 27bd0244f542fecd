// SPDX-License-Identifier: MIT
// Where in a pixel the samples lie: the Sobol (0,2)-sequence, Owen-scrambled by hashing, and two plainer ways to
// compare it with. Burley, Practical Hash-based Owen Scrambling, JCGT 9(4), 2020.
#pragma once

#include <cstdint>

#include "scenes/scene.h"

namespace threefold {

/// `stratified`: one position at random in each cell of a grid, as square as the number of samples allows. `random`:
/// independent positions.
enum class Sampler { sobol, stratified, random };

namespace tracer {

/// A well-mixing hash of 64 bits (SplitMix64, Steele et al. 2014).
constexpr std::uint64_t mix(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// Scrambles the bits of a fraction as a random tree of swaps does (Laine and Karras' hash, Burley's constants).
constexpr std::uint32_t owen_scramble(std::uint32_t x, std::uint32_t seed) {
    x = reverse_bits(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reverse_bits(x);
}

/// Sobol's second dimension of the k-th point. Its matrix is Pascal's triangle modulo 2, and entry (i, p) of that is
/// odd where the bits of p are among those of i (Lucas): a sum over supersets, bit by bit of the index.
constexpr std::uint32_t second_dimension(std::uint32_t k) {
    std::uint32_t x = reverse_bits(k);
    x ^= (x << 1) & 0xaaaaaaaau;
    x ^= (x << 2) & 0xccccccccu;
    x ^= (x << 4) & 0xf0f0f0f0u;
    x ^= (x << 8) & 0xff00ff00u;
    x ^= (x << 16) & 0xffff0000u;
    return x;
}

/// The sequence of one pixel in one replicate.
class PixelSampler {
public:
    PixelSampler(std::uint64_t seed, int column, int row)
        : key_(mix(seed ^ mix((static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)) << 32) |
                              static_cast<std::uint32_t>(column)))) {}

    /// Of so many samples; without this, by Sobol's sequence.
    void use(Sampler kind, std::int64_t samples) {
        kind_ = kind;
        if (kind != Sampler::stratified) return;
        columns_ = 1;
        for (std::int64_t n = 1; n * n <= samples; ++n)
            if (samples % n == 0) columns_ = static_cast<std::uint32_t>(n);
        rows_ = static_cast<std::uint32_t>(samples / columns_);
    }
    bool is_sobol() const { return kind_ == Sampler::sobol; }

    /// The k-th position in the unit square.
    Vec2 position(std::uint32_t k) const {
        if (kind_ != Sampler::sobol) {
            const std::uint64_t both = mix(key_ ^ mix(0x9051ull + k));
            const Vec2 at(fraction(static_cast<std::uint32_t>(both)), fraction(static_cast<std::uint32_t>(both >> 32)));
            if (kind_ == Sampler::random) return at;
            return {(at.x + k % columns_) / columns_, (at.y + k / columns_ % rows_) / rows_};
        }
        const std::uint32_t shuffled = owen_scramble(k, key(0));
        return {fraction(owen_scramble(reverse_bits(shuffled), key(1))),
                fraction(owen_scramble(second_dimension(shuffled), key(2)))};
    }

    /// What positions are scrambled by: their order, and the two coordinates.
    std::uint32_t key(int dimension) const {
        return static_cast<std::uint32_t>(dimension == 0 ? key_ : mix(key_ + static_cast<std::uint64_t>(dimension)));
    }

    /// Independent numbers in [0, 1) for choices along a path.
    double next() { return static_cast<double>(mix(key_ + 3 + ++drawn_) >> 11) * 0x1p-53; }

private:
    static double fraction(std::uint32_t x) { return x * 0x1p-32; }

    std::uint64_t key_;
    std::uint64_t drawn_ = 0;
    Sampler kind_ = Sampler::sobol;
    std::uint32_t columns_ = 1, rows_ = 1;
};

} // namespace tracer
} // namespace threefold
