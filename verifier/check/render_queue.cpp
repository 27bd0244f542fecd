// SPDX-License-Identifier: MIT
#include "verifier/check/render_queue.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace threefold {

namespace {

RenderAnswer answer_to(const RenderTask &task, int threads) {
    RenderAnswer answer{task.experiment, task.witness, std::nullopt, nullptr, 0};
    try {
        RenderJob job = task.job();
        job.threads = threads;
        const int for_noise = task.noise ? samples_for_noise(*task.witness, job, *task.noise, task.options) : 0;
        const int for_tiles = task.tiles ? samples_for_tiles(*task.witness, job, *task.tiles, task.options) : 0;
        if (task.noise || task.tiles) job.samples_per_pixel = std::max(for_noise, for_tiles);
        answer.samples_per_pixel = job.samples_per_pixel;
        answer.rendered = render(*task.witness, std::move(job), task.options);
    } catch (...) {
        answer.failure = std::current_exception();
    }
    return answer;
}

bool sleeps_between_pictures(const Witness &w) { return w.adapter && w.adapter->sleeps_between_pictures; }

/// What begins first.
auto order_of(const RenderTask &task) { return std::tuple(task.group, !task.is_long, task.experiment); }

int all_cores() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

} // namespace

bool RenderTask::sleeps() const { return sleeps_between_pictures(*witness) && !is_long; }

RenderQueue::RenderQueue(int cores) : cores_(cores > 0 ? cores : all_cores()) {
    for (int i = 0; i < cores_; ++i) workers_.emplace_back([this] { work(false); });
    if (cores_ == 1) return; // one render at a time
    for (int i = 0; i < cores_; ++i) workers_.emplace_back([this] { work(true); });
}

RenderQueue::~RenderQueue() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        waiting_.clear();
    }
    changed_.notify_all();
    for (std::thread &worker : workers_) worker.join();
}

void RenderQueue::add(RenderTask task) {
    {
        const std::lock_guard lock(mutex_);
        const auto after = std::ranges::upper_bound(waiting_, order_of(task), {}, order_of);
        waiting_.insert(after, std::move(task));
    }
    changed_.notify_all();
}

std::vector<std::size_t> RenderQueue::remove(const Witness &witness) {
    const std::lock_guard lock(mutex_);
    std::vector<std::size_t> experiments;
    for (const RenderTask &task : waiting_)
        if (task.witness == &witness) experiments.push_back(task.experiment);
    std::erase_if(waiting_, [&](const RenderTask &task) { return task.witness == &witness; });
    return experiments;
}

std::optional<RenderAnswer> RenderQueue::next() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !ended_.empty() || (waiting_.empty() && running_ == 0); });
    if (ended_.empty()) return std::nullopt;
    RenderAnswer answer = std::move(ended_.front());
    ended_.pop_front();
    return answer;
}

/// One core each while there is more to do than cores; the last renders take all, and the system shares them out. So
/// do long ones that render their pictures one after the other: a whole group waits for them.
int RenderQueue::threads_for(const RenderTask &task) const {
    const bool last = waiting_.size() + running_ < static_cast<std::size_t>(2 * cores_);
    return last || (task.is_long && sleeps_between_pictures(*task.witness)) ? cores_ : 1;
}

void RenderQueue::work(bool takes_sleepers_only) {
    Sessions sessions;
    std::unique_lock lock(mutex_);
    auto next = waiting_.end();
    const auto find_next = [&] {
        next = std::ranges::find_if(waiting_, [&](const RenderTask &task) {
            return !takes_sleepers_only || (task.sleeps() && task.group == waiting_.front().group);
        });
        return next != waiting_.end();
    };
    while (true) {
        changed_.wait(lock, [&] { return stopping_ || find_next(); });
        if (stopping_) return;
        const int threads = threads_for(*next);
        RenderTask task = std::move(*next);
        waiting_.erase(next);
        task.options.sessions = &sessions;
        ++running_;
        lock.unlock();
        RenderAnswer answer = answer_to(task, threads);
        lock.lock();
        --running_;
        ended_.push_back(std::move(answer));
        changed_.notify_all();
    }
}

} // namespace threefold
