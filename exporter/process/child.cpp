// SPDX-License-Identifier: MIT
#include "exporter/process/child.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "exporter/descriptor.h"
#include "scenes/error.h"

extern char **environ;

namespace threefold {

std::atomic<bool> interrupt_requested{false};

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds step{100};   // between looks at the clock, the interrupt flag and the child
constexpr milliseconds grace{2000}; // from SIGTERM to SIGKILL
constexpr std::size_t longest_line = 1 << 16;
// Part of util-linux, which Debian never lacks.
constexpr const char *setpriv = "/usr/bin/setpriv";

std::string reason(int error) { return std::generic_category().message(error); }

[[noreturn]] void throw_not_started(const ChildRequest &request, const std::string &why) {
    throw Error(Exit::input_output, fmt::format("{} cannot be started: {}", request.program.string(), why));
}

/// Empty when it cannot be read.
std::string text_of(const fs::path &path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
}

bool is_program(const fs::path &path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored) && ::access(path.c_str(), X_OK) == 0;
}

/// The leader of a process group. It is reaped only after its group was killed: until then its number cannot be
/// another's.
class Group {
public:
    explicit Group(pid_t leader) : leader_(leader) {}
    ~Group() {
        if (!reaped_) reap();
    }
    Group(const Group &) = delete;
    Group &operator=(const Group &) = delete;

    void send(int signal) const { ::kill(-leader_, signal); }

    bool leader_has_ended() const {
        siginfo_t info{};
        const int result = ::waitid(P_PID, static_cast<id_t>(leader_), &info, WEXITED | WNOHANG | WNOWAIT);
        return result == 0 ? info.si_pid == leader_ : errno != EINTR;
    }

    /// Kills what is left of the group and takes the leader's end.
    std::pair<int, rusage> reap() {
        send(SIGKILL);
        int status = 0;
        rusage usage{};
        pid_t result;
        do result = ::wait4(leader_, &status, 0, &usage);
        while (result < 0 && errno == EINTR);
        reaped_ = true;
        if (result < 0) status = -1;
        return {status, usage};
    }

    /// The kernel starts a child's peak at its parent's size, so the peak is also read where it is right: as of now.
    double peak_memory_kb() const {
        const std::string text = text_of(fmt::format("/proc/{}/status", leader_));
        const std::size_t found = text.find("VmHWM:");
        return found == text.npos ? 0 : std::strtod(text.c_str() + found + std::strlen("VmHWM:"), nullptr);
    }

    /// Of the leader so far, in clock ticks; nothing when it cannot be read.
    std::optional<double> cpu_seconds() const {
        const std::string text = text_of(fmt::format("/proc/{}/stat", leader_));
        const std::size_t name_end = text.rfind(')'); // the name may hold anything
        if (name_end == text.npos) return std::nullopt;
        std::istringstream fields(text.substr(name_end + 1));
        std::string skipped;
        for (int field = 3; field < 14; ++field) fields >> skipped;
        double user = 0, system = 0;
        if (!(fields >> user >> system)) return std::nullopt;
        return (user + system) / static_cast<double>(::sysconf(_SC_CLK_TCK));
    }

private:
    pid_t leader_;
    bool reaped_ = false;
};

