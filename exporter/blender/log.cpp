// SPDX-License-Identifier: MIT
#include "exporter/blender/log.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <system_error>

namespace threefold {

namespace {

/// "<label>A<separator>B" anywhere in the line.
struct Pair {
    int first, second;
};

std::optional<Pair> find_pair(std::string_view line, std::string_view label, std::string_view separator) {
    const auto at = line.find(label);
    if (at == std::string_view::npos) return std::nullopt;
    line.remove_prefix(at + label.size());
    Pair pair{};
    const auto first = std::from_chars(line.data(), line.data() + line.size(), pair.first);
    if (first.ec != std::errc()) return std::nullopt;
    line.remove_prefix(static_cast<std::size_t>(first.ptr - line.data()));
    if (!line.starts_with(separator)) return std::nullopt;
    line.remove_prefix(separator.size());
    const auto second = std::from_chars(line.data(), line.data() + line.size(), pair.second);
    if (second.ec != std::errc() || pair.first < 0 || pair.second < 1 || pair.first > pair.second) return std::nullopt;
    return pair;
}

/// "NameError: ...": how the last line of a Python traceback looks. "Error: ..." is Blender's own.
bool names_error(std::string_view line) {
    std::size_t name = 0;
    while (name < line.size() &&
           (std::isalnum(static_cast<unsigned char>(line[name])) || line[name] == '_' || line[name] == '.'))
        ++name;
    const std::string_view kind = line.substr(0, name);
    return line.substr(name).starts_with(": ") && (kind.ends_with("Error") || kind.ends_with("Exception"));
}

} // namespace

std::optional<double> cycles_progress(std::string_view line, double last_share, const Exported &exported) {
    if (line == "threefold done") return 1;
    if (line.starts_with("threefold replicate "))
        if (const auto at = find_pair(line, "threefold replicate ", " of "))
            return static_cast<double>(at->first - 1) / at->second;
    if (const auto at = find_pair(line, "Sample ", "/")) {
        const double replicates = static_cast<double>(exported.outputs.size());
        constexpr double unfinished = 0.999; // a replicate ends with the script's next line, never before
        const double done = std::floor(last_share * replicates + 1e-9);
        return std::max(last_share, std::min(1.0, (done + unfinished * at->first / at->second) / replicates));
    }
    return std::nullopt;
}

std::string parse_blender_version(std::string_view output) {
    constexpr std::string_view label = "Blender ";
    const auto at = output.find(label);
    if (at == std::string_view::npos) return {};
    output.remove_prefix(at + label.size());
    const auto end = output.find_first_not_of("0123456789.");
    return std::string(output.substr(0, end));
}

std::string explain_blender_failure(std::string_view log) {
    std::string_view best;
    while (!log.empty()) {
        const auto end = log.find_first_of("\r\n");
        if (const std::string_view line = log.substr(0, end);
            names_error(line) && line.find("script failed") == line.npos) // Blender's last word, which explains nothing
            best = line;
        if (end == std::string_view::npos) break;
        log.remove_prefix(end + 1);
    }
    return std::string(best);
}

} // namespace threefold
