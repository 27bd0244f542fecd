// SPDX-License-Identifier: MIT
#include "exporter/image/picture_module.h"

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include "exporter/image/picture_module_version.h"

namespace threefold {
namespace {

// Larger ones are damaged headers: without a limit a file of a hundred bytes could ask for all memory.
constexpr std::int64_t max_pixels = std::int64_t{1} << 28;
constexpr std::int64_t max_compression = 100'000;

void undo_curve_of(Image &image, const OIIO::ImageSpec &spec) {
    if (spec.format.is_floating_point()) return;
    const std::string space = spec.get_string_attribute("oiio:ColorSpace", spec.format.size() == 1 ? "sRGB" : "");
    const double gamma = spec.get_float_attribute("oiio:Gamma", 1);
    const bool srgb = OIIO::Strutil::iequals(space, "sRGB");
    if (!srgb && !(gamma > 0 && gamma != 1)) return;
    const auto decode = [&](double v) {
        if (!srgb) return std::pow(v, gamma);
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); // IEC 61966-2-1
    };
    for (Rgb &pixel : image.pixels)
        for (int c = 0; c < 3; ++c) pixel[c] = decode(pixel[c]);
}

bool read_samples(OIIO::ImageInput &input, int channels, Image &image) {
    static_assert(sizeof(Rgb) == 3 * sizeof(double));
    return input.read_image(0, 0, 0, channels, OIIO::TypeDesc::DOUBLE, image.pixels.data(), sizeof(Rgb));
}

/// OpenImageIO's own conversion of integers to double goes through float and loses 3e-8.
template <class Integer>
bool read_integers(OIIO::ImageInput &input, int channels, Image &image) {
    std::vector<Integer> samples(image.pixels.size() * static_cast<std::size_t>(channels));
    if (!input.read_image(0, 0, 0, channels, OIIO::BaseTypeFromC<Integer>::value, samples.data())) return false;
    auto sample = samples.cbegin();
    for (Rgb &pixel : image.pixels)
        for (int c = 0; c < channels; ++c) pixel[c] = double(*sample++) / std::numeric_limits<Integer>::max();
    return true;
}

std::unique_ptr<OIIO::ImageInput> open_picture(const std::string &path, std::int64_t bytes) {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    // ImageInput, not ImageBuf: that one may answer with the pixels of an earlier file of the same name.
    auto input = OIIO::ImageInput::open(path, &config);
    if (!input) throw std::runtime_error(OIIO::geterror());
    const OIIO::ImageSpec &spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 || spec.deep)
        throw std::runtime_error("it is not a flat picture");
    const auto native_bytes = static_cast<std::int64_t>(spec.image_bytes(true));
    if (spec.image_pixels() > static_cast<OIIO::imagesize_t>(max_pixels) || native_bytes / max_compression > bytes)
        throw std::runtime_error(fmt::format("{} x {} pixels in {} bytes cannot be", spec.width, spec.height, bytes));
    return input;
}

PictureHeader header(const std::string &path, std::int64_t bytes) {
    const auto input = open_picture(path, bytes);
    const OIIO::ImageSpec &spec = input->spec();
    return {{spec.width, spec.height},
            {spec.x - spec.full_x, spec.y - spec.full_y},
            {spec.full_width, spec.full_height},
            spec.get_int_attribute("Orientation", 1)};
}

Image read(const std::string &path, std::int64_t bytes, bool undo_curve) {
    const auto input = open_picture(path, bytes);
    const OIIO::ImageSpec &spec = input->spec();
    const int channels = spec.nchannels < 3 ? 1 : 3;
    Image image(spec.width, spec.height);
    const bool whole = spec.format == OIIO::TypeDesc::UINT8    ? read_integers<std::uint8_t>(*input, channels, image)
                       : spec.format == OIIO::TypeDesc::UINT16 ? read_integers<std::uint16_t>(*input, channels, image)
                                                               : read_samples(*input, channels, image);
    // Some readers fill in zeros, leave an error behind and still say that all is well.
    if (!whole || input->has_error()) throw std::runtime_error(input->geterror());
    if (channels == 1)
        for (Rgb &pixel : image.pixels) pixel = Rgb(pixel.r);

    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column)
            for (int c = 0; c < 3; ++c)
                if (const double v = image.at(column, row)[c]; !std::isfinite(v))
                    throw std::runtime_error(fmt::format("pixel ({}, {}) is {}", column, row, v));
    if (undo_curve) undo_curve_of(image, spec);
    return image;
}

/// In memory: the writers of OpenImageIO would otherwise leave a part of a file on a full disk.
std::string encode_tiff(const Image &image, const std::string &description) {
    OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::DOUBLE);
    spec.attribute("DateTime", ""); // so that the same picture is the same file
    if (!description.empty()) spec.attribute("ImageDescription", description);
    spec.attribute("compression", "zip");
    const std::string name = "picture.tif";
    OIIO::Filesystem::IOVecOutput bytes;
    const auto output = OIIO::ImageOutput::create(name);
    if (!output) throw std::runtime_error(OIIO::geterror());
    if (!output->supports("ioproxy") || !output->set_ioproxy(&bytes))
        throw std::runtime_error("this OpenImageIO cannot write it in memory");
    if (!output->open(name, spec) || !output->write_image(OIIO::TypeDesc::DOUBLE, image.pixels.data()) ||
        !output->close())
        throw std::runtime_error(output->geterror());
    const std::vector<unsigned char> &buffer = bytes.buffer();
    return {buffer.begin(), buffer.end()};
}

} // namespace
} // namespace threefold

extern "C" __attribute__((visibility("default"))) const threefold::PictureModule threefold_pictures{
    threefold::picture_module_version, OIIO_VERSION_STRING, threefold::header, threefold::read, threefold::encode_tiff};
