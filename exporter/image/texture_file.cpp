// SPDX-License-Identifier: MIT
#include "exporter/image/texture_file.h"

#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "exporter/image/image_io.h"
#include "scenes/error.h"

namespace threefold {
namespace {

constexpr std::int64_t most_pixels = std::int64_t{1} << 26;

} // namespace

std::shared_ptr<const Texture> read_texture(const std::filesystem::path &path, double gamma) {
    if (!(gamma == 0 || (gamma > 0 && std::isfinite(gamma))))
        throw Error(Exit::bad_data,
                    fmt::format("the gamma of a texture must be 0 or a positive number, not {}", gamma));
    const PictureHeader header = read_picture_header(path);
    const glm::ivec2 size = header.size_px;
    if (std::int64_t{size.x} * size.y > most_pixels)
        throw Error(Exit::bad_data,
                    fmt::format("picture {} has {} x {} pixels: a texture may have {}", path.string(), size.x, size.y,
                                most_pixels),
                    "make it smaller; Threefold does not change a user's picture");
    // What renderers make of these two differs, and a viewer shows another picture again.
    if (header.offset_px != glm::ivec2(0) || header.display_px != size)
        throw Error(Exit::bad_data,
                    fmt::format("picture {} stores {} x {} pixels at ({}, {}) of a picture of {} x {}", path.string(),
                                size.x, size.y, header.offset_px.x, header.offset_px.y, header.display_px.x,
                                header.display_px.y),
                    "save it anew with a data window as large as its display window");
    if (header.orientation != 1)
        throw Error(Exit::bad_data,
                    fmt::format("picture {} says that it is to be turned or mirrored (EXIF orientation {})",
                                path.string(), header.orientation),
                    "save it anew, turned as it is to be seen, with orientation 1");
    const Image image = read_image(path, gamma > 0 ? Encoding::linear : Encoding::declared);
    auto texture = std::make_shared<Texture>();
    texture->width = image.width;
    texture->height = image.height;
    texture->rgb.reserve(image.pixels.size() * 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double v = image.pixels[i][c];
            if (!(v >= 0 && v <= 1)) {
                const auto width = static_cast<std::size_t>(image.width);
                throw Error(Exit::bad_data,
                            fmt::format("picture {}: pixel ({}, {}) is {}; a texture's samples lie in [0, 1]",
                                        path.string(), i % width, i / width, v));
            }
            const double linear = gamma > 0 ? std::pow(v, gamma) : v;
            texture->rgb.push_back(static_cast<std::uint16_t>(std::lround(65535 * linear)));
        }
    return texture;
}

} // namespace threefold
