// SPDX-License-Identifier: MIT
// How wrong is a picture, and of what kind is the error? Independent runs of one setting against a reference give the
// mean square error and its two parts: what another seed would change (variance), and what none would (bias).
// All errors are relative: to the reference's mean radiance, over all pixels and channels, and squares are kept, because
// only squares have estimates without bias. With K runs X, their mean M and spread s^2 (K - 1), and a reference R whose
// own mean has the variance v, independent of the runs:
//   mse      = mean_k (X_k - R)^2 - v         the square error of one run
//   variance = s^2
//   bias2    = (M - R)^2 - s^2 / K - v        mse = variance + bias2 but for rounding
// Each is right on average for any K >= 2; bias2 may come out negative where there is no bias to be seen.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "exporter/image/image.h"

namespace threefold {

struct ReferencePicture {
    Image mean;
    Image variance;           ///< of `mean`, pixel by pixel
    double mean_radiance = 0; ///< over pixels and channels
    double error = 0;         ///< relative RMS error of `mean` through its noise
    std::string kind;         ///< how it was made, for people
    double cpu_seconds = 0;
};

/// The mean of independent pictures and its variance. Error(bad_data) for black pictures: nothing is relative to them.
ReferencePicture to_reference(const std::vector<Image> &pictures);
/// One that is known without noise.
ReferencePicture exact_reference(Image picture);

/// An estimate of a square, and how sure it is (from the scatter over tiles of 8 x 8 pixels).
struct Square {
    double value = 0, standard_error = 0;
    double root() const; ///< 0 where the estimate is negative
};

struct ErrorSplit {
    Square mse, variance, bias2;
    double tile_mse = 0; ///< of the means of 8 x 8 pixels
    int runs = 0;
};

/// At least two runs of the reference's size.
ErrorSplit split_error(std::span<const Image> runs, const ReferencePicture &reference);

/// The part of the bias in which two settings differ, from runs with the same seeds: the square of the mean difference
/// (relative to `mean_radiance`), with what the noise of the differences adds to it taken off.
Square paired_bias2(std::span<const Image> a, std::span<const Image> b, double mean_radiance);

/// The square error of the mean of all runs: what is left when they are averaged.
Square error2_of_mean(std::span<const Image> runs, const ReferencePicture &reference);
/// Of that, what noise adds, told by the spread alone: no reference is needed.
double noise2_of_mean(std::span<const Image> runs, double mean_radiance);

/// variance(n) = factor * n^-rate, n samples a pixel.
struct NoiseLaw {
    double factor = 0, rate = 1;
    double variance(double samples) const;
    /// The least number of samples for a variance; infinite where none is enough.
    double samples(double variance) const;
};
struct NoisePoint {
    double samples, variance;
};
/// Least squares in logarithms; points without noise are left out. The rate is held in [0.5, 3]: 1 for independent
/// samples, up to 2 or so for evenly spread ones; with a single point it is 1.
NoiseLaw fit_noise_law(std::span<const NoisePoint> points);

/// Of points (cost, error): those that no other beats in both, by rising cost.
std::vector<std::size_t> pareto_front(std::span<const double> costs, std::span<const double> errors);

} // namespace threefold
