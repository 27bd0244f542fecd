// SPDX-License-Identifier: MIT
// Renders of many experiments, side by side on the machine's cores. No renderer waits for another: as soon as one
// render ends, the next in order begins. POV-Ray sleeps for a third of a second a picture: beside a thread for each
// core, some take only its short pictures, of the group that is next. (Were they of later groups, they would delay it.)
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "verifier/tolerance/tile_noise.h"
#include "verifier/tolerance/tolerance.h"
#include "verifier/witness/witness.h"

namespace threefold {

struct RenderTask {
    std::size_t experiment; ///< the caller's number of it
    const Witness *witness;
    std::function<RenderJob()> job; ///< called on the thread that renders: a job holds a whole scene
    RenderOptions options;          ///< on_progress is called from that thread
    /// They choose the samples, by pilots with this renderer; the more of both count.
    std::optional<NoiseWanted> noise{};
    std::optional<TilesWanted> tiles{};
    /// Tasks begin by group, within a group the long ones first: whoever waits for the group waits for them.
    std::size_t group = 0;
    bool is_long = false;

    bool sleeps() const; ///< for a large share of its time
};

struct RenderAnswer {
    std::size_t experiment;
    const Witness *witness;
    std::optional<Rendered> rendered;
    std::exception_ptr failure; ///< set where there is no picture
    int samples_per_pixel = 0;  ///< that the job was rendered with
};

class RenderQueue {
public:
    /// `cores`: 0 means all; 1 means one render at a time. Each render uses one core; the last ones share what is free.
    explicit RenderQueue(int cores);
    /// Drops what has not begun and waits for what has.
    ~RenderQueue();
    RenderQueue(const RenderQueue &) = delete;
    RenderQueue &operator=(const RenderQueue &) = delete;

    void add(RenderTask task);
    /// Takes out the tasks of this renderer that have not begun; returns their experiments, one for each task.
    std::vector<std::size_t> remove(const Witness &witness);
    /// The next render to end, waiting for it. Empty when all have been returned.
    std::optional<RenderAnswer> next();

private:
    void work(bool takes_sleepers_only);
    int threads_for(const RenderTask &task) const;

    int cores_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<RenderTask> waiting_; ///< in the order in which they begin
    std::deque<RenderAnswer> ended_;
    std::size_t running_ = 0;
    bool stopping_ = false;
    std::vector<std::thread> workers_;
};

} // namespace threefold
