// SPDX-License-Identifier: MIT
// One picture of the extremes study against quad precision, by the classes of extremes.h.
#pragma once

#include <span>

#include "exporter/image/image.h"
#include "exporter/job.h"
#include "verifier/studies/exact_pixel.h"
#include "verifier/studies/extremes.h"

namespace threefold {

/// What was stated of a picture before it was made.
struct Stated {
    Accuracy accuracy;
    /// Our tracer: its rounding and floor; 0 for others, whose accuracy says all.
    double rounding = 0, floor = 0;
};

/// `exact`: of each pixel, row by row.
ExtremeFinding judge_landing(const Image &image, const Scene &scene, std::span<const ExactPixel> exact,
                             const Stated &stated);

/// Surroundings of radiance 1 about one orb: every pixel is 1, but for what was stated to be dropped.
ExtremeFinding judge_light(const Image &image, const Scene &scene, const Stated &stated, int samples_per_pixel);

} // namespace threefold
