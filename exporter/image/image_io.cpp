// SPDX-License-Identifier: MIT
#include "exporter/image/image_io.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "exporter/files.h"
#include "exporter/image/exr_file.h"
#include "exporter/image/load_pictures.h"
#include "exporter/image/png_file.h"
#include "exporter/text.h"
#include "scenes/error.h"

namespace threefold {
namespace {

[[noreturn]] void throw_bad_picture(const std::filesystem::path &path, std::string why) {
    throw Error(Exit::bad_data, fmt::format("cannot read picture {}: {}", path.string(), reason(std::move(why))));
}

std::string encode_tiff(const Image &image, const std::map<std::string, std::string> &metadata) {
    // TIFF has no free attributes.
    std::string description;
    for (const auto &[name, value] : metadata) description += fmt::format("{}: {}\n", name, value);
    const PictureModule &module = *loaded_pictures().module;
    try {
        return module.encode_tiff(image, description);
    } catch (const std::runtime_error &e) {
        throw Error(Exit::internal, fmt::format("cannot encode a .tif picture of {} x {} pixels: {}", image.width,
                                                image.height, reason(e.what())));
    }
}

std::string encode_srgb(const Image &image, double white, const std::map<std::string, std::string> &metadata) {
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
    return encode_png8(image.width, image.height, samples, metadata);
}

void require_magnitude(const std::filesystem::path &path, const Image &image, double limit) {
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column)
            for (int c = 0; c < 3; ++c)
                if (const double v = image.at(column, row)[c]; !(std::abs(v) <= limit))
                    throw Error(Exit::bad_data, fmt::format("cannot write picture {}: pixel ({}, {}) is {}",
                                                            path.string(), column, row, v));
}

/// What the module makes of the file.
template <class Work>
auto from_file(const std::filesystem::path &path, Work work) {
    const std::int64_t bytes = require_readable_file(path);
    if (bytes == 0) throw_bad_picture(path, "the file is empty");
    const PictureModule &module = *loaded_pictures().module;
    try {
        return work(module, path.string(), bytes);
    } catch (const std::runtime_error &e) {
        throw_bad_picture(path, e.what());
    }
}

} // namespace

PictureHeader read_picture_header(const std::filesystem::path &path) {
    return from_file(path, [](const PictureModule &module, const std::string &name, std::int64_t bytes) {
        return module.header(name, bytes);
    });
}

Image read_image(const std::filesystem::path &path, Encoding encoding) {
    return from_file(path, [encoding](const PictureModule &module, const std::string &name, std::int64_t bytes) {
        return module.read(name, bytes, encoding == Encoding::declared);
    });
}

void write_image(const std::filesystem::path &path, const Image &image,
                 const std::map<std::string, std::string> &metadata) {
    const std::string extension = lower_case(path.extension().string());
    const bool exr = extension == ".exr", tiff = extension == ".tif" || extension == ".tiff", png = extension == ".png";
    if (!exr && !tiff && !png)
        throw Error(Exit::usage, fmt::format("cannot write picture {}: unknown extension", path.string()),
                    "use .exr (32-bit float), .tif (64-bit float) or .png (8-bit preview)");
    if (image.width < 1 || image.height < 1)
        throw Error(Exit::bad_data, fmt::format("cannot write picture {}: it has no pixels", path.string()));
    require_magnitude(path, image, exr ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max());
    write_file_atomically(path, exr    ? encode_exr(image, metadata)
                                : tiff ? encode_tiff(image, metadata)
                                       : encode_srgb(image, 1, metadata));
}

std::string encode_png_preview(const Image &image, double white) { return encode_srgb(image, white, {}); }

std::string encode_png16(const Texture &texture, int border_texels) {
    if (texture.width < 1 || texture.height < 1 || border_texels < 0 ||
        texture.rgb.size() !=
            std::size_t{3} * static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height))
        throw Error(Exit::internal, fmt::format("a texture of {} x {} texels with {} samples cannot be", texture.width,
                                                texture.height, texture.rgb.size()));
    const int width = texture.width + 2 * border_texels, height = texture.height + 2 * border_texels;
    std::vector<std::uint16_t> samples;
    samples.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
    for (int y = 0; y < height; ++y) {
        const int row = std::clamp(y - border_texels, 0, texture.height - 1);
        for (int x = 0; x < width; ++x) {
            const int column = std::clamp(x - border_texels, 0, texture.width - 1);
            const auto first = texture.rgb.begin() + 3 * (std::ptrdiff_t{row} * texture.width + column);
            samples.insert(samples.end(), first, first + 3);
        }
    }
    return encode_png16(width, height, samples);
}

std::string encode_png_srgb(const Texture &texture) {
    Image image(texture.width, texture.height);
    auto sample = texture.rgb.begin();
    for (Rgb &pixel : image.pixels)
        for (int c = 0; c < 3; ++c) pixel[c] = *sample++ / 65535.0;
    return encode_srgb(image, 1, {});
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
