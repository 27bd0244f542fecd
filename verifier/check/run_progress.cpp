// SPDX-License-Identifier: MIT
#include "verifier/check/run_progress.h"

#include <algorithm>

namespace threefold {

void RunProgress::expect(const std::string &renderer, double work) {
    const std::lock_guard lock(mutex_);
    renderers_[renderer].expected += work;
}

std::function<void(double share)> RunProgress::of_render(const std::string &renderer, const std::string &experiment,
                                                         const std::string &key, double work) {
    return [this, renderer, experiment, key, work](double share) {
        const std::lock_guard lock(mutex_);
        renderers_[renderer].at_work[key] = work * std::clamp(share, 0.0, 1.0);
        report(renderer, experiment);
    };
}

void RunProgress::finish(const std::string &renderer, const std::string &experiment, const std::string &key,
                         double work) {
    const std::lock_guard lock(mutex_);
    Renderer &r = renderers_[renderer];
    r.at_work.erase(key);
    r.finished += work;
    report(renderer, experiment);
}

void RunProgress::report(const std::string &renderer, const std::string &experiment) {
    if (!on_progress_) return;
    const Renderer &r = renderers_[renderer];
    double done = r.finished;
    for (const auto &[name, work] : r.at_work) done += work;
    on_progress_(renderer, r.expected > 0 ? std::min(1.0, done / r.expected) : 1, experiment);
}

} // namespace threefold
