// SPDX-License-Identifier: MIT
#include "exporter/sha1.h"

#include <array>
#include <bit>
#include <cstdint>

#include <fmt/format.h>

namespace threefold {
namespace {

using State = std::array<std::uint32_t, 5>;

constexpr std::size_t block_bytes = 64;

void take_block(State &state, const char *block) {
    std::array<std::uint32_t, 80> w;
    for (std::size_t t = 0; t < 16; ++t) {
        w[t] = 0;
        for (std::size_t i = 0; i < 4; ++i) w[t] = w[t] << 8 | static_cast<unsigned char>(block[4 * t + i]);
    }
    for (std::size_t t = 16; t < 80; ++t) w[t] = std::rotl(w[t - 3] ^ w[t - 8] ^ w[t - 14] ^ w[t - 16], 1);
    auto [a, b, c, d, e] = state;
    const auto rounds = [&](std::size_t from, std::uint32_t k, auto f) {
        for (std::size_t t = from; t < from + 20; ++t) {
            const std::uint32_t next = std::rotl(a, 5) + f(b, c, d) + e + k + w[t];
            e = d;
            d = c;
            c = std::rotl(b, 30);
            b = a;
            a = next;
        }
    };
    using Word = std::uint32_t;
    const auto choose = [](Word x, Word y, Word z) { return (x & y) ^ (~x & z); };
    const auto parity = [](Word x, Word y, Word z) { return x ^ y ^ z; };
    const auto majority = [](Word x, Word y, Word z) { return (x & y) ^ (x & z) ^ (y & z); };
    rounds(0, 0x5a827999, choose);
    rounds(20, 0x6ed9eba1, parity);
    rounds(40, 0x8f1bbcdc, majority);
    rounds(60, 0xca62c1d6, parity);
    state = {state[0] + a, state[1] + b, state[2] + c, state[3] + d, state[4] + e};
}

} // namespace

std::string sha1(std::string_view bytes) {
    State state{0x67452301, 0xefcdab89, 0x98badcfe, 0x10325476, 0xc3d2e1f0};
    const std::uint64_t bits = std::uint64_t{8} * bytes.size();
    while (bytes.size() >= block_bytes) {
        take_block(state, bytes.data());
        bytes.remove_prefix(block_bytes);
    }
    // The rest, a one, zeros, and the length in bits.
    std::string end(bytes);
    end += '\x80';
    while (end.size() % block_bytes != block_bytes - 8) end += '\0';
    for (int shift = 56; shift >= 0; shift -= 8) end += static_cast<char>(bits >> shift & 255);
    for (std::size_t i = 0; i < end.size(); i += block_bytes) take_block(state, end.data() + i);
    return fmt::format("{:08x}{:08x}{:08x}{:08x}{:08x}", state[0], state[1], state[2], state[3], state[4]);
}

} // namespace threefold
