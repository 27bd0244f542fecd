// SPDX-License-Identifier: MIT
// Do two renderers' pictures agree, tile by tile?
#pragma once

#include <vector>

#include "exporter/image/image.h"
#include "verifier/agreement/result.h"

namespace threefold {

/// Of so many tiles the mean may lie beyond the tolerance: the rest of `needed_share`, rounded down.
int tiles_allowed(int tiles, double needed_share);
/// The level at which each tile is tested, so that the verdict on all of them is wrong no more often than `level`.
double tile_level(double level, int allowed);

/// Compares the replicates of two renderers; the spread over replicates is the noise. What is tested is a number of
/// tiles: of how many the true mean lies beyond the tolerance. With a = tiles_allowed of n tiles, each verdict rejects
/// its own null hypothesis at `level` (partial conjunction, Benjamini and Heller 2008), whatever the tiles' dependence:
/// - "holds", at most a tiles lie beyond: n - a tiles pass the equivalence test at level / (a + 1). Were m > a tiles
///   beyond, m - a of them would have to pass; by Markov's inequality the chance of that is at most
///   m / (m - a) level / (a + 1). With a = 0 this is the intersection-union test of all tiles.
/// - "fails", more than a tiles lie beyond: a + 1 tiles have a p-value (of three channels, times three) of at most
///   level / (n - a); were only a beyond, one of the n - a others would have to be among them.
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
