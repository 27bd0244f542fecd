// SPDX-License-Identifier: MIT
#include "verifier/studies/trade_choice.h"

#include <algorithm>
#include <cmath>

namespace threefold {

namespace {

constexpr double share_of_tolerance = 0.8;

} // namespace

std::vector<Candidate> candidates_for(const RendererModel &model, double tolerance,
                                      const std::function<int(double)> &round_up) {
    const double goal2 = tolerance * tolerance * share_of_tolerance;
    std::vector<Candidate> all;
    for (const SystemModel &system : model.systems) {
        const double room = goal2 - system.bias2;
        if (!(room > 0)) continue;
        const double samples = model.noise.samples(room / std::max(system.variance_ratio, 1e-12));
        if (!(samples < 1e7)) continue;
        Candidate c;
        c.setting = system.setting;
        c.setting.samples = round_up(samples);
        c.bias2 = system.bias2;
        c.predicted = std::sqrt(system.bias2 + system.variance_ratio * model.noise.variance(c.setting.samples));
        c.own_s = system.own_s_per_sample * c.setting.samples;
        c.process_s = c.own_s + system.start_s;
        all.push_back(c);
    }
    std::ranges::stable_sort(all, {}, &Candidate::process_s);
    return all;
}

std::optional<Candidate> with_more_samples(const Candidate &candidate, const ErrorSplit &measured, double tolerance,
                                           double rate, const std::function<int(double)> &round_up) {
    // A bias that is not told from zero may be chance, where pixels share their noise: then the sweep's word stands, and
    // the rest of the error counts as noise.
    const double bias2 = measured.bias2.seen() ? measured.bias2.value
                                               : std::clamp(measured.bias2.value, 0.0, candidate.bias2);
    const double room = tolerance * tolerance * share_of_tolerance - bias2;
    if (!(room > 0)) return std::nullopt;
    const double noise2 = std::max(measured.mse.value - bias2, measured.variance.value);
    const double factor = std::clamp(std::pow(noise2 / room, 1 / rate), 1.2, 64.0);
    Candidate more = candidate;
    more.setting.samples = std::max(round_up(candidate.setting.samples * factor), candidate.setting.samples + 1);
    const double longer = static_cast<double>(more.setting.samples) / candidate.setting.samples;
    more.process_s += candidate.own_s * (longer - 1);
    more.own_s *= longer;
    more.predicted = std::sqrt(bias2 + noise2 * std::pow(longer, -rate));
    return more;
}

} // namespace threefold
