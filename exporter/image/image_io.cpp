// SPDX-License-Identifier: MIT
#include "exporter/image/image_io.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include "exporter/files.h"
#include "exporter/text.h"
#include "scenes/error.h"

namespace threefold {
namespace {

// Larger ones are damaged headers: without a limit a file of a hundred bytes could ask for all memory.
constexpr std::int64_t max_pixels = std::int64_t{1} << 28;
constexpr std::int64_t max_compression = 100'000;

[[noreturn]] void throw_bad_picture(const std::filesystem::path &path, std::string why) {
    throw Error(Exit::bad_data, fmt::format("cannot read picture {}: {}", path.string(), reason(std::move(why))));
}

void undo_curve(Image &image, const OIIO::ImageSpec &spec) {
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

/// The file in memory; the writers of OpenImageIO would otherwise leave a part of a file on a full disk.
std::string encode(const char *extension, const OIIO::ImageSpec &spec, OIIO::TypeDesc format, const void *samples) {
    const auto fail = [&](std::string why) {
        if (why.empty()) why = OIIO::geterror();
        throw Error(Exit::internal, fmt::format("cannot encode a {} picture of {} x {} pixels: {}", extension,
                                                spec.width, spec.height, reason(std::move(why))));
    };
    const std::string name = std::string("picture") + extension;
    OIIO::Filesystem::IOVecOutput bytes;
    const auto output = OIIO::ImageOutput::create(name);
    if (!output || !output->supports("ioproxy") || !output->set_ioproxy(&bytes))
        fail(output ? "this OpenImageIO cannot write it in memory" : "");
    if (!output->open(name, spec)) fail(output->geterror());
    if (!output->write_image(format, samples)) fail(output->geterror());
    if (!output->close()) fail(output->geterror());
    const std::vector<unsigned char> &buffer = bytes.buffer();
    return {buffer.begin(), buffer.end()};
}

OIIO::ImageSpec specify(const Image &image, OIIO::TypeDesc format) {
    OIIO::ImageSpec spec(image.width, image.height, 3, format);
    if (format.is_floating_point()) spec.attribute("DateTime", ""); // so that the same picture is the same file
    return spec;
}

void add_attributes(OIIO::ImageSpec &spec, const std::map<std::string, std::string> &metadata) {
    for (const auto &[name, value] : metadata) spec.attribute(name, value);
}

std::string encode_exr(const Image &image, const std::map<std::string, std::string> &metadata) {
    OIIO::ImageSpec spec = specify(image, OIIO::TypeDesc::FLOAT);
    add_attributes(spec, metadata);
    spec.attribute("compression", "zip");
    std::vector<float> samples;
    samples.reserve(image.pixels.size() * 3);
    for (const Rgb &pixel : image.pixels)
        for (int c = 0; c < 3; ++c) samples.push_back(static_cast<float>(pixel[c]));
    return encode(".exr", spec, OIIO::TypeDesc::FLOAT, samples.data());
}

std::string encode_tiff(const Image &image, const std::map<std::string, std::string> &metadata) {
    OIIO::ImageSpec spec = specify(image, OIIO::TypeDesc::DOUBLE);
    // TIFF has no free attributes.
    std::string description;
    for (const auto &[name, value] : metadata) description += fmt::format("{}: {}\n", name, value);
    if (!description.empty()) spec.attribute("ImageDescription", description);
    spec.attribute("compression", "zip");
    return encode(".tif", spec, OIIO::TypeDesc::DOUBLE, image.pixels.data());
}

std::string encode_png8(const Image &image, double white, const std::map<std::string, std::string> &metadata) {
    OIIO::ImageSpec spec = specify(image, OIIO::TypeDesc::UINT8);
    add_attributes(spec, metadata);
    spec.attribute("oiio:ColorSpace", "sRGB");
    std::vector<std::uint8_t> samples;
    samples.reserve(image.pixels.size() * 3);
    for (const Rgb &pixel : image.pixels) {
        for (int c = 0; c < 3; ++c) {
            const double radiance = pixel[c] / white;
            const double v = radiance > 0 ? std::min(radiance, 1.0) : 0; // NaN becomes black
            const double encoded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; // IEC 61966-2-1
            samples.push_back(static_cast<std::uint8_t>(std::lround(255 * encoded)));
        }
    }
    return encode(".png", spec, OIIO::TypeDesc::UINT8, samples.data());
}

void require_magnitude(const std::filesystem::path &path, const Image &image, double limit) {
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column)
            for (int c = 0; c < 3; ++c)
                if (const double v = image.at(column, row)[c]; !(std::abs(v) <= limit))
                    throw Error(Exit::bad_data, fmt::format("cannot write picture {}: pixel ({}, {}) is {}",
                                                            path.string(), column, row, v));
}

std::unique_ptr<OIIO::ImageInput> open_picture(const std::filesystem::path &path) {
    const std::int64_t bytes = require_readable_file(path);
    if (bytes == 0) throw_bad_picture(path, "the file is empty");

    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    // ImageInput, not ImageBuf: that one may answer with the pixels of an earlier file of the same name.
    auto input = OIIO::ImageInput::open(path.string(), &config);
    if (!input) throw_bad_picture(path, OIIO::geterror());
    const OIIO::ImageSpec &spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 || spec.deep)
        throw_bad_picture(path, "it is not a flat picture");
    const auto native_bytes = static_cast<std::int64_t>(spec.image_bytes(true));
    if (spec.image_pixels() > static_cast<OIIO::imagesize_t>(max_pixels) || native_bytes / max_compression > bytes)
        throw_bad_picture(path, fmt::format("{} x {} pixels in {} bytes cannot be", spec.width, spec.height, bytes));
    return input;
}

} // namespace

