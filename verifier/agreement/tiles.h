// SPDX-License-Identifier: MIT
// Do two renderers' pictures agree, tile by tile?
#pragma once

#include <vector>

#include "exporter/image/image.h"
#include "verifier/agreement/result.h"

namespace threefold {

/// Compares the replicates of two renderers; the spread over replicates is the noise. "All tiles agree" needs every
/// tile's interval inside the tolerance, each tested at `level` (an intersection-union test needs no
/// correction); "some tile differs" is answered by Holm's test over all tiles and channels. With `needed_share` under
/// 1 so many of the tiles must hold; the pictures differ when some tile does by Holm's test and too many by their own.
/// `paired`: replicate k looked through the same points in both, so that what these points do to a picture (its
/// jagged edges) is the same in both and no noise; the spread is that of the differences.
TileComparison compare_tiles(const std::vector<Image> &a, const std::vector<Image> &b, int tile_px, double tolerance,
                             double needed_share = 1, bool paired = false, double level = significance);

/// The same for two single pictures. Without replicates the noise of a tile's mean is taken from the scatter of the
/// pixels' differences in it: right for independent pixels, too wide where a structure differs (then "undecided").
TileComparison compare_tiles_of_single_pictures(const Image &a, const Image &b, int tile_px, double tolerance);

/// Difference of two pictures, a - b, as a picture: grey where equal, red where a is brighter, blue where b is.
Image difference_picture(const Image &a, const Image &b, double full_scale);

} // namespace threefold
