// SPDX-License-Identifier: MIT
#include "verifier/studies/trade_choice.h"

#include <algorithm>
#include <cmath>

namespace threefold {

namespace {

constexpr double share_of_tolerance = 0.8;

double bias2_of(const Candidate &candidate, const ErrorSplit &measured) {
    return measured.bias2.seen() ? measured.bias2.value : std::clamp(measured.bias2.value, 0.0, candidate.bias2);
}

double noise2_of(const Candidate &candidate, const ErrorSplit &measured) {
    return std::max(measured.mse.value - bias2_of(candidate, measured), measured.variance.value);
}

Candidate lengthened(Candidate candidate, int samples) {
    const double longer = static_cast<double>(samples) / candidate.setting.samples;
    candidate.setting.samples = samples;
    candidate.process_s += candidate.own_s * (longer - 1);
    candidate.own_s *= longer;
    return candidate;
}

/// With what is foretold by the measured bias and noise.
Candidate lengthened(const Candidate &candidate, int samples, double bias2, double noise2, double rate) {
    Candidate other = lengthened(candidate, samples);
    const double longer = static_cast<double>(samples) / candidate.setting.samples;
    other.predicted = std::sqrt(bias2 + noise2 * std::pow(longer, -rate));
    return other;
}

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
    const double bias2 = bias2_of(candidate, measured), noise2 = noise2_of(candidate, measured);
    const double room = tolerance * tolerance * share_of_tolerance - bias2;
    if (!(room > 0)) return std::nullopt;
    const double factor = std::clamp(std::pow(noise2 / room, 1 / rate), 1.2, 64.0);
    const int samples = std::max(round_up(candidate.setting.samples * factor), candidate.setting.samples + 1);
    return lengthened(candidate, samples, bias2, noise2, rate);
}

std::optional<Candidate> with_fewer_samples(const Candidate &candidate, const ErrorSplit &measured, double tolerance,
                                            double rate, const std::function<int(double)> &round_up) {
    const double bias2 = bias2_of(candidate, measured), noise2 = noise2_of(candidate, measured);
    const double room = tolerance * tolerance * share_of_tolerance - bias2;
    if (!(room > noise2)) return std::nullopt;
    const int samples = round_up(candidate.setting.samples * std::pow(noise2 / room, 1 / rate));
    if (samples > 0.8 * candidate.setting.samples) return std::nullopt;
    return lengthened(candidate, samples, bias2, noise2, rate);
}

double noise_beyond_law(const Candidate &candidate, const ErrorSplit &measured) {
    const double foretold = candidate.predicted * candidate.predicted - candidate.bias2;
    return foretold > 0 ? std::clamp(noise2_of(candidate, measured) / foretold, 1.0, 64.0) : 1;
}

Candidate with_noise_beyond_law(const Candidate &candidate, double times, double rate,
                                const std::function<int(double)> &round_up) {
    return lengthened(candidate, round_up(candidate.setting.samples * std::pow(times, 1 / rate)));
}

} // namespace threefold
