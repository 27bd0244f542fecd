// SPDX-License-Identifier: MIT
// How far each renderer is, while several of its renders are at work.
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <string>

namespace threefold {

/// Called with the share of all that a renderer has to do, and the experiment that moved last; by one thread at a time.
using OnProgress = std::function<void(const std::string &renderer, double share, const std::string &experiment)>;

class RunProgress {
public:
    explicit RunProgress(const OnProgress &on_progress) : on_progress_(on_progress) {}

    /// Work to come, in seconds or so; only its proportions matter.
    void expect(const std::string &renderer, double work);
    /// A function for a render's own share, to be called from any thread. `key` tells apart what is at work at once.
    std::function<void(double share)> of_render(const std::string &renderer, const std::string &experiment,
                                                const std::string &key, double work);
    /// The render has ended, whatever came of it.
    void finish(const std::string &renderer, const std::string &experiment, const std::string &key, double work);

private:
    struct Renderer {
        double expected = 0, finished = 0;
        std::map<std::string, double> at_work; ///< done so far, by key
    };

    void report(const std::string &renderer, const std::string &experiment);

    const OnProgress &on_progress_;
    std::mutex mutex_;
    std::map<std::string, Renderer> renderers_;
};

} // namespace threefold
