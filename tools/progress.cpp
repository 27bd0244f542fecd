// SPDX-License-Identifier: MIT
#include "tools/progress.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <unistd.h>

#include <fmt/format.h>

namespace threefold {

namespace {

constexpr int bar_width = 24;
constexpr auto redraw_after = std::chrono::milliseconds(80);
constexpr auto log_after = std::chrono::seconds(10);

std::string time_left(double share, double seconds) {
    if (share >= 1) return "done";
    if (share <= 0.02) return "";
    const int left = static_cast<int>(seconds / share * (1 - share) + 0.5);
    return left >= 60 ? fmt::format("{} min {:02} s left", left / 60, left % 60) : fmt::format("{} s left", left);
}

} // namespace

Progress::Progress(std::vector<std::string> names, bool quiet)
    : quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) && std::getenv("TERM") && std::string_view(std::getenv("TERM")) != "dumb"),
      last_update_(Clock::now()), last_draw_(Clock::now()) {
    for (std::string &name : names) lines_.push_back({std::move(name), "", 0, 0});
}

Progress::~Progress() { finish(); }

void Progress::update(const std::string &name, double share, const std::string &now) {
    const auto time = Clock::now();
    for (Line &line : lines_)
        if (line.name == name) {
            line.seconds += std::chrono::duration<double>(time - last_update_).count();
            line.share = std::clamp(share, line.share, 1.0);
            line.now = now;
        }
    last_update_ = time;
    draw(false);
}

void Progress::draw(bool force) {
    if (quiet_) return;
    const auto time = Clock::now();
    std::string text;
    if (terminal_) {
        if (!force && drawn_ && time - last_draw_ < redraw_after) return;
        if (drawn_) text += fmt::format("\033[{}A", lines_.size());
        for (const Line &line : lines_) {
            const int full = static_cast<int>(line.share * bar_width);
            text += fmt::format("\r{:<8} [{:#<{}}{:.<{}}] {:3.0f} %  {:<16} {}\033[K\n", line.name, "", full, "",
                                bar_width - full, 100 * line.share, line.now, time_left(line.share, line.seconds));
        }
    } else {
        if (!force && time - last_draw_ < log_after) return;
        std::string all;
        for (const Line &line : lines_)
            all += fmt::format("{}{} {:.0f} % {}", all.empty() ? "" : " | ", line.name, 100 * line.share,
                               time_left(line.share, line.seconds));
        text = all + "\n";
    }
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
    drawn_ = true;
    last_draw_ = time;
}

void Progress::print(const std::string &line) {
    if (quiet_) return;
    std::string text;
    if (terminal_ && drawn_) text += fmt::format("\033[{}A\r\033[J", lines_.size());
    text += line + "\n";
    std::fputs(text.c_str(), stderr);
    if (terminal_ && drawn_) {
        drawn_ = false; // the bars begin anew below the line
        draw(true);
    }
    std::fflush(stderr);
}

void Progress::finish() {
    if (drawn_) draw(true);
    quiet_ = true;
}

} // namespace threefold
