// SPDX-License-Identifier: MIT
#include "exporter/session.h"

#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <fstream>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "exporter/descriptor.h"
#include "scenes/error.h"

namespace threefold {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// One running program. A thread of its own waits for it, for a child must be waited for by the thread that started it.
class Session {
public:
    Session(const Adapter &adapter, const InstalledRenderer &installed, std::vector<std::string> thread_arguments)
        : adapter_(adapter), thread_arguments_(std::move(thread_arguments)) {
        int ends[2];
        if (::pipe2(ends, O_CLOEXEC) != 0) fail();
        const Descriptor read_end(ends[0]), write_end(ends[1]);
        // Above stdin, stdout and stderr, should ours be closed. Our own read end stays open: then writing to a program
        // that has just ended raises no signal.
        read_end_.open(::fcntl(read_end.number(), F_DUPFD_CLOEXEC, 3));
        write_end_.open(::fcntl(write_end.number(), F_DUPFD_CLOEXEC, 3));
        if (!read_end_.is_open() || !write_end_.is_open()) fail();
        request_.input = read_end_.number();
        request_.program = installed.program;
        request_.arguments = thread_arguments_;
        for (std::string &argument : adapter.session_arguments()) request_.arguments.push_back(std::move(argument));
        request_.time_limit = std::chrono::hours(24 * 365);
        request_.marks = [this](std::string_view line) {
            return is_end(line) || (adapter_.rendering_begins && adapter_.rendering_begins(line));
        };
        request_.on_mark = [this](double cpu_seconds, double peak_memory_mb) {
            const std::lock_guard lock(mutex_);
            used_cpu_seconds_ = cpu_seconds;
            peak_memory_mb_ = peak_memory_mb;
        };
        request_.on_line = [this](std::string_view line) { take(line); };
        request_.should_end = [this] { return should_end_.load(); };
        waiter_ = std::thread([this] { wait_for_program(); });
    }

    ~Session() {
        should_end_ = true;
        waiter_.join();
    }

    bool has_threads(const std::vector<std::string> &thread_arguments) const {
        return thread_arguments == thread_arguments_;
    }

    ChildResult render(const SessionJob &job) {
        const auto start = Clock::now();
        std::unique_lock lock(mutex_);
        job_ = &job;
        log_.open(job.log, std::ios::binary | std::ios::trunc);
        done_.reset();
        begin_cpu_seconds_.reset();
        const double cpu_before = jobs_++ == 0 ? 0 : used_cpu_seconds_;
        // As bytes: a folder's name need not be UTF-8, and JSON's text must be.
        const std::string folder = fs::absolute(job.folder).string();
        const std::string line = nlohmann::json(std::vector<std::uint8_t>(folder.begin(), folder.end())).dump() + "\n";
        if (!write_all(write_end_.number(), line)) throw Error(Exit::internal, "cannot write to a renderer's pipe");
        const bool in_time =
            changed_.wait_for(lock, job.time_limit, [this] { return done_.has_value() || program_.has_value(); });
        job_ = nullptr;
        log_.close();
        if (failure_) std::rethrow_exception(failure_);
        if (!log_) throw Error(Exit::input_output, fmt::format("cannot write log {}", job.log.string()));

        ChildResult result;
        result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
        if (program_) { // it ended in the middle of the job
            result.end = program_->end;
            result.exit_code = program_->exit_code == 0 ? 1 : program_->exit_code;
            result.signal = program_->signal;
            return result;
        }
        if (!in_time) {
            result.end = ChildResult::End::timed_out;
            return result;
        }
        result.exit_code = *done_ ? 0 : 3;
        result.cpu_seconds = used_cpu_seconds_ - cpu_before;
        if (begin_cpu_seconds_) result.cpu_seconds_at_mark = *begin_cpu_seconds_ - cpu_before;
        result.peak_memory_mb = peak_memory_mb_;
        return result;
    }

private:
    [[noreturn]] static void fail() {
        throw Error(Exit::input_output, fmt::format("cannot make a pipe: {}", std::generic_category().message(errno)));
    }

    static bool is_end(std::string_view line) { return line == session_job_done || line == session_job_failed; }

    void wait_for_program() {
        std::optional<ChildResult> result;
        std::exception_ptr failure;
        try {
            result = run_child(request_);
        } catch (...) {
            failure = std::current_exception();
            result.emplace();
        }
        const std::lock_guard lock(mutex_);
        program_ = result;
        failure_ = failure;
        changed_.notify_all();
    }

    void take(std::string_view line) {
        std::unique_lock lock(mutex_);
        if (!job_ || done_) return;
        log_ << line << '\n';
        if (is_end(line)) {
            log_.flush();
            done_ = line == session_job_done;
            changed_.notify_all();
            return;
        }
        if (!begin_cpu_seconds_ && adapter_.rendering_begins && adapter_.rendering_begins(line))
            begin_cpu_seconds_ = used_cpu_seconds_;
        if (job_->on_line) job_->on_line(line);
    }

    const Adapter &adapter_;
    const std::vector<std::string> thread_arguments_;
    Descriptor read_end_, write_end_;
    ChildRequest request_;
    std::atomic<bool> should_end_ = false;

    std::mutex mutex_;
    std::condition_variable changed_;
    const SessionJob *job_ = nullptr;
    std::ofstream log_;
    int jobs_ = 0;
    std::optional<bool> done_; ///< the job: well?
    double used_cpu_seconds_ = 0, peak_memory_mb_ = 0;
    std::optional<double> begin_cpu_seconds_;
    std::optional<ChildResult> program_; ///< once it has ended
    std::exception_ptr failure_;
    std::thread waiter_; ///< last: it uses all of the above
};

Sessions::Sessions() = default;
Sessions::~Sessions() = default;

ChildResult Sessions::render(const Adapter &adapter, const InstalledRenderer &installed,
                             const std::vector<std::string> &thread_arguments, const SessionJob &job) {
    std::unique_ptr<Session> &session = running_[std::string(adapter.name)];
    if (session && !session->has_threads(thread_arguments)) session.reset();
    if (!session) session = std::make_unique<Session>(adapter, installed, thread_arguments);
    try {
        const ChildResult result = session->render(job);
        if (result.end != ChildResult::End::exited || result.exit_code != 0) session.reset();
        return result;
    } catch (...) {
        session.reset();
        throw;
    }
}

} // namespace threefold
