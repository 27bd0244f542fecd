// SPDX-License-Identifier: MIT
#include "exporter/mesh/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

#include "exporter/files.h"
#include "exporter/mesh/assimp_import.h"
#include "exporter/mesh/obj_import.h"
#include "exporter/process/guarded.h"
#include "scenes/error.h"

namespace threefold {
namespace {

[[noreturn]] void throw_bad_mesh(const std::filesystem::path &path, std::string_view reason) {
    throw Error(Exit::bad_data, fmt::format("cannot read mesh {}: {}", path.string(), reason));
}

// What comes from the child: counts, then the three lists as they lie in memory. The same program reads it.
struct Header {
    std::uint64_t vertices, triangles, uv;
};

template <class T>
void append(std::string &bytes, const std::vector<T> &list) {
    bytes.append(reinterpret_cast<const char *>(list.data()), list.size() * sizeof(T));
}

template <class T>
bool take(std::string_view &bytes, std::uint64_t count, std::vector<T> &list) {
    if (count > bytes.size() / sizeof(T)) return false;
    list.resize(count);
    if (count > 0) // an empty list has no address
        std::memcpy(static_cast<void *>(list.data()), bytes.data(), count * sizeof(T));
    bytes.remove_prefix(count * sizeof(T));
    return true;
}

std::string pack(const Mesh &mesh) {
    const Header header{mesh.vertices_mm.size(), mesh.triangles.size(), mesh.uv.size()};
    std::string bytes(reinterpret_cast<const char *>(&header), sizeof header);
    append(bytes, mesh.vertices_mm);
    append(bytes, mesh.triangles);
    append(bytes, mesh.uv);
    return bytes;
}

/// A child that a bad file led astray may have written anything.
bool unpack(std::string_view bytes, Mesh &mesh) {
    Header header;
    if (bytes.size() < sizeof header) return false;
    std::memcpy(&header, bytes.data(), sizeof header);
    bytes.remove_prefix(sizeof header);
    if (!take(bytes, header.vertices, mesh.vertices_mm) || !take(bytes, header.triangles, mesh.triangles) ||
        !take(bytes, header.uv, mesh.uv) || !bytes.empty())
        return false;
    const auto finite = [](Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
    return (mesh.uv.empty() || mesh.uv.size() == mesh.vertices_mm.size()) &&
           std::ranges::all_of(mesh.vertices_mm, finite) &&
           std::ranges::all_of(mesh.triangles, [n = mesh.vertices_mm.size()](const glm::uvec3 &t) {
               return std::max({t.x, t.y, t.z}) < n;
           });
}

bool is_obj(const std::filesystem::path &path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    return extension == ".obj";
}

} // namespace

Mesh read_mesh(const std::filesystem::path &path) {
    if (require_readable_file(path) == 0) throw_bad_mesh(path, "the file is empty");
    const GuardedResult result = run_guarded(
        {.work = [&] { return pack(is_obj(path) ? import_obj(path.string()) : import_with_assimp(path.string())); }});
    if (!result.succeeded) throw_bad_mesh(path, result.failure);
    Mesh mesh;
    if (!unpack(result.bytes, mesh)) throw_bad_mesh(path, "its reader went astray");
    return mesh;
}

} // namespace threefold
