// SPDX-License-Identifier: MIT
// Files that appear whole or not at all (write beside, fsync, rename), and content hashes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace threefold {

/// Throws Error(input_output) with the file's name and the system's reason; a failed write leaves what was there
/// before, whole. A symbolic link is followed; a device or pipe (/dev/stdout) is written to, never replaced.
void write_file_atomically(const std::filesystem::path &path, std::string_view bytes);
std::string read_file(const std::filesystem::path &path);
/// The size in bytes of a regular file that can be opened; throws Error(input_output) for anything else.
std::int64_t require_readable_file(const std::filesystem::path &path);
/// Makes the folder (and its parents); throws Error(input_output) when it cannot be made or written to.
void make_folder(const std::filesystem::path &path);
/// 40 hexadecimal digits (SHA-1): a name for content, not a defence.
std::string content_hash(std::string_view bytes);

} // namespace threefold
