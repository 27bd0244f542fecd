// SPDX-License-Identifier: MIT
#include "exporter/image/png_file.h"

#include <bit>
#include <csetjmp>
#include <utility>

#include <fmt/format.h>
#include <png.h>
#include <zlib.h>

#include "exporter/text.h"
#include "scenes/error.h"

namespace threefold {
namespace {

struct Job {
    int width, height, bits;
    const unsigned char *samples; ///< in the machine's order of bytes
    std::vector<std::pair<std::string, std::string>> texts;
    std::string bytes = {}, failure = {};
};

void append(png_structp png, png_bytep bytes, std::size_t count) {
    try {
        static_cast<Job *>(png_get_io_ptr(png))->bytes.append(reinterpret_cast<const char *>(bytes), count);
        return;
    } catch (const std::exception &) { // no exception passes through libpng
    }
    png_error(png, "out of memory");
}

[[noreturn]] void fail(png_structp png, png_const_charp reason) {
    static_cast<Job *>(png_get_error_ptr(png))->failure = reason;
    png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

void write(png_structp png, png_infop info, Job &job) {
    png_set_write_fn(png, &job, append, nullptr);
    png_set_compression_level(png, 6);
    png_set_compression_strategy(png, Z_DEFAULT_STRATEGY);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_NO_FILTERS);
    png_set_IHDR(png, info, static_cast<png_uint_32>(job.width), static_cast<png_uint_32>(job.height), job.bits,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_oFFs(png, info, 0, 0, PNG_OFFSET_PIXEL);
    if (job.bits == 8)
        png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
    else
        png_set_gAMA(png, info, 1.0);
    for (auto &[name, value] : job.texts) {
        png_text text{};
        text.compression = PNG_TEXT_COMPRESSION_NONE;
        text.key = name.data();
        text.text = value.data();
        text.text_length = value.size();
        png_set_text(png, info, &text, 1);
    }
    png_write_info(png, info);
    if (job.bits == 16 && std::endian::native == std::endian::little) png_set_swap(png);
    const std::size_t row_bytes = std::size_t{3} * static_cast<std::size_t>(job.width * (job.bits / 8));
    for (int row = 0; row < job.height; ++row)
        png_write_row(png, job.samples + static_cast<std::size_t>(row) * row_bytes);
    png_write_end(png, info);
}

/// libpng reports an error by a jump to here: nothing that needs a destructor may lie between.
bool write_guarded(png_structp png, png_infop info, Job &job) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    write(png, info, job);
    return true;
}

std::string encode(Job job) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &job, fail, ignore);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    const bool whole = info && write_guarded(png, info, job);
    png_destroy_write_struct(&png, &info);
    if (!whole)
        throw Error(Exit::internal, fmt::format("cannot encode a .png picture of {} x {} pixels: {}", job.width,
                                                job.height, reason(std::move(job.failure))));
    return std::move(job.bytes);
}

} // namespace

std::string encode_png8(int width, int height, const std::vector<std::uint8_t> &samples,
                        const std::map<std::string, std::string> &metadata) {
    Job job{width, height, 8, samples.data(), {metadata.begin(), metadata.end()}};
    job.texts.emplace_back("oiio:ColorSpace", "sRGB");
    return encode(std::move(job));
}

std::string encode_png16(int width, int height, const std::vector<std::uint16_t> &samples) {
    return encode(
        {width, height, 16, reinterpret_cast<const unsigned char *>(samples.data()), {{"oiio:ColorSpace", "Linear"}}});
}

} // namespace threefold
