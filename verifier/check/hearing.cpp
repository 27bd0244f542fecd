// SPDX-License-Identifier: MIT
#include "verifier/check/hearing.h"

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
                if (q.noise) q.job.samples_per_pixel = samples_for_noise(*q.witness, q.job, *q.noise, q.options);
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
