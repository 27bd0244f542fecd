// SPDX-License-Identifier: MIT
#include "exporter/image/load_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exporter/files.h"
#include "scenes/error.h"
#include "tests/temporary_folder.h"

namespace threefold {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::filesystem::path ours = THREEFOLD_PICTURES, older = THREEFOLD_OLDER_PICTURES, none = THREEFOLD_NO_PICTURES;

std::string refusal_of(const std::vector<std::filesystem::path> &places) {
    try {
        load_pictures(places);
    } catch (const Error &error) {
        EXPECT_EQ(error.code(), Exit::input_output);
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
        return error.what();
    }
    ADD_FAILURE() << "no error";
    return {};
}

TEST(LoadPictures, AMissingModuleIsNamedWithEveryPlace) {
    EXPECT_THAT(refusal_of({"/absent/a.so", "/absent/b.so"}),
                AllOf(HasSubstr("/absent/a.so: no such file"), HasSubstr("/absent/b.so: no such file")));
    EXPECT_THAT(refusal_of({"threefold-absent.so"}), HasSubstr("threefold-absent.so: cannot open"));
}

TEST(LoadPictures, ABrokenModuleIsRefusedWithTheReason) {
    const TemporaryFolder folder;
    const std::string bytes = read_file(ours);
    write_file_atomically(folder / "cut.so", std::string_view(bytes).substr(0, 100));
    write_file_atomically(folder / "text.so", "no library, only a line of text that is as long as a header of one");
    EXPECT_THAT(refusal_of({folder / "cut.so", folder / "text.so"}),
                AllOf(HasSubstr((folder / "cut.so").string() + ": "), HasSubstr((folder / "text.so").string() + ": ")));
    EXPECT_THAT(refusal_of({none}), HasSubstr(none.string() + ": it is no module of Threefold"));
}

TEST(LoadPictures, AModuleOfAnotherVersionIsRefused) {
    EXPECT_THAT(refusal_of({older}), AllOf(HasSubstr(older.string() + ": it is of threefold 0.0.1"),
                                           HasSubstr("(threefold " THREEFOLD_VERSION)));
}

TEST(LoadPictures, TheFirstThatFitsIsTaken) {
    const LoadedPictures loaded = load_pictures({"/absent/a.so", older, none, ours});
    EXPECT_EQ(loaded.path, ours);
    EXPECT_THAT(loaded.module->openimageio_version, HasSubstr("."));
}

TEST(LoadPictures, AProgramFindsItsOwn) { EXPECT_TRUE(std::filesystem::equivalent(loaded_pictures().path, ours)); }

} // namespace
} // namespace threefold