/// The child's output as it comes: to the log as it stands, and in lines to the caller.
class Output {
public:
    explicit Output(const ChildRequest &request) : request_(request) {
        if (request.log.empty()) return;
        log_.open(::open(request.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
        if (!log_.is_open()) throw_log_failed(errno);
    }

    void add(std::string_view bytes) {
        append_to_log(bytes);
        for (;;) {
            const std::size_t end = bytes.find_first_of("\r\n");
            line_.append(bytes.substr(0, end));
            if (end == bytes.npos) break;
            finish_line();
            bytes.remove_prefix(end + 1);
        }
        if (line_.size() >= longest_line) finish_line();
    }

    void finish() {
        finish_line();
        if (!log_.close()) throw_log_failed(errno);
    }

    const std::string &first_line() const { return first_line_; }
    /// Whose time a marking line is asked for.
    void watch(const Group &group) { group_ = &group; }
    std::optional<double> cpu_seconds_at_mark() const { return cpu_seconds_at_mark_; }

private:
    void append_to_log(std::string_view bytes) {
        if (log_.is_open() && !write_all(log_.number(), bytes)) throw_log_failed(errno);
    }

    void finish_line() {
        if (line_.empty()) return;
        if (first_line_.empty()) first_line_ = line_;
        if (request_.marks && group_ && !cpu_seconds_at_mark_ && request_.marks(line_))
            cpu_seconds_at_mark_ = group_->cpu_seconds();
        if (request_.on_line) request_.on_line(line_);
        line_.clear();
    }

    [[noreturn]] void throw_log_failed(int error) const {
        throw Error(Exit::input_output,
                    fmt::format("cannot write log {}: {}", request_.log.string(),
                                error == ENOSPC || error == EDQUOT ? "the disk is full" : reason(error)));
    }

    const ChildRequest &request_;
    Descriptor log_;
    std::string line_, first_line_;
    const Group *group_ = nullptr;
    std::optional<double> cpu_seconds_at_mark_;
};

struct SpawnSettings {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;

    SpawnSettings() {
        posix_spawn_file_actions_init(&actions);
        posix_spawnattr_init(&attributes);
    }
    ~SpawnSettings() {
        posix_spawn_file_actions_destroy(&actions);
        posix_spawnattr_destroy(&attributes);
    }
    SpawnSettings(const SpawnSettings &) = delete;
    SpawnSettings &operator=(const SpawnSettings &) = delete;
};

/// `output_pipe`: where the child's stdout and stderr go.
pid_t spawn(const ChildRequest &request, int output_pipe) {
    // The kernel sends the parent-death signal when the *thread* that started the child ends, so the thread that calls
    // this must also be the one that waits.
    std::vector<std::string> words;
    if (is_program(setpriv)) words = {setpriv, "--pdeathsig", "KILL", "--"};
    words.push_back(request.program.string());
    words.insert(words.end(), request.arguments.begin(), request.arguments.end());
    std::vector<char *> argv;
    for (std::string &word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    SpawnSettings settings;
    // stdin last: the pipe's own number may be 0 when our stdin is closed.
    posix_spawn_file_actions_adddup2(&settings.actions, output_pipe, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&settings.actions, output_pipe, STDERR_FILENO);
    posix_spawn_file_actions_addopen(&settings.actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addclosefrom_np(&settings.actions, STDERR_FILENO + 1);
    if (!request.folder.empty()) posix_spawn_file_actions_addchdir_np(&settings.actions, request.folder.c_str());
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    posix_spawnattr_setsigmask(&settings.attributes, &none);
    posix_spawnattr_setsigdefault(&settings.attributes, &all);
    posix_spawnattr_setpgroup(&settings.attributes, 0);
    posix_spawnattr_setflags(&settings.attributes,
                             POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    pid_t pid = 0;
    if (const int error = posix_spawn(&pid, argv[0], &settings.actions, &settings.attributes, argv.data(), environ))
        throw_not_started(request, reason(error));
    return pid;
}

double to_seconds(const timeval &time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); }

double own_peak_memory_kb() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss);
}

/// Reads what is there. False when nothing can come any more.
bool read_available(const Descriptor &pipe, Output &output) {
    std::array<char, 1 << 16> buffer;
    const ssize_t count = ::read(pipe.number(), buffer.data(), buffer.size());
    if (count > 0) output.add({buffer.data(), static_cast<std::size_t>(count)});
    return count > 0 || (count < 0 && (errno == EAGAIN || errno == EINTR));
}

/// Waits for output or until `pause` is over.
void wait_for_output(Descriptor &pipe, milliseconds pause, Output &output) {
    pollfd item{pipe.number(), POLLIN, 0}; // a negative number is ignored: then this just sleeps
    if (::poll(&item, 1, static_cast<int>(pause.count())) > 0 && !read_available(pipe, output)) pipe.close();
}

/// What the child wrote before its end. A process that left the group may hold the pipe open and write for ever: no
/// more than a pipe can hold is read.
void drain(Descriptor &pipe, Output &output) {
    for (int reads = 0; pipe.is_open() && reads < 16; ++reads) {
        pollfd item{pipe.number(), POLLIN, 0};
        if (::poll(&item, 1, 0) <= 0 || !read_available(pipe, output)) break;
    }
}

milliseconds elapsed_since(Clock::time_point start) {
    return std::chrono::duration_cast<milliseconds>(Clock::now() - start);
}

} // namespace

std::string ChildResult::describe() const {
    switch (end) {
    case End::exited:
        return fmt::format("exit code {}", exit_code);
    case End::signalled: {
        const char *name = ::sigdescr_np(signal);
        return fmt::format("killed by signal {} ({})", signal, name ? name : "unknown");
    }
    case End::timed_out:
        return fmt::format("ran out of time after {:.{}f} s", seconds, seconds < 10 ? 1 : 0);
    }
    return {};
}

ChildResult run_child(const ChildRequest &request) {
    if (interrupt_requested) throw Error(Exit::interrupted, "interrupted");
    if (!request.program.is_absolute() || !is_program(request.program))
        throw_not_started(request, "it is not an executable file");
    std::error_code ignored;
    if (!request.folder.empty() && !fs::is_directory(request.folder, ignored))
        throw_not_started(request, fmt::format("{} is not a folder", request.folder.string()));

    Output output(request);
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw_not_started(request, reason(errno));
    Descriptor pipe(ends[0]), child_end(ends[1]);
    ::fcntl(pipe.number(), F_SETFL, O_NONBLOCK);

    const Clock::time_point start = Clock::now();
    Group group(spawn(request, child_end.number()));
    output.watch(group);
    child_end.close();

    ChildResult result;
    std::optional<Clock::time_point> told_to_end;
    bool interrupted = false, killed = false;
    double peak_kb = 0;
    milliseconds pause = step;
    Clock::time_point next_sample = start;
    while (!group.leader_has_ended()) {
        const bool was_open = pipe.is_open();
        const milliseconds left = std::max(request.time_limit - elapsed_since(start), milliseconds{0});
        wait_for_output(pipe, told_to_end ? pause : std::min(pause, left), output);
        // The end follows soon after that of the output, if it does.
        pause = pipe.is_open() ? step : was_open ? milliseconds{1} : std::min(2 * pause, step);
        if (Clock::now() >= next_sample) {
            peak_kb = std::max(peak_kb, group.peak_memory_kb());
            next_sample = Clock::now() + step;
        }
        interrupted = interrupted || interrupt_requested;
        const bool late = elapsed_since(start) >= request.time_limit;
        if (!told_to_end && (late || interrupted)) {
            told_to_end = Clock::now();
            result.end = ChildResult::End::timed_out;
            group.send(SIGTERM);
        }
        if (told_to_end && !killed && elapsed_since(*told_to_end) >= grace) {
            killed = true;
            group.send(SIGKILL);
        }
    }
    result.seconds = std::chrono::duration<double>(told_to_end.value_or(Clock::now()) - start).count();
    const auto [status, usage] = group.reap();
    drain(pipe, output);
    output.finish();

    if (interrupted) throw Error(Exit::interrupted, "interrupted");
    if (status == -1)
        throw Error(Exit::internal,
                    fmt::format("the end of {} was taken by another part of this program", request.program.string()));
    // setpriv's own way to say that it could not start the program.
    if (WIFEXITED(status) && (WEXITSTATUS(status) == 126 || WEXITSTATUS(status) == 127) &&
        output.first_line().starts_with("setpriv: "))
        throw_not_started(request, output.first_line());

    result.cpu_seconds_at_mark = output.cpu_seconds_at_mark();
    result.cpu_seconds = to_seconds(usage.ru_utime) + to_seconds(usage.ru_stime);
    if (double(usage.ru_maxrss) > own_peak_memory_kb()) peak_kb = double(usage.ru_maxrss);
    result.peak_memory_mb = peak_kb * 1024 / 1e6;
    if (told_to_end) return result;
    if (WIFSIGNALED(status)) {
        result.end = ChildResult::End::signalled;
        result.signal = WTERMSIG(status);
    } else {
        result.exit_code = WEXITSTATUS(status);
    }
    return result;
}

std::optional<fs::path> find_program(std::string_view name) {
    if (name.empty()) return std::nullopt;
    if (name.find('/') != name.npos) {
        const fs::path path = fs::absolute(name);
        return is_program(path) ? std::optional(path) : std::nullopt;
    }
    const char *variable = std::getenv("PATH");
    std::string_view folders(variable ? variable : "/usr/local/bin:/usr/bin:/bin");
    for (;;) {
        const std::size_t end = std::min(folders.find(':'), folders.size());
        // An empty entry means the current folder.
        const fs::path path = fs::absolute(fs::path(end == 0 ? "." : folders.substr(0, end)) / name);
        if (is_program(path)) return path;
        if (end == folders.size()) return std::nullopt;
        folders.remove_prefix(end + 1);
    }
}

} // namespace threefold
