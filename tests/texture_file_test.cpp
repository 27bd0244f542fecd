// SPDX-License-Identifier: MIT
// Textures from users' pictures: what a sample becomes, and what is refused.
#include <ImathBox.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

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

/// A TIFF of 2 x 1 grey pixels that names an orientation.
std::string tiff_with_orientation(int orientation) {
    std::string bytes("II*\0\x0a\0\0\0\x20\xe0", 10); // the pixels, then the directory
    const auto add = [&bytes](unsigned value, int size) {
        for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
    };
    const std::vector<std::pair<unsigned, unsigned>> tags{
        {256, 2}, {257, 1}, {258, 8}, {259, 1}, {262, 1}, {273, 8}, {274, static_cast<unsigned>(orientation)},
        {277, 1}, {278, 1}, {279, 2}};
    add(static_cast<unsigned>(tags.size()), 2);
    for (const auto &[tag, value] : tags) add(tag, 2), add(3, 2), add(1, 4), add(value, 4); // 3: 16-bit integers
    add(0, 4);
    return bytes;
}

TEST(TextureFile, OneThatIsToBeTurnedIsRefused) {
    const tests::TemporaryFolder folder;
    write_file_atomically(folder / "upright.tif", tiff_with_orientation(1));
    EXPECT_EQ(read_texture(folder / "upright.tif", 1)->width, 2);
    write_file_atomically(folder / "turned.tif", tiff_with_orientation(6));
    EXPECT_THAT(refusal(folder / "turned.tif", 1), HasSubstr("EXIF orientation 6"));
}

TEST(TextureFile, OneWhoseDataWindowIsNotItsDisplayWindowIsRefused) {
    const tests::TemporaryFolder folder;
    const auto write = [&](const char *name, Imath::Box2i data) {
        const std::vector<Imf::Rgba> pixels(4, Imf::Rgba(0.5f, 0.5f, 0.5f));
        Imf::RgbaOutputFile file((folder / name).c_str(), Imath::Box2i({0, 0}, {3, 3}), data, Imf::WRITE_RGB);
        file.setFrameBuffer(pixels.data() - data.min.x - 2 * data.min.y, 1, 2);
        file.writePixels(2);
    };
    write("part.exr", Imath::Box2i({1, 2}, {2, 3}));
    EXPECT_THAT(refusal(folder / "part.exr", 0), HasSubstr("2 x 2 pixels at (1, 2) of a picture of 4 x 4"));
    write_image(folder / "whole.exr", Image(4, 4, Rgb(0.5)));
    EXPECT_EQ(read_texture(folder / "whole.exr", 0)->width, 4);
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
