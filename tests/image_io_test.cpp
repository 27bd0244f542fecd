// SPDX-License-Identifier: MIT
#include "exporter/image/image_io.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exporter/files.h"
#include "scenes/error.h"
#include "tests/temporary_folder.h"

namespace threefold {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Image make_noise(int width, int height, double greatest) {
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> uniform(0, greatest);
    Image image(width, height);
    for (Rgb &pixel : image.pixels) pixel = Rgb(uniform(generator), uniform(generator), uniform(generator));
    return image;
}

/// A picture as another program might write it.
template <class Sample>
void write_foreign(const fs::path &path, int width, int height, int channels, const std::vector<Sample> &samples,
                   const char *colour_space = "") {
    OIIO::ImageSpec spec(width, height, channels, OIIO::BaseTypeFromC<Sample>::value);
    if (*colour_space) spec.attribute("oiio:ColorSpace", colour_space);
    if (channels == 2 || channels == 4) {
        spec.alpha_channel = channels - 1;
        spec.attribute("oiio:UnassociatedAlpha", 1);
    }
    const auto output = OIIO::ImageOutput::create(path.string());
    ASSERT_TRUE(output && output->open(path.string(), spec) && output->write_image(spec.format, samples.data()) &&
                output->close());
}

std::string attribute_of(const fs::path &path, const std::string &name) {
    const auto input = OIIO::ImageInput::open(path.string());
    return input ? input->spec().get_string_attribute(name) : "no picture";
}

template <class Action>
std::string message_of(Exit code, Action action) {
    try {
        action();
    } catch (const Error &error) {
        EXPECT_EQ(error.code(), code) << error.what();
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
        return error.what();
    }
    ADD_FAILURE() << "no error";
    return {};
}

TEST(ImageIo, ExrHoldsFloatsExactly) {
    const TemporaryFolder folder;
    Image image = make_noise(37, 51, 1000);
    for (Rgb &pixel : image.pixels) pixel = Rgb(glm::vec3(pixel));
    image.at(0, 0) = Rgb(-1, 0, std::numeric_limits<float>::denorm_min());
    image.at(36, 50) = Rgb(std::numeric_limits<float>::max(), 1e-30f, 1);
    write_image(folder / "a.exr", image);
    EXPECT_EQ(read_image(folder / "a.exr").pixels, image.pixels);
}

TEST(ImageIo, TiffHoldsDoublesExactly) {
    const TemporaryFolder folder;
    Image image = make_noise(37, 51, 1);
    image.at(0, 0) = Rgb(-1e300, 1e-300, 1 + 1e-15);
    write_image(folder / "a.tif", image);
    EXPECT_EQ(read_image(folder / "a.tif").pixels, image.pixels);
}

TEST(ImageIo, PngPreviewIsSrgbWithinHalfAStep) {
    const TemporaryFolder folder;
    const Image image = make_noise(64, 64, 1);
    write_image(folder / "a.png", image);
    const Image encoded = read_image(folder / "a.png", Encoding::linear);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double v = image.pixels[i][c];
            const double srgb = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
            ASSERT_NEAR(encoded.pixels[i][c], srgb, 0.5 / 255 + 1e-12);
        }
    const Image decoded = read_image(folder / "a.png");
    for (std::size_t i = 0; i < image.pixels.size(); ++i) ASSERT_NEAR(decoded.pixels[i].r, image.pixels[i].r, 0.0046);
}

TEST(ImageIo, PngPreviewClampsAndScalesToWhite) {
    const TemporaryFolder folder;
    Image image(2, 1);
    image.at(0, 0) = Rgb(-5, 4, 1e30);
    image.at(1, 0) = Rgb(std::nan(""), 2, 0);
    write_file_atomically(folder / "a.png", encode_png_preview(image, 4));
    const Image preview = read_image(folder / "a.png");
    EXPECT_EQ(preview.at(0, 0), Rgb(0, 1, 1));
    EXPECT_EQ(preview.at(1, 0).r, 0);
    EXPECT_NEAR(preview.at(1, 0).g, 0.5, 0.003);
}

TEST(ImageIo, RowZeroIsOnTop) {
    const TemporaryFolder folder;
    // Binary PPM begins at the top left.
    write_file_atomically(folder / "a.ppm", std::string("P6\n1 2\n255\n\xff\xff\xff\0\0\0", 17));
    const Image image = read_image(folder / "a.ppm");
    EXPECT_EQ(image.at(0, 0), Rgb(1));
    EXPECT_EQ(image.at(0, 1), Rgb(0));
}

TEST(ImageIo, MetadataBecomesAttributes) {
    const TemporaryFolder folder;
    const std::map<std::string, std::string> metadata{{"threefold:scene", "hollow orb"}, {"threefold:seed", "7"}};
    for (const char *name : {"a.exr", "a.png"}) {
        write_image(folder / name, Image(2, 2), metadata);
        EXPECT_EQ(attribute_of(folder / name, "threefold:scene"), "hollow orb");
        EXPECT_EQ(attribute_of(folder / name, "threefold:seed"), "7");
    }
    write_image(folder / "a.tif", Image(2, 2), metadata);
    EXPECT_EQ(attribute_of(folder / "a.tif", "ImageDescription"), "threefold:scene: hollow orb\nthreefold:seed: 7\n");
}

