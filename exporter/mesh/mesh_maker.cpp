// SPDX-License-Identifier: MIT
#include "exporter/mesh/mesh_maker.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "exporter/mesh/triangulate.h"

namespace threefold {

namespace {

constexpr std::uint32_t empty = std::numeric_limits<std::uint32_t>::max();

std::size_t hash(Vec3 p, Vec2 uv) {
    std::uint64_t h = 0;
    for (const double x : {p.x, p.y, p.z, uv.x, uv.y}) {
        h = (h ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15; // 2^64 over the golden ratio
        h ^= h >> 29;
    }
    return h;
}

} // namespace

MeshMaker::MeshMaker(std::size_t corners, bool with_uv)
    : with_uv_(with_uv), slots_(std::bit_ceil(std::max<std::size_t>(16, 2 * corners)), empty) {}

std::uint32_t MeshMaker::vertex(Vec3 place, Vec2 uv) {
    const Vec3 p = place + 0.0; // -0 is 0
    for (std::size_t slot = hash(p, uv) & (slots_.size() - 1);; slot = (slot + 1) & (slots_.size() - 1)) {
        if (slots_[slot] == empty) {
            slots_[slot] = static_cast<std::uint32_t>(mesh_.vertices_mm.size());
            mesh_.vertices_mm.push_back(p);
            if (with_uv_) mesh_.uv.push_back(uv);
            return slots_[slot];
        }
        const std::uint32_t known = slots_[slot];
        if (mesh_.vertices_mm[known] == p && (!with_uv_ || mesh_.uv[known] == uv)) return known;
    }
}

void MeshMaker::add(std::span<const Vec3> places, std::span<const Vec2> uv) {
    if (places.size() < 3) return;
    any_ = true;
    const auto one = [&](std::size_t i) { return vertex(places[i], with_uv_ ? uv[i] : Vec2(0)); };
    const auto put = [&](std::size_t a, std::size_t b, std::size_t c) {
        const std::uint32_t x = one(a), y = one(b), z = one(c);
        mesh_.triangles.emplace_back(x, y, z);
    };
    if (places.size() > 3) {
        for (const auto &[a, b, c] : triangulate(places)) put(a, b, c);
    } else if (glm::cross(places[1] - places[0], places[2] - places[0]) != Vec3(0)) {
        put(0, 1, 2);
    }
}

Mesh MeshMaker::take() {
    if (!any_) throw std::runtime_error("it has no triangles");
    if (mesh_.triangles.empty()) throw std::runtime_error("none of its triangles has an area");
    return std::move(mesh_);
}

Vec2 uv_in_file(double u, double v) {
    if (!std::isfinite(u) || !std::isfinite(v))
        throw std::runtime_error(fmt::format("a texture coordinate is not finite: ({}, {})", u, v));
    constexpr double rounding = 1e-6;
    const auto snapped = [](double x) { return x > -rounding && x < 1 + rounding ? std::clamp(x, 0.0, 1.0) : x; };
    return {snapped(u), snapped(v)};
}

} // namespace threefold
