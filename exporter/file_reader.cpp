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

#include <sys/stat.h>

#include "exporter/image/texture_file.h"
#include "exporter/mesh/mesh_file.h"

namespace threefold {
namespace {

namespace fs = std::filesystem;

/// A file as it was when it was read.
struct Version {
    std::string path; ///< absolute
    // Two files written within one tick of the clock may be of one size and time; the second one is another file.
    dev_t device;
    ino_t number;
    off_t bytes;
    std::int64_t changed_s, changed_ns;
    double gamma = 0;

    auto operator<=>(const Version &) const = default;
};

/// Nothing where the file cannot be looked at: its reader says why.
std::optional<Version> version_of(const std::string &path, double gamma = 0) {
    std::error_code bad_path;
    const std::string absolute = fs::absolute(path, bad_path).string();
    struct stat found {};
    if (bad_path || ::stat(path.c_str(), &found) != 0) return std::nullopt;
    return Version{absolute, found.st_dev, found.st_ino, found.st_size, found.st_mtim.tv_sec, found.st_mtim.tv_nsec,
                   gamma};
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
