// SPDX-License-Identifier: MIT
#include "exporter/file_reader.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "exporter/image/texture_file.h"
#include "exporter/mesh/mesh_file.h"

namespace threefold {
namespace {

namespace fs = std::filesystem;

/// A file as it was when it was read.
struct Version {
    std::string path; ///< absolute
    std::uintmax_t bytes;
    fs::file_time_type changed;
    double gamma = 0;

    auto operator<=>(const Version &) const = default;
};

/// Nothing where the file cannot be looked at: its reader says why.
std::optional<Version> version_of(const std::string &path, double gamma = 0) {
    std::error_code bad_path, bad_size, bad_time;
    Version version{fs::absolute(path, bad_path).string(), fs::file_size(path, bad_size),
                    fs::last_write_time(path, bad_time), gamma};
    if (bad_path || bad_size || bad_time) return std::nullopt;
    return version;
}

/// A claim builds its scene a dozen times. Only the last few files are kept: a picture may be as large as memory.
template <class Value>
class Cache {
public:
    template <class Read>
    Value get(const std::optional<Version> &version, Read read) {
        const std::lock_guard lock(mutex_);
        if (!version) return read();
        for (const auto &[known, value] : values_)
            if (known == *version) return value;
        Value value = read();
        if (values_.size() == most) values_.erase(values_.begin());
        values_.emplace_back(*version, value);
        return value;
    }

private:
    static constexpr std::size_t most = 4;
    std::mutex mutex_;
    std::vector<std::pair<Version, Value>> values_;
};

Mesh mesh_of(const std::string &path) {
    static Cache<std::shared_ptr<const Mesh>> cache;
    return *cache.get(version_of(path), [&] { return std::make_shared<const Mesh>(read_mesh(path)); });
}

std::shared_ptr<const Texture> texture_of(const std::string &path, double gamma) {
    static Cache<std::shared_ptr<const Texture>> cache;
    return cache.get(version_of(path, gamma), [&] { return read_texture(path, gamma); });
}

} // namespace

const FileReader &file_reader() {
    static const FileReader reader{mesh_of, texture_of};
    return reader;
}

} // namespace threefold
