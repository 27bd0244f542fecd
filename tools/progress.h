// SPDX-License-Identifier: MIT
// One line a renderer on stderr: share done and time left. A terminal is redrawn in place; elsewhere a line now and
// then.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace threefold {

using ProgressClock = std::chrono::steady_clock;

/// How far one renderer has come. Each has its own clock: renderers work side by side, or one after another.
struct ProgressLine {
    std::string name, now;
    double share = 0;

    void update(ProgressClock::time_point time, double new_share, const std::string &new_now);
    /// "40 s left", "done", or nothing while it is too early to tell.
    std::string time_left(ProgressClock::time_point time) const;

private:
    bool begun_ = false;
    ProgressClock::time_point begin_; ///< of the first update
    double share_at_begin_ = 0;       ///< what was there already, from an earlier run perhaps
};

class Progress {
public:
    Progress(std::vector<std::string> names, bool quiet);
    ~Progress();
    Progress(const Progress &) = delete;
    Progress &operator=(const Progress &) = delete;

    void update(const std::string &name, double share, const std::string &now);
    /// A line of text above the bars.
    void print(const std::string &line);
    /// Leaves the bars as they stand and goes to the next line.
    void finish();

private:
    void draw(bool force);

    std::vector<ProgressLine> lines_;
    bool quiet_, terminal_;
    bool drawn_ = false;
    ProgressClock::time_point last_draw_;
};

} // namespace threefold
