// SPDX-License-Identifier: MIT
#include "scenes/figure/stored_figure.h"

#include <cstring>

// The assembler takes the file in as it is: millions of numbers as C++ text would take the compiler half a minute.
asm(".pushsection .rodata, \"a\", %progbits\n"
    ".balign 16\n"
    ".hidden threefold_stored_figure\n"
    ".global threefold_stored_figure\n"
    "threefold_stored_figure:\n"
    ".incbin \"stored_figure.bin\"\n"
    ".popsection\n");

extern "C" __attribute__((visibility("hidden"))) const unsigned char threefold_stored_figure[];

namespace threefold::figure {

namespace {

StoredCounts stored_counts() {
    StoredCounts counts;
    std::memcpy(&counts, threefold_stored_figure, sizeof counts);
    return counts;
}

template <class T>
std::vector<T> stored_list(std::size_t offset, std::uint64_t count) {
    std::vector<T> list(count);
    std::memcpy(static_cast<void *>(list.data()), threefold_stored_figure + offset, count * sizeof(T));
    return list;
}

std::size_t heights_at(const StoredCounts &n) { return sizeof n + n.hand_vertices * sizeof(Vec3); }
std::size_t triangles_at(const StoredCounts &n) { return heights_at(n) + n.heights * sizeof(double); }
std::size_t relief_at(const StoredCounts &n) { return triangles_at(n) + n.hand_triangles * sizeof(glm::uvec3); }

std::size_t robe_at(const StoredCounts &n) { return relief_at(n) + n.relief_samples * sizeof(std::uint16_t); }

} // namespace

Mesh stored_hand_shape() {
    const StoredCounts n = stored_counts();
    Mesh mesh;
    mesh.vertices_mm = stored_list<Vec3>(sizeof n, n.hand_vertices);
    mesh.triangles = stored_list<glm::uvec3>(triangles_at(n), n.hand_triangles);
    return mesh;
}

std::vector<double> stored_heights() {
    const StoredCounts n = stored_counts();
    return stored_list<double>(heights_at(n), n.heights);
}

std::vector<std::uint16_t> stored_relief_texture() {
    const StoredCounts n = stored_counts();
    return stored_list<std::uint16_t>(relief_at(n), n.relief_samples);
}

std::vector<std::uint16_t> stored_robe_texture() {
    const StoredCounts n = stored_counts();
    return stored_list<std::uint16_t>(robe_at(n), n.robe_samples);
}

} // namespace threefold::figure
