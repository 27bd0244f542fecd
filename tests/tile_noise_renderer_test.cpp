// SPDX-License-Identifier: MIT
// A renderer that draws branches at random gets the samples with which its tiles can be told to agree.
#include <gtest/gtest.h>

#include "exporter/temporary_folder.h"
#include "tests/catalogue_scene.h"
#include "verifier/agreement/tiles.h"
#include "verifier/measure/radiance.h"
#include "verifier/tolerance/tile_noise.h"

namespace threefold {
namespace {

TEST(TileNoiseInCycles, IsMetWithTheSamplesThatDecide) {
    const Witness cycles = find_witnesses({"cycles"}).front();
    if (!cycles.present()) GTEST_SKIP() << cycles.title << " is not installed";
    const TemporaryFolder folder;
    RenderJob job;
    job.scene = catalogue_scene("hollow", {{"image.width_px", "96"}, {"image.height_px", "96"}});
    job.sampling = Sampling::pixel_centres;
    job.samples_per_pixel = 8;
    job.cut_weight = 1e-5;
    job.replicates.clear();
    for (std::uint64_t k = 1; k <= 5; ++k) job.replicates.push_back({k, {0.13 * static_cast<double>(k) - 0.4, 0}});
    const RenderOptions options{.folder = folder.path(), .label = "tiles", .tracer = {}, .on_progress = {}};
    const std::vector<Image> exact = render(find_witnesses({"tracer"}).front(), job, options).images;
    const TilesWanted wanted{8, 0.02 * mean_radiance(exact.front()), 0.97, 8, 1 << 14};
    const auto compared = [&] {
        return compare_tiles(render(cycles, job, options).images, exact, wanted.tile_px, wanted.tolerance,
                             wanted.needed_share, true);
    };
    EXPECT_EQ(compared().verdict, Verdict::undecided) << "with few samples";
    job.samples_per_pixel = samples_for_tiles(cycles, job, wanted, options);
    EXPECT_GT(job.samples_per_pixel, 16);
    EXPECT_LT(job.samples_per_pixel, wanted.most_samples);
    EXPECT_EQ(compared().verdict, Verdict::holds) << job.samples_per_pixel << " samples";
}

} // namespace
} // namespace threefold