TEST(ImageIo, FilesHoldNoDate) {
    const TemporaryFolder folder;
    for (const char *name : {"a.exr", "a.tif", "a.png"}) {
        write_image(folder / name, Image(2, 2));
        EXPECT_EQ(attribute_of(folder / name, "DateTime"), "") << name;
    }
}

TEST(ImageIo, Png16HoldsEverySampleExactlyAndSaysThatItIsLinear) {
    const TemporaryFolder folder;
    Texture texture{256, 256, {}};
    for (int i = 0; i < 65536; ++i)
        for (int c = 0; c < 3; ++c) texture.rgb.push_back(static_cast<std::uint16_t>(i + 1000 * c));
    const std::string bytes = encode_png16(texture);
    write_file_atomically(folder / "a.png", bytes);
    for (const Encoding encoding : {Encoding::declared, Encoding::linear}) {
        const Image image = read_image(folder / "a.png", encoding);
        for (std::size_t i = 0; i < texture.rgb.size(); ++i)
            ASSERT_EQ(image.pixels[i / 3][static_cast<int>(i % 3)], texture.rgb[i] / 65535.0) << i;
    }
    // PNG specification, 11.3.3.2: gamma times 100000 = 0x000186a0.
    EXPECT_THAT(bytes, HasSubstr(std::string("gAMA\0\x01\x86\xa0", 8)));
    EXPECT_THAT(bytes, AllOf(Not(HasSubstr("sRGB")), Not(HasSubstr("iCCP")), Not(HasSubstr("cHRM"))));
}

TEST(ImageIo, Png16RepeatsTheEdgesOutwards) {
    const TemporaryFolder folder;
    const Texture texture{2, 1, {1, 2, 3, 4, 5, 6}};
    write_file_atomically(folder / "a.png", encode_png16(texture, 2));
    const Image image = read_image(folder / "a.png", Encoding::linear);
    ASSERT_EQ(image.width, 6);
    ASSERT_EQ(image.height, 5);
    for (int row = 0; row < 5; ++row)
        for (int column = 0; column < 6; ++column)
            EXPECT_EQ(image.at(column, row), (column < 3 ? Rgb(1, 2, 3) : Rgb(4, 5, 6)) / 65535.0);
}

TEST(ImageIo, Png16RefusesATextureWithTheWrongNumberOfSamples) {
    EXPECT_THROW(encode_png16(Texture{2, 2, {1, 2, 3}}), Error);
    EXPECT_THROW(encode_png16(Texture{}), Error);
}

TEST(ImageIo, OneChannelIsGrey) {
    const TemporaryFolder folder;
    write_foreign<float>(folder / "a.exr", 2, 1, 1, {0.25f, 4});
    const Image image = read_image(folder / "a.exr");
    EXPECT_EQ(image.at(0, 0), Rgb(0.25));
    EXPECT_EQ(image.at(1, 0), Rgb(4));
    write_foreign<std::uint16_t>(folder / "a.png", 1, 1, 2, {65535, 0}, "Linear");
    EXPECT_EQ(read_image(folder / "a.png").at(0, 0), Rgb(1));
}

TEST(ImageIo, AlphaNeitherCountsNorMultiplies) {
    const TemporaryFolder folder;
    write_foreign<std::uint16_t>(folder / "a.png", 1, 1, 4, {65535, 13107, 0, 6553}, "Linear");
    EXPECT_EQ(read_image(folder / "a.png").at(0, 0), Rgb(1, 0.2, 0));
}

TEST(ImageIo, DeclaredCurvesAreUndoneOnlyWhereTheyAreDeclared) {
    const TemporaryFolder folder;
    const std::vector<std::uint8_t> grey{128, 128, 128};
    const double srgb = std::pow((128 / 255.0 + 0.055) / 1.055, 2.4);
    write_foreign<std::uint8_t>(folder / "srgb.png", 1, 1, 3, grey, "sRGB");
    EXPECT_NEAR(read_image(folder / "srgb.png").at(0, 0).r, srgb, 1e-12);
    EXPECT_EQ(read_image(folder / "srgb.png", Encoding::linear).at(0, 0), Rgb(128 / 255.0));
    write_foreign<std::uint8_t>(folder / "plain.tif", 1, 1, 3, grey);
    EXPECT_NEAR(read_image(folder / "plain.tif").at(0, 0).r, srgb, 1e-12);
    write_foreign<std::uint8_t>(folder / "linear.png", 1, 1, 3, grey, "Linear");
    EXPECT_EQ(read_image(folder / "linear.png").at(0, 0), Rgb(128 / 255.0));
    write_foreign<std::uint8_t>(folder / "gamma.png", 1, 1, 3, grey, "Gamma1.8");
    EXPECT_NEAR(read_image(folder / "gamma.png").at(0, 0).r, std::pow(128 / 255.0, 1.8), 1e-4);
}

