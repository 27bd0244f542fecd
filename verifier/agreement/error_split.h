// SPDX-License-Identifier: MIT
// How wrong is a picture, and of what kind is the error? Independent runs of one setting against a reference give the
// mean square error and its two parts: what another seed would change (variance), and what none would (bias).
// All errors are relative: to the reference's mean radiance, over all pixels and channels, and squares are kept,
// because only squares have estimates without bias. With K runs X, their mean M and spread s^2 (K - 1), and a reference
// R whose own mean has the variance v, independent of the runs:
//   mse      = mean_k (X_k - R)^2 - v         the square error of one run
//   variance = s^2
//   bias2    = (M - R)^2 - s^2 / K - v        mse = variance + bias2 but for rounding
// Each is right on average for any K >= 2; bias2 may come out negative where there is no bias to be seen.
//
// How sure they are has two sources. The scatter over tiles of 8 x 8 pixels tells what differs from place to place, the
// reference's own noise among it; but it is blind to what all pixels of a run share (POV-Ray's samples are one grid,
// shifted as a whole by one random number). Leaving out one run at a time (jackknife) tells that, and is blind to the
// reference. So the squares of both are added. What both see is counted twice: where pixels are independent a standard
// error is up to about twice too large, and a bias is claimed less readily, never more. The jackknife's part carries
// Student's factor for K - 1, so that two standard errors hold 95 %. From two runs, of which none can be left out, the
// worst case is taken, that pixels share all their noise: such a bias must be nine times the noise to stand out. Take
// three or more.
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
    int pictures = 1;         ///< that `mean` is of
    std::string kind;         ///< how it was made, for people
    double cpu_seconds = 0;
};

/// Of the mean `middle` of at least two independent pictures, pixel by pixel.
Image variance_of_mean(std::span<const Image> pictures, const Image &middle);

/// The mean of independent pictures and its variance. Error(bad_data) for black pictures: nothing is relative to them.
ReferencePicture to_reference(const std::vector<Image> &pictures);
/// One that is known without noise.
ReferencePicture exact_reference(Image picture);

/// An estimate of a square, and how sure it is: about 95 % lie within two standard errors.
struct Square {
    double value = 0, standard_error = 0;
    double root() const; ///< 0 where the estimate is negative
    bool seen() const { return value > 2 * standard_error; }
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

/// The square error of the mean of these very runs: what is left when they are averaged. Its standard error is that of
/// this picture's error (tiles alone), not of another's.
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