glm::ivec2 picture_size_px(const std::filesystem::path &path) {
    const auto input = open_picture(path);
    return {input->spec().width, input->spec().height};
}

Image read_image(const std::filesystem::path &path, Encoding encoding) {
    const auto input = open_picture(path);
    const OIIO::ImageSpec &spec = input->spec();
    const int channels = spec.nchannels < 3 ? 1 : 3;
    Image image(spec.width, spec.height);
    const bool whole = spec.format == OIIO::TypeDesc::UINT8    ? read_integers<std::uint8_t>(*input, channels, image)
                       : spec.format == OIIO::TypeDesc::UINT16 ? read_integers<std::uint16_t>(*input, channels, image)
                                                               : read_samples(*input, channels, image);
    if (!whole) throw_bad_picture(path, input->geterror());
    // Some readers fill in zeros, leave an error behind and still say that all is well.
    if (input->has_error()) throw_bad_picture(path, input->geterror());
    if (channels == 1)
        for (Rgb &pixel : image.pixels) pixel = Rgb(pixel.r);

    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column)
            for (int c = 0; c < 3; ++c)
                if (!std::isfinite(image.at(column, row)[c]))
                    throw_bad_picture(path, fmt::format("pixel ({}, {}) is {}", column, row, image.at(column, row)[c]));
    if (encoding == Encoding::declared) undo_curve(image, spec);
    return image;
}

void write_image(const std::filesystem::path &path, const Image &image,
                 const std::map<std::string, std::string> &metadata) {
    const std::string extension = OIIO::Strutil::lower(path.extension().string());
    const bool exr = extension == ".exr", tiff = extension == ".tif" || extension == ".tiff", png = extension == ".png";
    if (!exr && !tiff && !png)
        throw Error(Exit::usage, fmt::format("cannot write picture {}: unknown extension", path.string()),
                    "use .exr (32-bit float), .tif (64-bit float) or .png (8-bit preview)");
    if (image.width < 1 || image.height < 1)
        throw Error(Exit::bad_data, fmt::format("cannot write picture {}: it has no pixels", path.string()));
    require_magnitude(path, image, exr ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max());
    write_file_atomically(path, exr    ? encode_exr(image, metadata)
                                : tiff ? encode_tiff(image, metadata)
                                       : encode_png8(image, 1, metadata));
}

std::string encode_png_preview(const Image &image, double white) { return encode_png8(image, white, {}); }

std::string encode_png16(const Texture &texture, int border_texels) {
    if (texture.width < 1 || texture.height < 1 || border_texels < 0 ||
        texture.rgb.size() !=
            std::size_t{3} * static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height))
        throw Error(Exit::internal, fmt::format("a texture of {} x {} texels with {} samples cannot be", texture.width,
                                                texture.height, texture.rgb.size()));
    OIIO::ImageSpec spec(texture.width + 2 * border_texels, texture.height + 2 * border_texels, 3,
                         OIIO::TypeDesc::UINT16);
    // Writes the gamma chunk 1.0, the only declaration that stops every reader from converting.
    spec.attribute("oiio:ColorSpace", "Linear");
    std::vector<std::uint16_t> samples;
    samples.reserve(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) * 3);
    for (int y = 0; y < spec.height; ++y) {
        const int row = std::clamp(y - border_texels, 0, texture.height - 1);
        for (int x = 0; x < spec.width; ++x) {
            const int column = std::clamp(x - border_texels, 0, texture.width - 1);
            const auto first = texture.rgb.begin() + 3 * (std::ptrdiff_t{row} * texture.width + column);
            samples.insert(samples.end(), first, first + 3);
        }
    }
    return encode(".png", spec, OIIO::TypeDesc::UINT16, samples.data());
}

std::string encode_png_srgb(const Texture &texture) {
    Image image(texture.width, texture.height);
    auto sample = texture.rgb.begin();
    for (Rgb &pixel : image.pixels)
        for (int c = 0; c < 3; ++c) pixel[c] = *sample++ / 65535.0;
    return encode_png8(image, 1, {});
}

Image average_blocks(const Image &image, int factor) {
    if (factor < 1 || image.width % factor != 0 || image.height % factor != 0)
        throw Error(Exit::internal,
                    fmt::format("cannot average {} x {} pixels in blocks of {}", image.width, image.height, factor));
    Image result(image.width / factor, image.height / factor);
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column)
            result.at(column / factor, row / factor) += image.at(column, row);
    const double area = static_cast<double>(factor) * factor;
    for (Rgb &pixel : result.pixels) pixel /= area;
    return result;
}

} // namespace threefold
