// SPDX-License-Identifier: MIT
// Textures from users' pictures: what a sample becomes, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "exporter/file_reader.h"
#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "exporter/image/texture_file.h"
#include "scenes/error.h"
#include "tests/temporary_folder.h"

namespace threefold {
namespace {

using testing::HasSubstr;

std::string refusal(const std::filesystem::path &path, double gamma) {
    try {
        read_texture(path, gamma);
    } catch (const Error &error) {
        EXPECT_EQ(error.code(), Exit::bad_data);
        return error.what();
    }
    return "no error";
}

TEST(TextureFile, SixteenBitSamplesComeBackAsTheyStandWithGammaOne) {
    const tests::TemporaryFolder folder;
    const Texture texture{2, 1, {0, 1, 2, 30000, 65534, 65535}};
    write_file_atomically(folder / "t.png", encode_png16(texture));
    EXPECT_EQ(*read_texture(folder / "t.png", 1), texture);
    EXPECT_EQ(*read_texture(folder / "t.png", 0), texture) << "the file declares that it is linear";
    EXPECT_EQ(read_texture(folder / "t.png", 3)->rgb[3], std::lround(65535 * std::pow(30000 / 65535.0, 3)));
}

TEST(TextureFile, WrittenAnewWithinOneTickOfTheClockIsReadAnew) {
    const tests::TemporaryFolder folder;
    const auto path = folder / "t.png";
    write_file_atomically(path, encode_png16({1, 1, {1, 2, 3}}));
    const auto time = std::filesystem::last_write_time(path);
    const auto size = std::filesystem::file_size(path);
    EXPECT_EQ(file_reader().texture(path.string(), 1)->rgb[0], 1);
    write_file_atomically(path, encode_png16({1, 1, {4, 2, 3}}));
    std::filesystem::last_write_time(path, time);
    ASSERT_EQ(std::filesystem::file_size(path), size);
    EXPECT_EQ(file_reader().texture(path.string(), 1)->rgb[0], 4);
}

TEST(TextureFile, AnEightBitPictureIsSrgbUnlessAGammaIsGiven) {
    const tests::TemporaryFolder folder;
    write_image(folder / "t.png", Image(1, 1, Rgb(0.2))); // stored as 124 of 255
    EXPECT_NEAR(read_texture(folder / "t.png", 0)->rgb[0] / 65535.0, 0.2, 0.002);
    EXPECT_EQ(read_texture(folder / "t.png", 1)->rgb[0], 124 * 257);
    EXPECT_EQ(read_texture(folder / "t.png", 3)->rgb[0], std::lround(65535 * std::pow(124 / 255.0, 3)));
}

TEST(TextureFile, WhatIsNoReflectanceOrNoGammaIsRefused) {
    const tests::TemporaryFolder folder;
    write_image(folder / "bright.exr", Image(2, 2, Rgb(1.5)));
    write_image(folder / "dark.exr", Image(2, 2, Rgb(-0.5)));
    EXPECT_THAT(refusal(folder / "bright.exr", 0), HasSubstr("pixel (0, 0) is 1.5"));
    EXPECT_THAT(refusal(folder / "dark.exr", 1), HasSubstr("pixel (0, 0) is -0.5"));
    EXPECT_THAT(refusal(folder / "bright.exr", -1), HasSubstr("gamma"));
    EXPECT_THAT(refusal(folder / "bright.exr", NAN), HasSubstr("gamma"));
}

} // namespace
} // namespace threefold
