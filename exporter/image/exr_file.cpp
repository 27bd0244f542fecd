// SPDX-License-Identifier: MIT
#include "exporter/image/exr_file.h"

#include <cstdint>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include "exporter/text.h"
#include "scenes/error.h"

namespace threefold {
namespace {

class Bytes : public Imf::OStream {
public:
    Bytes() : OStream("picture.exr") {}

    void write(const char *bytes, int count) override {
        const auto n = static_cast<std::size_t>(count);
        if (text.size() < place_ + n) text.resize(place_ + n);
        text.replace(place_, n, bytes, n);
        place_ += n;
    }
    std::uint64_t tellp() override { return place_; }
    void seekp(std::uint64_t place) override { place_ = place; }

    std::string text;

private:
    std::size_t place_ = 0;
};

} // namespace

std::string encode_exr(const Image &image, const std::map<std::string, std::string> &metadata) try {
    constexpr const char *channels[] = {"R", "G", "B"};
    std::vector<float> samples;
    samples.reserve(image.pixels.size() * 3);
    for (const Rgb &pixel : image.pixels)
        for (int c = 0; c < 3; ++c) samples.push_back(static_cast<float>(pixel[c]));

    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < 3; ++c) {
        header.channels().insert(channels[c], Imf::Channel(Imf::FLOAT));
        frame.insert(channels[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char *>(&samples[c]), 3 * sizeof(float),
                                             3 * sizeof(float) * static_cast<std::size_t>(image.width)));
    }
    header.insert("capDate", Imf::StringAttribute("")); // the same picture is the same file
    for (const auto &[name, value] : metadata) header.insert(name, Imf::StringAttribute(value));

    Bytes bytes;
    {
        Imf::OutputFile file(bytes, header, 0); // without threads of its own
        file.setFrameBuffer(frame);
        file.writePixels(image.height);
    } // the table of lines is written by the end
    return std::move(bytes.text);
} catch (const std::bad_alloc &) {
    throw;
} catch (const std::exception &e) {
    throw Error(Exit::internal, fmt::format("cannot encode a .exr picture of {} x {} pixels: {}", image.width,
                                            image.height, reason(e.what())));
}

} // namespace threefold
