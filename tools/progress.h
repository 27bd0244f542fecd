// SPDX-License-Identifier: MIT
// One line a renderer on stderr: share done and time left. A terminal is redrawn in place; elsewhere a line now and
// then.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace threefold {

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
    using Clock = std::chrono::steady_clock;
    struct Line {
        std::string name, now;
        double share = 0;
        double seconds = 0; ///< while this renderer was at work
    };

    void draw(bool force);

    std::vector<Line> lines_;
    bool quiet_, terminal_;
    bool drawn_ = false;
    Clock::time_point last_update_, last_draw_;
};

} // namespace threefold