TEST(ImageIo, ARewrittenFileIsReadAnew) {
    const TemporaryFolder folder;
    for (const double v : {0.25, 0.5, 0.75}) {
        write_image(folder / "a.exr", Image(4, 4, Rgb(v)));
        EXPECT_EQ(read_image(folder / "a.exr").at(3, 3), Rgb(v));
    }
}

TEST(ImageIo, AMissingPictureIsNamed) {
    const TemporaryFolder folder;
    EXPECT_EQ(message_of(Exit::input_output, [&] { read_image(folder / "absent.exr"); }),
              "cannot read " + (folder / "absent.exr").string() + ": No such file or directory");
    message_of(Exit::input_output, [&] { read_image(folder.path()); });
}

class Truncated : public testing::TestWithParam<const char *> {};

TEST_P(Truncated, PicturesAreBadDataWhereverTheyEnd) {
    const TemporaryFolder folder;
    const fs::path whole = folder / ("whole" + std::string(GetParam()));
    const fs::path part = folder / ("part" + std::string(GetParam()));
    write_image(whole, make_noise(40, 100, 1));
    const std::string bytes = read_file(whole);
    for (int i = 0; i < 50; ++i) {
        // The last bytes of a PNG hold no pixels.
        const std::size_t size = (bytes.size() - 16) * static_cast<std::size_t>(i) / 49;
        write_file_atomically(part, std::string_view(bytes).substr(0, size));
        EXPECT_THAT(message_of(Exit::bad_data, [&] { read_image(part); }), HasSubstr(part.string())) << size;
    }
}

INSTANTIATE_TEST_SUITE_P(ImageIo, Truncated, testing::Values(".exr", ".tif", ".png"));

TEST(ImageIo, GarbageIsBadData) {
    const TemporaryFolder folder;
    for (const char *name : {"a.exr", "a.tif", "a.png", "a.jpg", "a.unknown", "a"}) {
        write_file_atomically(folder / name, "this is no picture");
        EXPECT_THAT(message_of(Exit::bad_data, [&] { read_image(folder / name); }), HasSubstr(name));
    }
}

TEST(ImageIo, AnAbsurdSizeInASmallFileIsBadData) {
    const TemporaryFolder folder;
    write_file_atomically(folder / "a.ppm", "P6\n60000 60000\n255\n");
    EXPECT_THAT(message_of(Exit::bad_data, [&] { read_image(folder / "a.ppm"); }), HasSubstr("60000 x 60000"));
}

TEST(ImageIo, NanAndInfinityAreBadDataAndLocated) {
    const TemporaryFolder folder;
    for (const float bad : {NAN, INFINITY, -INFINITY}) {
        std::vector<float> samples(3 * 6);
        samples[3 * 5 + 1] = bad;
        write_foreign<float>(folder / "a.exr", 3, 2, 3, samples);
        EXPECT_THAT(message_of(Exit::bad_data, [&] { read_image(folder / "a.exr"); }), HasSubstr("pixel (2, 1) is"));
    }
}

TEST(ImageIo, WhatAFormatCannotHoldIsNotWritten) {
    const TemporaryFolder folder;
    for (const char *name : {"a.exr", "a.tif", "a.png"}) {
        message_of(Exit::bad_data, [&] { write_image(folder / name, Image(2, 2, Rgb(std::nan("")))); });
        message_of(Exit::bad_data, [&] { write_image(folder / name, Image()); });
        EXPECT_FALSE(fs::exists(folder / name));
    }
    message_of(Exit::bad_data, [&] { write_image(folder / "a.exr", Image(1, 1, Rgb(1e39))); });
    message_of(Exit::usage, [&] { write_image(folder / "a.bmp", Image(1, 1)); });
}

TEST(ImageIo, AnUnwritablePlaceIsNamedAndLeavesNothing) {
    const TemporaryFolder folder;
    write_file_atomically(folder / "plain", "");
    for (const char *name : {"plain/a.exr", "plain/a.tif", "plain/a.png"})
        EXPECT_THAT(message_of(Exit::input_output, [&] { write_image(folder / name, Image(2, 2)); }), HasSubstr(name));
}

TEST(ImageIo, AverageBlocksIsTheMeanOfEachBlock) {
    Image image(4, 2);
    for (int row = 0; row < 2; ++row)
        for (int column = 0; column < 4; ++column) image.at(column, row) = Rgb(column, row, column * row);
    const Image mean = average_blocks(image, 2);
    ASSERT_EQ(mean.width, 2);
    ASSERT_EQ(mean.height, 1);
    EXPECT_EQ(mean.at(0, 0), Rgb(0.5, 0.5, 0.25));
    EXPECT_EQ(mean.at(1, 0), Rgb(2.5, 0.5, 1.25));
    EXPECT_EQ(average_blocks(image, 1).pixels, image.pixels);
    EXPECT_THROW(average_blocks(image, 3), Error);
    EXPECT_THROW(average_blocks(image, 0), Error);
}

} // namespace
} // namespace threefold
