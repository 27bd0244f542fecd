// SPDX-License-Identifier: MIT
// How others decide whether a picture is right, by their published rules: what the power table holds our check against.
// Each compares a picture with one that is known to be good; radiance 1 is white.
#pragma once

#include <string_view>
#include <vector>

#include "exporter/image/image.h"

namespace threefold {

/// `fails` when `value` is beyond `limit`.
struct ImageJudgement {
    bool fails = false;
    double value = 0, limit = 0;
};

/// Blender's cycles_render_tests: idiff --fail 0.016 --failpercent 1 on 8-bit sRGB pictures. The value is the share of
/// pixels of which some channel differs by more than 0.016.
ImageJudgement judge_by_idiff(const Image &reference, const Image &picture);

/// Khronos render fidelity (model-viewer): pixelmatch's squared YIQ distance of 8-bit sRGB colours, 35215 at most; the
/// root of the mean of its squares, as 10 log10 of its share of 35215, must not be above -22 dB.
ImageJudgement judge_by_rms(const Image &reference, const Image &picture);

/// Mitsuba 3's test_renders: a z-test of each pixel and channel against the reference's mean and its variance of one
/// sample, which counts as exact and as at least 1e-4; level 0.01, Sidak over pixels; 99.75 % must pass. The value is
/// the share that does not.
ImageJudgement judge_by_z_test(const Image &mean, const Image &variance_of_a_sample, const Image &picture,
                               double samples_per_pixel);

/// Unbiased, channel by channel, from replicates of so many samples each; at least two.
Image variance_of_a_sample(const std::vector<Image> &replicates, double samples_per_pixel);

} // namespace threefold
