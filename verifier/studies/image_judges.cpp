// SPDX-License-Identifier: MIT
#include "verifier/studies/image_judges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/common.hpp>

namespace threefold {

namespace {

/// 0 to 255, as an 8-bit sRGB file has it (IEC 61966-2-1).
double in_8_bits(double radiance) {
    const double x = std::clamp(radiance, 0.0, 1.0);
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return std::floor(encoded * 255 + 0.5);
}

Rgb in_8_bits(Rgb c) { return {in_8_bits(c.r), in_8_bits(c.g), in_8_bits(c.b)}; }

/// Kotsarenko and Ramos, Measuring perceived color difference using YIQ (2010), as pixelmatch weighs it.
double yiq_distance(Rgb a, Rgb b) {
    const Rgb d = a - b;
    const double y = 0.29889531 * d.r + 0.58662247 * d.g + 0.11448223 * d.b;
    const double i = 0.59597799 * d.r - 0.27417610 * d.g - 0.32180189 * d.b;
    const double q = 0.21147017 * d.r - 0.52261711 * d.g + 0.31114694 * d.b;
    return 0.5053 * y * y + 0.299 * i * i + 0.1957 * q * q;
}

} // namespace

ImageJudgement judge_by_idiff(const Image &reference, const Image &picture) {
    constexpr double threshold = 0.016, most = 0.01;
    double differing = 0;
    for (std::size_t k = 0; k < picture.pixels.size(); ++k) {
        const Rgb d = glm::abs(in_8_bits(picture.pixels[k]) - in_8_bits(reference.pixels[k])) / 255.0;
        differing += std::max({d.r, d.g, d.b}) > threshold;
    }
    const double share = differing / static_cast<double>(picture.pixels.size());
    return {share > most, share, most};
}

ImageJudgement judge_by_rms(const Image &reference, const Image &picture) {
    constexpr double greatest_distance = 35215, limit_db = -22;
    double squares = 0;
    for (std::size_t k = 0; k < picture.pixels.size(); ++k) {
        const double d = yiq_distance(in_8_bits(picture.pixels[k]), in_8_bits(reference.pixels[k]));
        squares += d * d;
    }
    const double rms = std::sqrt(squares / static_cast<double>(picture.pixels.size())) / greatest_distance;
    const double db = rms > 0 ? 10 * std::log10(rms) : -std::numeric_limits<double>::infinity();
    return {db > limit_db, db, limit_db};
}

ImageJudgement judge_by_z_test(const Image &mean, const Image &variance, const Image &picture,
                               double samples_per_pixel) {
    constexpr double level = 0.01, passing = 0.9975, least_variance = 1e-4;
    const auto pixels = static_cast<double>(picture.pixels.size());
    const double alpha = 1 - std::pow(1 - level, 1 / pixels);
    double failing = 0;
    for (std::size_t k = 0; k < picture.pixels.size(); ++k)
        for (int channel = 0; channel < 3; ++channel) {
            const double z = std::abs(picture.pixels[k][channel] - mean.pixels[k][channel]) *
                             std::sqrt(samples_per_pixel / std::max(least_variance, variance.pixels[k][channel]));
            const double p = std::erfc(z / std::numbers::sqrt2); // two-sided
            failing += !(p > alpha);
        }
    const double share = failing / (3 * pixels);
    return {pixels - failing / 3 < passing * pixels, share, 1 - passing};
}

Image variance_of_a_sample(const std::vector<Image> &replicates, double samples_per_pixel) {
    const Image centre = mean(replicates);
    Image variance(centre.width, centre.height);
    for (const Image &image : replicates)
        for (std::size_t k = 0; k < variance.pixels.size(); ++k) {
            const Rgb d = image.pixels[k] - centre.pixels[k];
            variance.pixels[k] += d * d;
        }
    const double factor = samples_per_pixel / static_cast<double>(replicates.size() - 1);
    for (Rgb &v : variance.pixels) v *= factor;
    return variance;
}

} // namespace threefold
