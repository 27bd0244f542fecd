// SPDX-License-Identifier: MIT
// A renderer that is started once and renders one exported job after another. Blender takes a second to start, as long
// as many a small picture takes.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "exporter/adapter.h"
#include "exporter/process/child.h"
#include "exporter/run.h"

namespace threefold {

/// Printed by the program after each job, on a line of its own.
inline constexpr std::string_view session_job_done = "threefold job done", session_job_failed = "threefold job failed";

struct SessionJob {
    std::filesystem::path folder; ///< holds the job's files
    std::filesystem::path log;    ///< what the program says about this job
    std::chrono::milliseconds time_limit{std::chrono::minutes(10)};
    std::function<void(std::string_view)> on_line; ///< called from one thread at a time; may be empty
};

class Session;

/// The programs that one thread has running, one for each renderer. Not for use by two threads at once.
class Sessions {
public:
    Sessions();
    /// Ends the programs.
    ~Sessions();
    Sessions(const Sessions &) = delete;
    Sessions &operator=(const Sessions &) = delete;

    /// As `run_child` of the job alone. The first job's time holds the program's start. A program that failed, ran out
    /// of time or is asked for another number of threads is ended; the next job starts another. A script that failed
    /// ends as exit code 3. The peak of memory is that of all its jobs so far.
    ChildResult render(const Adapter &adapter, const InstalledRenderer &installed,
                       const std::vector<std::string> &thread_arguments, const SessionJob &job);

private:
    std::map<std::string, std::unique_ptr<Session>, std::less<>> running_; ///< by the renderer's name
};

} // namespace threefold
