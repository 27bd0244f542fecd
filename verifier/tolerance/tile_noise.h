// SPDX-License-Identifier: MIT
// How many samples a picture takes whose tiles are to be told to agree with another's (verifier/agreement/tiles.h), by
// a pilot: two pictures with few samples. Noise differs from tile to tile by orders of magnitude, most of all where
// glass splits rays, so the noise of the whole picture would not tell.
#pragma once

#include <span>
#include <vector>

#include "verifier/witness/witness.h"

namespace threefold {

struct TilesWanted {
    int tile_px = 16;
    double tolerance = 0;    ///< on a tile's mean, absolute radiance
    double needed_share = 1; ///< of all tiles must hold
    int least_samples = 1;
    int most_samples = 1 << 16; ///< what more would take is left open by the comparison
};

/// Standard deviation of each tile's mean in one picture, of the channel where it is greatest, from two that differ by
/// their seed alone. Pixels count as independent. The tiles are those of TileGrid, which the comparison judges.
std::vector<double> tile_noise(const Image &a, const Image &b, int tile_px);

/// How many tiles a comparison over so many replicates leaves open on average, if no tile's true means differ:
/// Schuirmann's test at `level`, by Student's t; `deviations` are those of single pictures.
double expected_open(std::span<const double> deviations, int replicates, double tolerance, double level);

/// RenderJob's samples with which the comparison holds with a chance of 0.9, within the bounds wanted. Half of the
/// tiles that need not hold are kept for true differences, and for what a pilot does not see. Variance counts as
/// falling with the samples' number, which low-discrepancy samples better.
int samples_for_tiles(const Witness &witness, const RenderJob &job, const TilesWanted &wanted,
                      const RenderOptions &options);

} // namespace threefold
