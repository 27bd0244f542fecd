// SPDX-License-Identifier: MIT
#include "exporter/files.h"

#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "exporter/descriptor.h"
#include "exporter/sha1.h"
#include "scenes/error.h"

namespace threefold {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void throw_failed(std::string_view action, const fs::path &path, int error) {
    if (error == ENOSPC || error == EDQUOT)
        throw Error(Exit::input_output, fmt::format("cannot {} {}: the disk is full", action, path.string()),
                    "free some space, or choose another folder");
    throw Error(Exit::input_output,
                fmt::format("cannot {} {}: {}", action, path.string(), std::generic_category().message(error)));
}

fs::path folder_of(const fs::path &path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

/// A new empty file in `folder`. Its name does not contain the final one, which may be as long as names can be.
int open_temporary(const fs::path &folder, fs::path &name) {
    static std::atomic<unsigned> counter{0};
    for (;;) {
        name = folder / fmt::format(".threefold-{}-{}.part", ::getpid(), counter++);
        const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0 || errno != EEXIST) return descriptor;
    }
}

void write_device(const fs::path &path, std::string_view bytes) {
    Descriptor device(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (device.number() < 0 || !write_all(device.number(), bytes) || !device.close())
        throw_failed("write", path, errno);
}

void replace_file(const fs::path &target, const fs::path &path, std::string_view bytes) {
    fs::path temporary;
    Descriptor file(open_temporary(folder_of(target), temporary));
    if (file.number() < 0) throw_failed("write", path, errno);
    if (!write_all(file.number(), bytes) || ::fsync(file.number()) != 0 || !file.close() ||
        ::rename(temporary.c_str(), target.c_str()) != 0) {
        const int error = errno;
        ::unlink(temporary.c_str());
        throw_failed("write", path, error);
    }
    // The file is whole by now. Not every file system can sync a folder, so a failure here is none of the file's.
    const Descriptor folder(::open(folder_of(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder.number() >= 0) ::fsync(folder.number());
}

} // namespace

void write_file_atomically(const fs::path &path, std::string_view bytes) {
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    if (fs::is_directory(status)) throw_failed("write", path, EISDIR);
    if (fs::exists(status) && !fs::is_regular_file(status)) return write_device(path, bytes);
    std::error_code unresolved;
    const fs::path target = fs::is_symlink(fs::symlink_status(path, ignored)) ? fs::canonical(path, unresolved) : path;
    replace_file(unresolved ? path : target, path, bytes);
}

std::string read_file(const fs::path &path) {
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.number() < 0) throw_failed("read", path, errno);
    std::string bytes;
    char buffer[1 << 16];
    for (;;) {
        const ssize_t count = ::read(file.number(), buffer, sizeof buffer);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw_failed("read", path, errno);
        if (count == 0) return bytes;
        bytes.append(buffer, static_cast<std::size_t>(count));
    }
}

std::int64_t require_readable_file(const fs::path &path) {
    // Without O_NONBLOCK the opening of a named pipe would wait for its writer.
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    struct stat status {};
    if (file.number() < 0 || ::fstat(file.number(), &status) != 0) throw_failed("read", path, errno);
    if (S_ISDIR(status.st_mode)) throw_failed("read", path, EISDIR);
    if (!S_ISREG(status.st_mode))
        throw Error(Exit::input_output, fmt::format("cannot read {}: it is not a regular file", path.string()));
    return status.st_size;
}

void make_folder(const fs::path &path) {
    const fs::path folder = path.empty() ? fs::path(".") : path;
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw_failed("make folder", folder, error.value());
    if (::access(folder.c_str(), W_OK | X_OK) != 0) throw_failed("write to folder", folder, errno);
}

std::string content_hash(std::string_view bytes) { return sha1(bytes); }

} // namespace threefold
