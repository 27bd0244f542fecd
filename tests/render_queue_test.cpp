// SPDX-License-Identifier: MIT
// Renders side by side: in order, each once, and none lost.
#include "verifier/check/render_queue.h"

#include <algorithm>
#include <atomic>
#include <set>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/catalogue_scene.h"
#include "tests/temporary_folder.h"
#include "verifier/check/look.h"
#include "verifier/check/run_progress.h"

namespace threefold {
namespace {

using testing::ElementsAre;

class Queue : public testing::Test {
protected:
    RenderJob job(std::uint64_t seed) const {
        RenderJob j;
        j.scene = scene_;
        j.samples_per_pixel = 1;
        j.replicates = {{seed, {0, 0}}};
        return j;
    }

    RenderTask task(std::size_t experiment, std::function<void(int threads)> on_start = {}) {
        return {.experiment = experiment,
                .witness = &tracer_,
                .job =
                    [this, experiment, on_start] {
                        if (on_start) on_start(0);
                        return job(experiment);
                    },
                .options = {folder_.path(), "test", {}, std::chrono::minutes(1), {}}};
    }

    const tests::TemporaryFolder folder_;
    const Witness tracer_ = find_witnesses({"tracer"}).front();
    const Scene scene_ = catalogue_scene("hollow", {{"image.width_px", "8"}, {"image.height_px", "8"}});
};

TEST_F(Queue, BeginsWithTheLowestExperimentAndReturnsEachOnce) {
    std::vector<std::size_t> begun;
    RenderQueue queue(1);
    std::atomic<bool> open = false;
    // The first render waits until all others are in the queue.
    queue.add(task(5, [&](int) {
        while (!open) std::this_thread::yield();
    }));
    for (const std::size_t number : {9u, 2u, 7u, 2u})
        queue.add(task(number, [&begun, number](int) { begun.push_back(number); }));
    open = true;
    std::multiset<std::size_t> ended;
    while (const auto answer = queue.next()) {
        EXPECT_TRUE(answer->rendered);
        ended.insert(answer->experiment);
    }
    EXPECT_THAT(begun, ElementsAre(2, 2, 7, 9));
    EXPECT_THAT(ended, ElementsAre(2, 2, 5, 7, 9));
    EXPECT_FALSE(queue.next());
}

TEST_F(Queue, BeginsByGroupAndThenWithTheLongOnes) {
    std::vector<std::size_t> begun;
    RenderQueue queue(1);
    std::atomic<bool> open = false;
    queue.add(task(0, [&](int) {
        while (!open) std::this_thread::yield();
    }));
    const auto add = [&](std::size_t number, std::size_t group, bool is_long) {
        RenderTask t = task(number, [&begun, number](int) { begun.push_back(number); });
        t.group = group;
        t.is_long = is_long;
        queue.add(std::move(t));
    };
    add(4, 2, true);
    add(1, 1, false);
    add(2, 1, true);
    add(3, 1, true);
    open = true;
    while (queue.next()) continue;
    EXPECT_THAT(begun, ElementsAre(2, 3, 1, 4));
}

TEST_F(Queue, HasMoreRendersThanCoresOnlyWhereTheySleep) {
    Adapter sleepy{};
    sleepy.sleeps_between_pictures = true;
    Witness rests = tracer_;
    rests.adapter = &sleepy;
    const auto most_at_work = [&](const Witness &w, bool is_long) {
        std::atomic<int> at_work = 0, most = 0;
        RenderQueue queue(2);
        for (std::size_t i = 0; i < 12; ++i) {
            RenderTask t = task(i);
            t.witness = &w;
            t.is_long = is_long;
            t.job = [&]() -> RenderJob {
                const int now = ++at_work;
                for (int before = most; before < now && !most.compare_exchange_weak(before, now);) continue;
                std::this_thread::sleep_for(std::chrono::milliseconds(30));
                --at_work;
                throw std::runtime_error("no scene");
            };
            queue.add(std::move(t));
        }
        while (queue.next()) continue;
        return most.load();
    };
    EXPECT_EQ(most_at_work(tracer_, false), 2);
    EXPECT_EQ(most_at_work(rests, true), 2);
    EXPECT_EQ(most_at_work(rests, false), 4);
}

TEST_F(Queue, TakesMoreWhileItIsEmptiedAndKeepsWorkingAfterAFailure) {
    RenderQueue queue(2);
    queue.add(task(1, [](int) { throw std::runtime_error("no scene"); }));
    const auto failed = queue.next();
    ASSERT_TRUE(failed);
    EXPECT_FALSE(failed->rendered);
    EXPECT_THROW(std::rethrow_exception(failed->failure), std::runtime_error);
    queue.add(task(2));
    const auto good = queue.next();
    ASSERT_TRUE(good);
    EXPECT_TRUE(good->rendered);
}

TEST_F(Queue, GivesBackWhatHasNotBegunOfARendererThatFailed) {
    std::atomic<bool> begun = false, open = false;
    RenderQueue queue(1);
    queue.add(task(1, [&](int) {
        begun = true;
        while (!open) std::this_thread::yield();
    }));
    while (!begun) std::this_thread::yield();
    queue.add(task(4));
    queue.add(task(3));
    const Witness another = tracer_;
    EXPECT_TRUE(queue.remove(another).empty());
    EXPECT_THAT(queue.remove(tracer_), ElementsAre(3, 4));
    open = true;
    EXPECT_EQ(queue.next()->experiment, 1u);
    EXPECT_FALSE(queue.next());
}

TEST_F(Queue, RendersTheSamePictureOnceThoughTwoAskForItAtTheSameTime) {
    RenderQueue queue(4);
    for (int i = 0; i < 6; ++i) queue.add(task(1));
    int rendered = 0;
    std::vector<Image> images;
    while (const auto answer = queue.next()) {
        ASSERT_TRUE(answer->rendered);
        rendered += !answer->rendered->record.from_cache;
        images.push_back(answer->rendered->images.front());
    }
    EXPECT_EQ(rendered, 1);
    ASSERT_EQ(images.size(), 6u);
    for (const Image &image : images) EXPECT_EQ(image.pixels, images.front().pixels);
}

TEST_F(Queue, DropsWhatHasNotBegunWhenItGoes) {
    std::atomic<int> begun = 0;
    {
        RenderQueue queue(1);
        for (std::size_t i = 0; i < 50; ++i) queue.add(task(i, [&](int) { ++begun; }));
    }
    EXPECT_LT(begun, 50);
}

TEST(LookAtAnExperiment, BeginsWithFewReplicatesUnlessAPairOrAShareOfTilesNeedsAll) {
    const Witness tracer = find_witnesses({"tracer"}).front();
    Experiment usual;
    usual.name = "usual";
    usual.replicates = 8;
    Experiment one = usual, pair = usual, tiles = usual;
    one.replicates = 1;
    pair.name = "pair", pair.partner = "partner";
    Experiment partner = usual;
    partner.name = "partner";
    tiles.tile_budget = [](const Accuracy &, const Accuracy &) { return std::vector<BudgetItem>{{"all", 1, ""}}; };
    tiles.tiles_needed_share = 0.99;
    Experiment paired_tiles = tiles;
    paired_tiles.tiles_needed_share = 1, paired_tiles.shift_replicates = true;
    const std::vector all{usual, one, pair, partner, tiles, paired_tiles};
    EXPECT_EQ(first_replicates(tracer, usual, all), 4);
    EXPECT_EQ(first_replicates(tracer, one, all), 1);
    EXPECT_EQ(first_replicates(tracer, pair, all), 8);
    EXPECT_EQ(first_replicates(tracer, partner, all), 8);
    EXPECT_EQ(first_replicates(tracer, tiles, all), 8);
    EXPECT_EQ(first_replicates(tracer, paired_tiles, all), 8) << "as many as the renderer beside it";
}

TEST(LookAtAnExperiment, TakesTheReplicatesThatALongerOneWouldHave) {
    Experiment e;
    e.scene = catalogue_scene("hollow");
    e.replicates = 4;
    e.shift_replicates = true;
    const RenderJob all = Look{&e, 0, 9, 7, nullptr, {}}.job(), first = Look{&e, 0, 4, 7, nullptr, {}}.job(),
                    more = Look{&e, 4, 9, 7, nullptr, {}}.job();
    ASSERT_EQ(first.replicates.size(), 4u);
    ASSERT_EQ(more.replicates.size(), 5u);
    for (std::size_t k = 0; k < 9; ++k) {
        const Replicate &part = k < 4 ? first.replicates[k] : more.replicates[k - 4];
        EXPECT_EQ(part.seed, all.replicates[k].seed);
        EXPECT_EQ(part.film_offset_px, all.replicates[k].film_offset_px);
    }
}

TEST(ProgressOfARun, IsTheShareOfAllARendererHasToDoWithSeveralRendersAtWork) {
    std::vector<double> shares;
    const OnProgress on_progress = [&](const std::string &renderer, double share, const std::string &) {
        EXPECT_EQ(renderer, "cycles");
        shares.push_back(share);
    };
    RunProgress progress(on_progress);
    progress.expect("cycles", 4);
    progress.expect("cycles", 6);
    const auto a = progress.of_render("cycles", "a", "1/a", 4), b = progress.of_render("cycles", "b", "1/b", 6);
    a(0.5);
    b(0.5);
    progress.finish("cycles", "a", "1/a", 4);
    progress.finish("cycles", "b", "1/b", 6);
    EXPECT_THAT(shares, ElementsAre(0.2, 0.5, 0.7, 1));
}

} // namespace
} // namespace threefold
