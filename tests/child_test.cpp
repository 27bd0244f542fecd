// SPDX-License-Identifier: MIT
#include "exporter/process/child.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exporter/files.h"
#include "scenes/error.h"
#include "tests/temporary_folder.h"

namespace threefold {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using End = ChildResult::End;
using testing::ElementsAre;
using testing::HasSubstr;

class Child : public testing::Test {
protected:
    const TemporaryFolder folder;

    ChildRequest request(std::string_view commands) const {
        ChildRequest result;
        result.program = folder.write_program("program", commands);
        result.folder = folder.path();
        result.time_limit = 30s;
        return result;
    }
};

/// A process that nobody has reaped yet counts as ended.
bool is_running(pid_t process) {
    std::string status;
    try {
        status = read_file("/proc/" + std::to_string(process) + "/stat");
    } catch (const Error &) {
        return false;
    }
    return status.at(status.rfind(')') + 2) != 'Z';
}

bool ends_within(pid_t process, std::chrono::milliseconds limit) {
    const auto start = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - start < limit) {
        if (!is_running(process)) return true;
        std::this_thread::sleep_for(10ms);
    }
    return false;
}

/// The number that a program has written to a file, once it has.
pid_t wait_for_number(const fs::path &file) {
    for (int i = 0; i < 500; ++i, std::this_thread::sleep_for(10ms))
        if (fs::exists(file) && read_file(file).ends_with('\n')) return std::atoi(read_file(file).c_str());
    ADD_FAILURE() << file << " was not written";
    return 0;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST_F(Child, ReportsTheExitCode) {
    const ChildResult result = run_child(request("exit 7"));
    EXPECT_EQ(result.end, End::exited);
    EXPECT_EQ(result.exit_code, 7);
    EXPECT_EQ(result.describe(), "exit code 7");
}

TEST_F(Child, ReportsTheSignalOfACrash) {
    const ChildResult result = run_child(request("kill -SEGV $$"));
    EXPECT_EQ(result.end, End::signalled);
    EXPECT_EQ(result.signal, SIGSEGV);
    EXPECT_EQ(result.describe(), "killed by signal 11 (Segmentation fault)");
}

TEST_F(Child, PassesArgumentsWithoutAShell) {
    ChildRequest child = request("for a in \"$@\"; do echo \"[$a]\"; done");
    child.arguments = {"a b", "$HOME", "*", ";ls", "--", "'"};
    std::vector<std::string> lines;
    child.on_line = [&](std::string_view line) { lines.emplace_back(line); };
    run_child(child);
    EXPECT_THAT(lines, ElementsAre("[a b]", "[$HOME]", "[*]", "[;ls]", "[--]", "[']"));
}

TEST_F(Child, RunsInItsFolderWithAnEmptyInput) {
    ChildRequest child = request("pwd; cat; echo end");
    std::vector<std::string> lines;
    child.on_line = [&](std::string_view line) { lines.emplace_back(line); };
    run_child(child);
    EXPECT_THAT(lines, ElementsAre(fs::canonical(folder.path()).string(), "end"));
}

TEST_F(Child, SplitsLinesAtNewlinesAndCarriageReturnsAndLogsAllAsItStands) {
    ChildRequest child = request("printf 'one\\r\\ntwo\\rthree\\n\\n' >&2; printf 'no end'");
    child.log = folder / "log";
    std::vector<std::string> lines;
    child.on_line = [&](std::string_view line) { lines.emplace_back(line); };
    run_child(child);
    EXPECT_THAT(lines, ElementsAre("one", "two", "three", "no end"));
    EXPECT_EQ(read_file(folder / "log"), "one\r\ntwo\rthree\n\nno end");
}

TEST_F(Child, TakesTenMegabytesOfOutput) {
    // 2^20 lines of ten bytes.
    ChildRequest child = request("yes \"$(printf '123456789\\r')\" | tr -d '\\n' | head -c 10485760");
    child.log = folder / "log";
    std::size_t lines = 0, wrong = 0;
    child.on_line = [&](std::string_view line) {
        ++lines;
        wrong += line != "123456789";
    };
    const ChildResult result = run_child(child);
    EXPECT_EQ(result.end, End::exited);
    EXPECT_EQ(lines, 1048576u);
    EXPECT_EQ(wrong, 0u);
    EXPECT_EQ(fs::file_size(folder / "log"), 10485760u);
}

TEST_F(Child, AHangIsEndedWithItsGrandchildAtTheTimeLimit) {
    ChildRequest child = request("sleep 1000 & echo $! > grandchild; wait");
    child.time_limit = 500ms;
    const auto start = std::chrono::steady_clock::now();
    const ChildResult result = run_child(child);
    EXPECT_LT(seconds_since(start), 2);
    EXPECT_EQ(result.end, End::timed_out);
    EXPECT_NEAR(result.seconds, 0.5, 0.4);
    EXPECT_THAT(result.describe(), testing::StartsWith("ran out of time after 0."));
    EXPECT_TRUE(ends_within(wait_for_number(folder / "grandchild"), 2s));
}

TEST_F(Child, AHangThatIgnoresTheFirstSignalIsKilled) {
    ChildRequest child = request("trap '' TERM; echo $$ > leader; while :; do sleep 1000; done");
    child.time_limit = 300ms;
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(run_child(child).end, End::timed_out);
    EXPECT_LT(seconds_since(start), 4);
    EXPECT_FALSE(is_running(wait_for_number(folder / "leader")));
}

TEST_F(Child, AFloodOfOutputDoesNotHideTheTimeLimit) {
    ChildRequest child = request("exec yes");
    child.time_limit = 300ms;
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(run_child(child).end, End::timed_out);
    EXPECT_LT(seconds_since(start), 3);
}

TEST_F(Child, AChildThatClosesItsOutputIsStillTimed) {
    ChildRequest child = request("exec >&- 2>&-; sleep 1000");
    child.time_limit = 400ms;
    EXPECT_EQ(run_child(child).end, End::timed_out);
}

TEST_F(Child, AChildThatClosesItsOutputIsStillWaitedFor) {
    const ChildResult result = run_child(request("exec >&- 2>&-; sleep 0.5; exit 3"));
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_GE(result.seconds, 0.5);
}

TEST_F(Child, AGrandchildThatHoldsTheOutputOpenIsNotWaitedForAndIsKilled) {
    ChildRequest child = request("sleep 1000 & echo $! > grandchild; echo done");
    std::vector<std::string> lines;
    child.on_line = [&](std::string_view line) { lines.emplace_back(line); };
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(run_child(child).end, End::exited);
    EXPECT_LT(seconds_since(start), 2);
    EXPECT_THAT(lines, ElementsAre("done"));
    EXPECT_TRUE(ends_within(wait_for_number(folder / "grandchild"), 2s));
}

TEST_F(Child, AGrandchildThatLeftTheGroupDoesNotHoldUs) {
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(run_child(request("setsid sleep 5 & exit 0")).end, End::exited);
    EXPECT_LT(seconds_since(start), 2);
}

TEST_F(Child, DiesWithItsParent) {
    const ChildRequest child = request("echo $$ > leader; exec sleep 1000");
    const pid_t helper = ::fork();
    if (helper == 0) {
        run_child(child);
        ::_exit(0);
    }
    const pid_t leader = wait_for_number(folder / "leader");
    ASSERT_GT(leader, 0);
    EXPECT_TRUE(is_running(leader));
    ::kill(helper, SIGKILL);
    ::waitpid(helper, nullptr, 0);
    EXPECT_TRUE(ends_within(leader, 2s));
}

TEST_F(Child, DiesWhenItsLineIsMetWithAnException) {
    ChildRequest child = request("echo $$ > leader; echo line; exec sleep 1000");
    child.on_line = [](std::string_view) { throw std::runtime_error("stop"); };
    EXPECT_THROW(run_child(child), std::runtime_error);
    EXPECT_FALSE(is_running(wait_for_number(folder / "leader")));
}

TEST_F(Child, DiesWhenWeAreInterrupted) {
    const ChildRequest child = request("echo $$ > leader; exec sleep 1000");
    std::thread interrupter([&] {
        wait_for_number(folder / "leader");
        interrupt_requested = true;
    });
    const auto start = std::chrono::steady_clock::now();
    try {
        run_child(child);
        ADD_FAILURE() << "no error";
    } catch (const Error &error) {
        EXPECT_EQ(error.code(), Exit::interrupted);
    }
    interrupter.join();
    interrupt_requested = false;
    EXPECT_LT(seconds_since(start), 5);
    EXPECT_FALSE(is_running(wait_for_number(folder / "leader")));
}

TEST_F(Child, HasDefaultSignalsAndNoneOfOurFiles) {
    const auto previous = ::signal(SIGTERM, SIG_IGN);
    ASSERT_EQ(::dup2(1, 55), 55);
    std::vector<std::string> lines;
    ChildRequest child = request("ls /proc/$$/fd/55 2>&1; kill -TERM $$");
    child.on_line = [&](std::string_view line) { lines.emplace_back(line); };
    const ChildResult result = run_child(child);
    ::close(55);
    ::signal(SIGTERM, previous);
    EXPECT_EQ(result.signal, SIGTERM);
    EXPECT_THAT(lines, ElementsAre(HasSubstr("No such file")));
}

TEST_F(Child, IsMeasured) {
    // Not our own memory: the kernel starts a child's peak at its parent's size.
    std::vector<char> own(300'000'000, 1);
    const ChildResult small = run_child(request("sleep 0.3"));
    EXPECT_GT(small.peak_memory_mb, 0.1);
    EXPECT_LT(small.peak_memory_mb, 50);
    EXPECT_LT(small.cpu_seconds, 0.2);
    EXPECT_GE(small.seconds, 0.3);
    EXPECT_EQ(own.back(), 1);

    const ChildResult busy = run_child(request("i=0; while [ $i -lt 300000 ]; do i=$((i+1)); done"));
    EXPECT_GT(busy.cpu_seconds, 0.02);
}

TEST_F(Child, AProgramThatIsMissingOrUnfitCannotBeStarted) {
    const auto message = [](const ChildRequest &child) -> std::string {
        try {
            run_child(child);
        } catch (const Error &error) {
            EXPECT_EQ(error.code(), Exit::input_output);
            return error.what();
        }
        return "no error";
    };
    ChildRequest child = request("exit 0");
    child.program = folder / "absent";
    EXPECT_THAT(message(child), HasSubstr("absent cannot be started"));
    child.program = folder.path();
    EXPECT_THAT(message(child), HasSubstr("cannot be started"));

    child = request("exit 0");
    child.folder = folder / "absent";
    EXPECT_THAT(message(child), HasSubstr("absent is not a folder"));

    child = request("exit 0");
    child.log = folder / "absent" / "log";
    EXPECT_THAT(message(child), HasSubstr("cannot write log"));
    if (fs::exists("/dev/full")) {
        child = request("echo text; sleep 1000");
        child.log = "/dev/full";
        EXPECT_EQ(message(child), "cannot write log /dev/full: the disk is full");
    }

    write_file_atomically(folder / "other", "#!/absent/interpreter\n");
    fs::permissions(folder / "other", fs::perms::owner_all);
    child.log.clear();
    child.program = folder / "other";
    EXPECT_THAT(message(child), HasSubstr("cannot be started"));
}

TEST_F(Child, AnExitCodeOf127IsTheProgramsOwn) { EXPECT_EQ(run_child(request("exit 127")).exit_code, 127); }

TEST_F(Child, FindProgramHonoursPath) {
    const fs::path program = folder.write_program("some-program", "exit 0");
    const std::string path = std::getenv("PATH");
    ::setenv("PATH", ("/absent::" + folder.path().string()).c_str(), 1);
    EXPECT_EQ(find_program("some-program"), program);
    EXPECT_EQ(find_program("sh"), std::nullopt);
    ::setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(find_program("some-program"), std::nullopt);
    EXPECT_EQ(find_program(program.string()), program);
    EXPECT_NE(find_program("sh"), std::nullopt);
}

TEST_F(Child, FindProgramWantsAnExecutableFile) {
    write_file_atomically(folder / "text", "text");
    EXPECT_EQ(find_program((folder / "text").string()), std::nullopt);
    EXPECT_EQ(find_program(folder.path().string()), std::nullopt);
    EXPECT_EQ(find_program(""), std::nullopt);
}

} // namespace
} // namespace threefold
