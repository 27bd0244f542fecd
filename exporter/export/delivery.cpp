// SPDX-License-Identifier: MIT
#include "exporter/export/delivery.h"

#include <algorithm>
#include <cstring>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "exporter/files.h"
#include "exporter/text.h"
#include "scenes/error.h"

namespace threefold {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_stem = 60;

/// The folder itself or the nearest above it that is there.
fs::path nearest_existing(fs::path folder) {
    std::error_code ignored;
    while (!fs::exists(fs::symlink_status(folder, ignored))) {
        if (!folder.has_parent_path() || folder == folder.parent_path()) return ".";
        folder = folder.parent_path();
    }
    return folder;
}

/// `folder` and those above it that are not there yet, the outermost first.
std::vector<fs::path> missing_folders(fs::path folder) {
    std::vector<fs::path> missing;
    std::error_code ignored;
    while (!folder.empty() && !fs::exists(folder, ignored)) {
        if (folder.has_filename()) missing.insert(missing.begin(), folder);
        if (folder == folder.parent_path()) break;
        folder = folder.parent_path();
    }
    return missing;
}

} // namespace

std::string to_text(const Provenance &p) {
    std::string text = fmt::format("Made by Threefold {}.\n\nscene        {}\npreset       {}\nscene hash   {}\n",
                                   one_line(p.version), one_line(p.scene), one_line(p.preset), p.scene_hash);
    text += "parameters\n";
    for (const auto &[name, value] : p.parameters)
        text += fmt::format("  {} = {}\n", one_line(name), value.empty() ? "(generated)" : one_line(value));
    text += fmt::format("\nThis export again:\n  {}\n", one_line(p.export_command));
    if (!p.render_command.empty())
        text += fmt::format("The picture that Threefold judges, to compare with:\n  {}\n", one_line(p.render_command));
    return text;
}

std::string ExportJob::stem() const {
    std::string stem = provenance.scene.substr(0, longest_stem);
    std::ranges::replace_if(
        stem,
        [](char c) {
            return !((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
                     c == '-');
        },
        '_');
    return stem.empty() ? "scene" : stem.front() == '-' ? "_" + stem.substr(1) : stem;
}

void require_fresh_folder(const fs::path &folder) {
    if (folder.empty()) throw Error(Exit::usage, "the folder to export to has no name");
    const fs::path there = nearest_existing(folder);
    std::error_code error;
    if (!fs::is_directory(there, error))
        throw Error(Exit::input_output,
                    fmt::format("cannot export to {}: {} is not a folder", folder.string(), there.string()));
    const auto throw_system = [&](int number) {
        throw Error(Exit::input_output,
                    fmt::format("cannot export to {}: {}: {}", folder.string(), there.string(), std::strerror(number)));
    };
    if (::access(there.c_str(), W_OK | X_OK) != 0) throw_system(errno);
    if (!fs::exists(folder, error)) return;
    const bool empty = fs::is_empty(folder, error);
    if (error) throw_system(error.value());
    if (!empty)
        throw Error(Exit::input_output, fmt::format("cannot export to {}: the folder is not empty", folder.string()),
                    "choose a new folder, or empty this one");
}

void write_fresh_folder(const fs::path &folder, const std::vector<ExportedFile> &files) {
    require_fresh_folder(folder);
    const std::vector<fs::path> made = missing_folders(folder);
    std::vector<fs::path> written;
    try {
        make_folder(folder);
        for (const ExportedFile &file : files) {
            if (fs::path(file.name).filename() != file.name || file.name.empty() || file.name.starts_with("."))
                throw Error(Exit::internal, fmt::format("'{}' is not a plain file name", file.name));
            write_file_atomically(folder / file.name, file.bytes);
            written.push_back(folder / file.name);
        }
    } catch (...) {
        std::error_code ignored;
        for (const fs::path &file : written) fs::remove(file, ignored);
        for (auto one = made.rbegin(); one != made.rend(); ++one) fs::remove(*one, ignored); // only if empty
        throw;
    }
}

} // namespace threefold
