// SPDX-License-Identifier: MIT
// Forked without exec: a library has no program of its own to start, and its user's program may do anything when it is
// started again. So the child is a copy of us in which only this thread lives: it must need no lock that another
// thread may have held at the fork. malloc's are safe (glibc resets them); Assimp has none and starts no thread.
#include "exporter/process/guarded.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <string_view>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "exporter/descriptor.h"
#include "exporter/process/child.h"
#include "exporter/text.h"
#include "scenes/error.h"

namespace threefold {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int exit_done = 0, exit_failed = 1, exit_out_of_memory = 2, exit_no_room = 3;
constexpr int step_ms = 100;

[[noreturn]] void throw_no_process(int error) {
    throw Error(Exit::input_output, fmt::format("cannot make a process: {}", std::generic_category().message(error)));
}

void limit(__rlimit_resource what, rlim_t value) {
    rlimit now{};
    ::getrlimit(what, &now);
    now.rlim_cur = std::min(value, now.rlim_max);
    ::setrlimit(what, &now);
}

rlim_t address_space_bytes() {
    long pages = 0;
    if (FILE *file = std::fopen("/proc/self/statm", "re")) {
        if (std::fscanf(file, "%ld", &pages) != 1) pages = 0;
        std::fclose(file);
    }
    return static_cast<rlim_t>(pages) * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

rlim_t memory_limit(const GuardedRequest &request) {
    const auto machine = static_cast<std::int64_t>(::sysconf(_SC_PHYS_PAGES)) * ::sysconf(_SC_PAGESIZE);
    return address_space_bytes() + static_cast<rlim_t>(std::min(request.memory_bytes, machine / 2));
}

[[noreturn]] void be_the_child(const GuardedRequest &request, int result, pid_t parent, rlim_t memory) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(exit_failed);
    // Our handlers would answer a Ctrl-C by a flag that nobody in the child looks at.
    for (const int number : {SIGINT, SIGTERM, SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGXCPU})
        std::signal(number, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    if (const int nowhere = ::open("/dev/null", O_RDWR); nowhere >= 0)
        for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, stream);
    limit(RLIMIT_AS, memory);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, static_cast<rlim_t>(request.work_limit.count()));
    try {
        ::_exit(write_all(result, request.work()) ? exit_done : exit_no_room);
    } catch (const std::bad_alloc &) {
        ::_exit(exit_out_of_memory);
    } catch (const std::exception &error) {
        write_all(result, error.what());
    } catch (...) {
        write_all(result, "an unknown exception");
    }
    ::_exit(exit_failed);
}

/// The child's number is ours until it is reaped, so it is always killed and reaped.
class Child {
public:
    explicit Child(pid_t number) : number_(number) {}
    ~Child() {
        if (!reaped_) reap();
    }
    Child(const Child &) = delete;
    Child &operator=(const Child &) = delete;

    bool has_ended() const {
        siginfo_t info{};
        const int result = ::waitid(P_PID, static_cast<id_t>(number_), &info, WEXITED | WNOHANG | WNOWAIT);
        return result == 0 ? info.si_pid == number_ : errno != EINTR;
    }

    int reap() {
        ::kill(number_, SIGKILL);
        int status = 0;
        while (::waitpid(number_, &status, 0) < 0 && errno == EINTR) {
        }
        reaped_ = true;
        return status;
    }

private:
    pid_t number_;
    bool reaped_ = false;
};

std::string all_of(int descriptor) {
    std::string bytes(static_cast<std::size_t>(std::max<off_t>(::lseek(descriptor, 0, SEEK_END), 0)), '\0');
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count = ::pread(descriptor, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) break;
        done += static_cast<std::size_t>(count);
    }
    bytes.resize(done);
    return bytes;
}

std::string describe_signal(int number, rlim_t memory, std::chrono::seconds work_limit) {
    if (number == SIGKILL) return "its reader was killed, perhaps for want of memory";
    if (number == SIGXCPU) return fmt::format("it takes more than {} s of computing", work_limit.count());
    const char *name = ::sigdescr_np(number);
    return fmt::format("its reader crashed ({}; it had {:.1f} GB)", name ? name : "unknown signal",
                       double(memory) / 1e9);
}

} // namespace

GuardedResult run_guarded(const GuardedRequest &request) {
    if (interrupt_requested) throw Error(Exit::interrupted, "interrupted");
    const Descriptor result(::memfd_create("threefold-result", MFD_CLOEXEC));
    if (result.number() < 0) throw_no_process(errno);
    // Nothing is written to it: its end says that the child has ended.
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw_no_process(errno);
    const Descriptor ours(ends[0]);
    Descriptor theirs(ends[1]);
    const rlim_t memory = memory_limit(request);
    const pid_t parent = ::getpid();
    const pid_t number = ::fork();
    if (number < 0) throw_no_process(errno);
    if (number == 0) be_the_child(request, result.number(), parent, memory);
    Child child(number);
    theirs.close();

    GuardedResult answer;
    const Clock::time_point end = Clock::now() + request.time_limit;
    while (!child.has_ended()) {
        pollfd item{ours.number(), POLLIN, 0};
        if (::poll(&item, 1, step_ms) > 0) ::usleep(1000); // it is about to end
        if (interrupt_requested) throw Error(Exit::interrupted, "interrupted");
        if (Clock::now() >= end) {
            answer.failure =
                fmt::format("it takes longer than {:g} s", std::chrono::duration<double>(request.time_limit).count());
            return answer;
        }
    }
    const int status = child.reap();
    if (WIFSIGNALED(status)) {
        answer.failure = describe_signal(WTERMSIG(status), memory, request.work_limit);
        return answer;
    }
    switch (WEXITSTATUS(status)) {
    case exit_done:
        answer.succeeded = true;
        answer.bytes = all_of(result.number());
        break;
    case exit_failed:
        answer.failure = reason(all_of(result.number()));
        break;
    default:
        answer.failure = fmt::format("it needs more than {:.1f} GB of memory", double(memory) / 1e9);
    }
    return answer;
}

} // namespace threefold
