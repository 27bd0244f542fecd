// SPDX-License-Identifier: MIT
#include "verifier/tolerance/error_bound.h"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace threefold {

namespace {

/// Beyond, quantiles are those of a sum without end to all digits that count.
constexpr double most_freedom = 1e6;

/// (sum x)^2 / sum x^2 of numbers that are not negative; 1 for none.
class Satterthwaite {
public:
    void add(double x) {
        sum_ += x;
        squares_ += x * x;
    }
    double freedom() const { return squares_ > 0 ? std::clamp(sum_ * sum_ / squares_, 1.0, most_freedom) : 1; }
    double sum() const { return sum_; }

private:
    double sum_ = 0, squares_ = 0;
};

/// A sum of squares over its estimate by the spread of so many parts is larger with the chance `significance`.
double ratio_of_squares(double freedom, int parts, double significance) {
    return boost::math::quantile(complement(boost::math::fisher_f(freedom, (parts - 1) * freedom), significance));
}

} // namespace

PartsNoise noise_of_parts(std::span<const Image> parts, const Image &middle, double mean_radiance) {
    Satterthwaite variances;
    for (const Rgb &v : variance_of_mean(parts, middle).pixels) variances.add(v.r + v.g + v.b);
    PartsNoise noise;
    noise.parts = static_cast<int>(parts.size());
    noise.pixels = middle.pixels.size();
    noise.square = variances.sum() / (3 * static_cast<double>(noise.pixels)) / (mean_radiance * mean_radiance);
    noise.freedom = variances.freedom();
    return noise;
}

double PartsNoise::widening(double significance) const { return ratio_of_squares(freedom, parts, significance); }

double PartsNoise::upper2(double offset, double significance) const {
    const double noise = std::sqrt(square * widening(significance / 2));
    // 2 <noise, offset> has a standard deviation of at most twice offset times noise over the root of the pixels.
    const double z = boost::math::quantile(complement(boost::math::normal(), significance / 2));
    const double dependence = std::min(1.0, z / std::sqrt(static_cast<double>(pixels)));
    return noise * noise + offset * offset + 2 * noise * offset * dependence;
}

double error2_upper(const Image &picture, const ReferencePicture &reference, double significance) {
    Satterthwaite variances, products;
    double squares = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const Rgb d = picture.pixels[i] - reference.mean.pixels[i];
        const Rgb &v = reference.variance.pixels[i];
        squares += d.r * d.r + d.g * d.g + d.b * d.b;
        variances.add(v.r + v.g + v.b);
        const double deviation =
            std::abs(d.r) * std::sqrt(v.r) + std::abs(d.g) * std::sqrt(v.g) + std::abs(d.b) * std::sqrt(v.b);
        products.add(deviation * deviation);
    }
    if (variances.sum() > 0) {
        squares += variances.sum() * ratio_of_squares(variances.freedom(), reference.pictures, significance / 2);
        const boost::math::students_t t((reference.pictures - 1) * products.freedom());
        squares += 2 * boost::math::quantile(complement(t, significance / 2)) * std::sqrt(products.sum());
    }
    return squares / (3 * static_cast<double>(picture.pixels.size())) /
           (reference.mean_radiance * reference.mean_radiance);
}

} // namespace threefold
