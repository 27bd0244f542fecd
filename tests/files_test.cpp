// SPDX-License-Identifier: MIT
#include "exporter/files.h"

#include <algorithm>
#include <csignal>
#include <string>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/error.h"
#include "tests/temporary_folder.h"

namespace threefold {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;

std::ptrdiff_t count_entries(const fs::path &folder) {
    return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

template <class Action>
std::string message_of(Action action) {
    try {
        action();
    } catch (const Error &error) {
        EXPECT_EQ(error.code(), Exit::input_output);
        return error.what();
    }
    ADD_FAILURE() << "no error";
    return {};
}

TEST(Files, WrittenBytesAreReadBackExactly) {
    const TemporaryFolder folder;
    std::string bytes("a\0b\r\n\xff", 6);
    bytes += std::string(1 << 20, 'x');
    write_file_atomically(folder / "file", bytes);
    EXPECT_EQ(read_file(folder / "file"), bytes);
    EXPECT_EQ(require_readable_file(folder / "file"), static_cast<std::int64_t>(bytes.size()));
}

TEST(Files, AWriteReplacesTheFileAndLeavesNothingElse) {
    const TemporaryFolder folder;
    write_file_atomically(folder / "file", "long old text");
    write_file_atomically(folder / "file", "new");
    EXPECT_EQ(read_file(folder / "file"), "new");
    EXPECT_EQ(count_entries(folder.path()), 1);
}

TEST(Files, AnEmptyFileCanBeWritten) {
    const TemporaryFolder folder;
    write_file_atomically(folder / "file", "");
    EXPECT_EQ(read_file(folder / "file"), "");
}

TEST(Files, ANameAsLongAsTheFileSystemAllowsCanBeWritten) {
    const TemporaryFolder folder;
    const std::string name(255, 'n');
    write_file_atomically(folder / name, "text");
    EXPECT_EQ(read_file(folder / name), "text");
}

TEST(Files, ANewFileHasTheUsualPermissions) {
    const TemporaryFolder folder;
    const mode_t mask = ::umask(022);
    write_file_atomically(folder / "file", "text");
    ::umask(mask);
    EXPECT_EQ(fs::status(folder / "file").permissions(), fs::perms(0644));
}

TEST(Files, ASymbolicLinkIsFollowedAndKept) {
    const TemporaryFolder folder;
    write_file_atomically(folder / "file", "old");
    fs::create_symlink("file", folder / "link");
    write_file_atomically(folder / "link", "new");
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(read_file(folder / "file"), "new");
}

TEST(Files, AFullDeviceIsReportedAsAFullDiskAndNotReplaced) {
    if (!fs::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full";
    EXPECT_EQ(message_of([] { write_file_atomically("/dev/full", "text"); }),
              "cannot write /dev/full: the disk is full");
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(Files, AWriteThatRunsOutOfSpaceLeavesTheOldFileAndNoTemporary) {
    const TemporaryFolder folder;
    write_file_atomically(folder / "file", "old");
    const pid_t child = ::fork();
    if (child == 0) {
        // A limit on the size of files stops a write in its middle, as a full disk does.
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{100'000, 100'000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            write_file_atomically(folder / "file", std::string(200'000, 'x'));
        } catch (const Error &) {
            ::_exit(0);
        }
        ::_exit(1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(read_file(folder / "file"), "old");
    EXPECT_EQ(count_entries(folder.path()), 1);
}

TEST(Files, AnUnwritableFolderIsNamed) {
    const TemporaryFolder folder;
    write_file_atomically(folder / "plain", "text");
    const fs::path inside = folder / "plain" / "file";
    EXPECT_THAT(message_of([&] { write_file_atomically(inside, "text"); }),
                AllOf(HasSubstr(inside.string()), EndsWith("Not a directory")));
    EXPECT_THAT(message_of([&] { write_file_atomically(folder / "absent" / "file", "text"); }),
                EndsWith("absent/file: No such file or directory"));
    EXPECT_THAT(message_of([&] { make_folder(inside); }), HasSubstr(inside.string()));
    EXPECT_THAT(message_of([&] { make_folder(folder / "plain"); }), HasSubstr("Not a directory"));
}

TEST(Files, AFolderIsNotWrittenToAsAFile) {
    const TemporaryFolder folder;
    EXPECT_THAT(message_of([&] { write_file_atomically(folder.path(), "text"); }), EndsWith("Is a directory"));
    EXPECT_THAT(message_of([&] { read_file(folder.path()); }), EndsWith("Is a directory"));
}

TEST(Files, AMissingFileIsNamed) {
    const TemporaryFolder folder;
    const std::string expected = "cannot read " + (folder / "absent").string() + ": No such file or directory";
    EXPECT_EQ(message_of([&] { read_file(folder / "absent"); }), expected);
    EXPECT_EQ(message_of([&] { require_readable_file(folder / "absent"); }), expected);
}

TEST(Files, ANamedPipeIsRefusedWithoutWaitingForItsWriter) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_THAT(message_of([&] { require_readable_file(folder / "pipe"); }), EndsWith("not a regular file"));
}

TEST(Files, MakeFolderMakesParentsAndAcceptsWhatIsThere) {
    const TemporaryFolder folder;
    make_folder(folder / "a/b/c");
    make_folder(folder / "a/b/c/");
    EXPECT_TRUE(fs::is_directory(folder / "a/b/c"));
}

TEST(Files, TheContentHashIsSha1) {
    // FIPS 180-2, appendix A.
    EXPECT_EQ(content_hash("abc"), "a9993e364706816aba3e25717850c26c9cd0d89d");
    EXPECT_EQ(content_hash(std::string(1'000'000, 'a')), "34aa973cd4c4daa4f61eeb2bdbad27316534016f");
    EXPECT_EQ(content_hash(""), "da39a3ee5e6b4b0d3255bfef95601890afd80709");
}

} // namespace
} // namespace threefold
