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

/// Of all the work, what must have been seen before the rest is told from it.
constexpr double least_share_seen = 0.02;

} // namespace

void ProgressLine::update(ProgressClock::time_point time, double new_share, const std::string &new_now) {
    share = std::clamp(new_share, share, 1.0);
    now = new_now;
    if (begun_) return;
    begun_ = true;
    begin_ = time;
    share_at_begin_ = share;
}

std::string ProgressLine::time_left(ProgressClock::time_point time) const {
    if (share >= 1) return "done";
    const double seen = share - share_at_begin_;
    if (!begun_ || seen <= least_share_seen) return "";
    const double seconds = std::chrono::duration<double>(time - begin_).count();
    const auto left = static_cast<long long>(seconds / seen * (1 - share) + 0.5);
    return left >= 60 ? fmt::format("{} min {:02} s left", left / 60, left % 60) : fmt::format("{} s left", left);
}

Progress::Progress(std::vector<std::string> names, bool quiet)
    : quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) && std::getenv("TERM") && std::string_view(std::getenv("TERM")) != "dumb"),
      last_draw_(ProgressClock::now()) {
    lines_.resize(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) lines_[i].name = std::move(names[i]);
}

Progress::~Progress() { finish(); }

void Progress::update(const std::string &name, double share, const std::string &now) {
    for (ProgressLine &line : lines_)
        if (line.name == name) line.update(ProgressClock::now(), share, now);
    draw(false);
}

void Progress::draw(bool force) {
    if (quiet_) return;
    const auto time = ProgressClock::now();
    std::string text;
    if (terminal_) {
        if (!force && drawn_ && time - last_draw_ < redraw_after) return;
        if (drawn_) text += fmt::format("\033[{}A", lines_.size());
        for (const ProgressLine &line : lines_) {
            const int full = static_cast<int>(line.share * bar_width);
            text += fmt::format("\r{:<8} [{:#<{}}{:.<{}}] {:3.0f} %  {:<16} {}\033[K\n", line.name, "", full, "",
                                bar_width - full, 100 * line.share, line.now, line.time_left(time));
        }
    } else {
        if (!force && time - last_draw_ < log_after) return;
        std::string all;
        for (const ProgressLine &line : lines_)
            all += fmt::format("{}{} {:.0f} % {}", all.empty() ? "" : " | ", line.name, 100 * line.share,
                               line.time_left(time));
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
