// SPDX-License-Identifier: MIT
#include "verifier/check/hearing.h"

#include <algorithm>
#include <future>
#include <mutex>
#include <utility>

namespace threefold {

std::vector<Answer> hear(std::vector<Question> questions, bool at_once) {
    std::mutex telling;
    std::vector<std::future<Answer>> answers;
    for (Question &q : questions) {
        if (q.options.on_progress)
            q.options.on_progress = [tell = std::move(q.options.on_progress), &telling](double share) {
                const std::lock_guard lock(telling);
                tell(share);
            };
        answers.push_back(std::async(at_once ? std::launch::async : std::launch::deferred, [&q] {
            Answer answer{q.witness, std::nullopt, nullptr, 0};
            try {
                const int for_noise = q.noise ? samples_for_noise(*q.witness, q.job, *q.noise, q.options) : 0;
                const int for_tiles = q.tiles ? samples_for_tiles(*q.witness, q.job, *q.tiles, q.options) : 0;
                if (q.noise || q.tiles) q.job.samples_per_pixel = std::max(for_noise, for_tiles);
                answer.samples_per_pixel = q.job.samples_per_pixel;
                answer.rendered = render(*q.witness, std::move(q.job), q.options);
            } catch (...) {
                answer.failure = std::current_exception();
            }
            return answer;
        }));
    }
    std::vector<Answer> all;
    for (std::future<Answer> &answer : answers) all.push_back(answer.get());
    return all;
}

} // namespace threefold
