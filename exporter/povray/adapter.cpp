// SPDX-License-Identifier: MIT
// How POV-Ray 3.7 talks: its progress, its version, and why it stopped.
#include "exporter/povray/povray.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace threefold {
namespace {

/// Two counts from "<before>a<between>b...".
struct Counts {
    double done, all;
};

std::optional<Counts> read_counts(std::string_view line, std::string_view before, std::string_view between) {
    const auto read = [&line](std::string_view prefix) -> std::optional<double> {
        if (!line.starts_with(prefix)) return std::nullopt;
        line.remove_prefix(prefix.size());
        unsigned long long value = 0;
        const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), value);
        if (error != std::errc()) return std::nullopt;
        line.remove_prefix(static_cast<std::size_t>(end - line.data()));
        return static_cast<double>(value);
    };
    const auto done = read(before);
    if (!done) return std::nullopt;
    const auto all = read(between);
    if (!all || *all <= 0 || *done > *all) return std::nullopt;
    return Counts{*done, *all};
}

/// "Rendering frame 2 of 8 (#2)" when a frame begins, then "Rendered 1024 of 90000 pixels (1%)" with no frame.
std::optional<double> progress(std::string_view line, double last_share, const Exported &exported) {
    const auto frames = static_cast<double>(std::max<std::size_t>(exported.outputs.size(), 1));
    if (const auto frame = read_counts(line, "Rendering frame ", " of "))
        return frame->done < 1 ? std::nullopt : std::optional((frame->done - 1) / frame->all);
    const auto pixels = read_counts(line, "Rendered ", " of ");
    if (!pixels) return std::nullopt;
    const double frame = std::clamp(std::floor(last_share * frames + 1e-6), 0.0, frames - 1);
    const double within = pixels->done / pixels->all;
    // A frame's end is not yet the next frame's start: POV-Ray may repeat its last line.
    return (frame + (frame + 1 < frames ? std::min(within, 0.999) : within)) / frames;
}

/// "POV-Ray 3.7.0.10.unofficial"
std::string parse_version(std::string_view output) {
    constexpr std::string_view name = "POV-Ray ";
    for (std::size_t at = output.find(name); at != std::string_view::npos; at = output.find(name, at + 1)) {
        const std::string_view rest = output.substr(at + name.size());
        if (rest.empty() || rest.front() < '0' || rest.front() > '9') continue;
        return std::string(rest.substr(0, rest.find_first_of(" \t\r\n")));
    }
    return {};
}

/// A message goes on in lines that begin with one space, since POV-Ray wraps at 80 columns.
std::string message_at(std::string_view log, std::size_t found) {
    const std::size_t before = log.find_last_of("\r\n", found);
    std::string_view rest = log.substr(before == std::string_view::npos ? 0 : before + 1);
    std::string message;
    while (true) {
        const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
        message += rest.substr(0, end);
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (rest.size() < 2 || rest[0] != ' ' || rest[1] == ' ') return message;
    }
}

std::string explain_failure(std::string_view log) {
    for (const std::string_view sign :
         {"Parse Error:", "Fatal error", "Problem with option", "Cannot open", "Failed to"})
        if (const std::size_t found = log.find(sign); found != std::string_view::npos) return message_at(log, found);
    return {};
}

/// "Trace Time: ... (65.649 seconds)", and on the next line "using 2 thread(s) with 90.633 CPU-seconds total", once a
/// frame.
std::optional<double> own_cpu_seconds(std::string_view log) {
    constexpr std::string_view unit = " CPU-seconds total";
    std::optional<double> sum;
    for (std::size_t at = log.find("Trace Time:"); at != log.npos; at = log.find("Trace Time:", at + 1)) {
        const std::size_t end = log.find(unit, at);
        const std::size_t with = end == log.npos ? log.npos : log.rfind(" with ", end);
        if (with == log.npos || with < at) return std::nullopt;
        double seconds = 0;
        const char *first = log.data() + with + 6;
        if (std::from_chars(first, log.data() + end, seconds).ec != std::errc()) return std::nullopt;
        sum = sum.value_or(0) + seconds;
    }
    return sum;
}

} // namespace

Adapter povray_adapter() {
    return {.name = "povray",
            .title = "POV-Ray",
            .program = "povray",
            .package = "povray",
            .compile = compile_povray,
            .progress = progress,
            .version_argument = "--version",
            .parse_version = parse_version,
            .explain_failure = explain_failure,
            .sample_factor = 1,
            .rendering_begins = [](std::string_view line) { return line.starts_with("==== [Rendering"); },
            .sleeps_between_pictures = true,
            .own_cpu_seconds = own_cpu_seconds};
}

} // namespace threefold
