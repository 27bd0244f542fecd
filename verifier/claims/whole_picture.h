// SPDX-License-Identifier: MIT
// What the claims about whole pictures share: lit, textured pictures that carry no number of their own and are compared
// as pictures; and one border in them whose place is known, so that a picture of something else is noticed.
#pragma once

#include "verifier/claims/claim.h"

namespace threefold {

/// Sampling, replicates and tolerance of a picture that is compared tile by tile: 99 % of its tiles must hold.
/// Error(bad_data) where nothing in it sends light.
void compare_as_picture(Experiment &e, int replicates);

/// A picture of the catalogue's figure in that size.
Experiment whole_picture(const ClaimContext &context, const std::string &scene, int width_px, int height_px,
                         int replicates);

/// A border that runs up and down the picture: it is found as where the colour `inside` begins, counted from the left
/// edge of the picture in pixels, mean over some rows; only what lies about it is rendered.
struct Border {
    std::string object;
    Rgb inside;
    std::function<double(const Camera &camera, double row_px)> column_px;
};

/// The same scene in flat colours of identity, and where its border lies.
Experiment border_experiment(const ClaimContext &context, const std::string &scene, int width_px, int height_px,
                             const Border &border);

} // namespace threefold
