// SPDX-License-Identifier: MIT
// How large the error of one given picture may be. What is wanted is no mean over seeds but the error of the very
// picture that is handed out, which differs from its expectation the more, the fewer pixels carry it.
//
// Without a reference only the spread of K independent parts is known. Let v_p be the variance of their mean in pixel p
// (its channels taken as wholly dependent: they share their samples). The realised square error is a sum of v_p
// chi^2_1, which is close to chi^2 with nu = (sum v_p)^2 / sum v_p^2 degrees of freedom (Satterthwaite 1946); its
// estimate by the spread is independent of it and has (K - 1) nu. Their ratio follows F(nu, (K - 1) nu). The spread in
// place of v_p makes nu too small by up to (K + 1) / (K - 1), and so the bound too large, which outweighs what the few
// parts do not know of it. Range: samples of pixels drawn independently of each other, as our tracer's are; POV-Ray's
// are not.
//
// With a reference R, itself the mean of parts, the error E = M - T is seen as X = M - R = E - r:
// |E|^2 = |X|^2 + 2 <X, r> + |r|^2. How large both terms of R's noise r may be, its spread tells: by Student's t, by F.
#pragma once

#include <span>

#include "verifier/agreement/error_split.h"

namespace threefold {

/// The noise of the mean of K >= 2 parts with independent pixels.
struct PartsNoise {
    double square = 0;  ///< relative: over the mean radiance's square
    double freedom = 1; ///< nu: so many independent pixels would scatter as these do
    int parts = 2;
    std::size_t pixels = 1;

    /// The realised square error exceeds `square` times this with the chance `significance`.
    double widening(double significance) const;
    /// Bound of the square error with a further error of at most `offset` (relative) in every pixel.
    double upper2(double offset, double significance) const;
};
/// `middle`: their mean.
PartsNoise noise_of_parts(std::span<const Image> parts, const Image &middle, double mean_radiance);

/// Bound of the relative square error of a picture, exceeded with the chance `significance`.
double error2_upper(const Image &picture, const ReferencePicture &reference, double significance);

} // namespace threefold
