// SPDX-License-Identifier: MIT
#include "verifier/tolerance/tolerance.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scenes/error.h"
#include "scenes/validate.h"
#include "verifier/measure/radiance.h"
#include "verifier/tolerance/reference.h"
#include "verifier/tracer/sampler.h"

namespace threefold {

namespace {

constexpr int halves = 2, most_attempts = 5;
/// Of the square of the tolerance: the rest is for what a pilot does not know.
constexpr double share_of_tolerance = 0.8;

std::vector<std::uint64_t> seeds_of(std::uint64_t seed, std::uint64_t stage) {
    std::vector<std::uint64_t> seeds;
    for (std::uint64_t k = 0; k < halves; ++k) seeds.push_back(tracer::mix(tracer::mix(seed + 97 * stage) + k));
    return seeds;
}

class Search {
public:
    Search(const Witness &witness, const Scene &scene, const ToleranceRequest &request)
        : witness_(witness), scene_(scene), request_(request), greatest_(greatest_radiance(scene)) {}

    WithinTolerance run() {
        const double goal2 = request_.tolerance * request_.tolerance * share_of_tolerance;
        say(0, "pilot");
        std::vector<Setting> systems = systems_of(witness_, scene_);
        if (witness_.is_tracer()) {
            // The mean radiance alone is asked here.
            Setting rough = systems.front();
            rough.samples = 1;
            const Rendered first = take(rough, 90);
            mean_ = mean_radiance(mean(first.images));
            require_light();
            Setting only = systems.back();
            if (systems.size() > 1)
                only.cut_weight = std::clamp(0.3 * request_.tolerance * mean_ / std::max(greatest_, mean_), 1e-12, 1e-2);
            systems = {only};
        } else {
            say(0.02, "reference");
            reference_ = make_reference(scene_, {.error = request_.tolerance / 4,
                                                 .seed = tracer::mix(request_.seed ^ 0x5eedu),
                                                 .threads = request_.threads,
                                                 .on_progress = {}});
            cpu_ += reference_->cpu_seconds;
            mean_ = reference_->mean_radiance;
        }
        std::size_t system = choose_system(systems, goal2);
        Setting setting = systems[system];
        setting.samples = round_up_samples(witness_, law_.samples(halves * std::max(goal2 - bias2_, goal2 / 8)));
        WithinTolerance best;
        for (std::uint64_t attempt = 0; attempt < most_attempts; ++attempt) {
            say(0.3, describe(setting, witness_, scene_));
            WithinTolerance now = attempt_with(setting, attempt);
            const bool better = attempt == 0 || now.error < best.error;
            const double noise2 = now.noise * now.noise, systematic2 = now.systematic * now.systematic;
            if (better) best = std::move(now);
            if (best.met) break;
            if (systematic2 > goal2 && noise2 < goal2) {
                if (++system >= systems.size()) break; // no setting of this renderer is nearer to the truth
                setting = {systems[system]};
                setting.samples = std::max(setting.samples, best.setting.samples);
                continue;
            }
            const double room = std::max(goal2 - systematic2, goal2 / 8);
            setting.samples = round_up_samples(
                witness_, setting.samples * std::clamp(std::pow(noise2 / room, 1 / law_.rate), 1.3, 64.0));
        }
        best.cpu_seconds = cpu_;
        return best;
    }

private:
    void say(double share, const std::string &now) const {
        if (request_.on_progress) request_.on_progress(share, now);
    }

    void require_light() const {
        if (!(mean_ > 0))
            throw Error(Exit::bad_data, "the picture is black: an error relative to its mean radiance has no meaning");
    }

    Rendered take(const Setting &setting, std::uint64_t stage) {
        RenderOptions options;
        options.folder = request_.folder;
        options.label = request_.label;
        options.time_limit = request_.time_limit;
        options.tracer = setting.tracer;
        Rendered r =
            render(witness_, job_of(setting, scene_, seeds_of(request_.seed, stage), request_.threads), options);
        cpu_ += r.record.cpu_seconds;
        return r;
    }

    /// The coarsest system whose systematic error leaves room for noise; the law of the noise on the way. That error is
    /// read from the step to the next finer system with the same seeds: most of it goes in one step, and noise, which
    /// hides it from a comparison with the reference in so few samples, goes out.
    std::size_t choose_system(const std::vector<Setting> &systems, double goal2) {
        const int few = pilot_samples(witness_);
        std::vector<NoisePoint> points;
        const auto pilot = [&](std::size_t system) {
            Setting setting = systems[system];
            setting.samples = round_up_samples(witness_, few);
            return take(setting, 100).images;
        };
        std::vector<Image> coarse = pilot(0);
        points.push_back({double(round_up_samples(witness_, few)), halves * noise2_of_mean(coarse, mean_)});
        std::size_t chosen = 0;
        for (; chosen + 1 < systems.size(); ++chosen) {
            std::vector<Image> fine = pilot(chosen + 1);
            bias2_ = std::max(0.0, paired_bias2(coarse, fine, mean_).value);
            if (bias2_ <= goal2 / 2) break;
            coarse = std::move(fine);
            bias2_ = 0; // of the last nothing is known
        }
        Setting more = systems[chosen];
        more.samples = round_up_samples(witness_, 4 * few);
        points.push_back({double(more.samples), halves * noise2_of_mean(take(more, 200).images, mean_)});
        law_ = fit_noise_law(points);
        return chosen;
    }

    WithinTolerance attempt_with(const Setting &setting, std::uint64_t attempt) {
        WithinTolerance out;
        out.setting = setting;
        out.rendered = take(setting, attempt);
        std::vector<Image> &pictures = out.rendered.images;
        const double noise2 = noise2_of_mean(pictures, mean_);
        out.noise = std::sqrt(noise2);
        if (reference_) {
            const Square error2 = error2_of_mean(pictures, *reference_);
            out.error = error2.root();
            out.systematic = std::sqrt(std::max(0.0, error2.value - noise2));
            out.reference = reference_->kind;
        } else {
            out.systematic = out.rendered.record.missing_weight_greatest.value_or(0) * greatest_ / mean_;
            out.systematic_is_bound = true;
            out.error = std::hypot(out.noise, out.systematic);
        }
        out.met = out.error <= request_.tolerance;
        out.description = fmt::format("{} pictures of {}", halves, describe(setting, witness_, scene_));
        pictures = {mean(pictures)};
        return out;
    }

    const Witness &witness_;
    const Scene &scene_;
    const ToleranceRequest &request_;
    double greatest_, mean_ = 0, bias2_ = 0, cpu_ = 0;
    NoiseLaw law_;
    std::optional<ReferencePicture> reference_;
};

} // namespace

int pilot_samples(const Witness &witness) { return witness.is_tracer() ? 4 : 2; }

WithinTolerance render_within(const Witness &witness, const Scene &scene, const ToleranceRequest &request) {
    if (!(request.tolerance > 0 && request.tolerance < 1))
        throw Error(Exit::usage, fmt::format("a tolerance lies between 0 and 1, not {:g}", request.tolerance));
    return Search(witness, scene, request).run();
}

int samples_for_noise(const Witness &witness, const RenderJob &job, const NoiseWanted &wanted,
                      const RenderOptions &options) {
    RenderOptions quiet = options;
    quiet.on_progress = nullptr; // the share is that of the picture to come
    quiet.label += "-pilot";
    const NoisePilot pilot = pilot_noise(witness, job, pilot_samples(witness), quiet);
    if (!(pilot.mean_radiance > 0)) return std::max(job.samples_per_pixel, wanted.least_samples); // black: no noise
    const double noise = std::min(wanted.relative, wanted.absolute / pilot.mean_radiance);
    const double variance = noise * noise * static_cast<double>(job.replicates.size()) * share_of_tolerance;
    RenderJob trial = job;
    trial.samples_per_pixel = std::max(round_up_samples(witness, pilot.law.samples(variance)), wanted.least_samples);
    // Between the pilots' numbers a sequence may be less even than the law says: seen once before it is used.
    for (std::uint64_t stage = 0; stage < 2 && trial.samples_per_pixel > wanted.least_samples; ++stage) {
        trial.replicates.clear();
        for (const std::uint64_t s : seeds_of(job.replicates.front().seed, 400 + stage))
            trial.replicates.push_back({s, {0, 0}});
        const double seen = halves * noise2_of_mean(render(witness, trial, quiet).images, pilot.mean_radiance);
        if (seen <= variance / share_of_tolerance * 0.9) break;
        trial.samples_per_pixel = round_up_samples(
            witness, trial.samples_per_pixel * std::max(1.1, std::pow(seen / variance, 1 / pilot.law.rate)));
    }
    return trial.samples_per_pixel;
}

NoisePilot pilot_noise(const Witness &witness, RenderJob job, int few_samples, const RenderOptions &options) {
    NoisePilot pilot;
    std::vector<NoisePoint> points;
    const std::uint64_t seed = job.replicates.empty() ? 1 : job.replicates.front().seed;
    for (const int factor : {1, 4}) {
        job.samples_per_pixel = round_up_samples(witness, few_samples * factor);
        job.replicates.clear();
        for (const std::uint64_t s : seeds_of(seed, 300 + static_cast<std::uint64_t>(factor)))
            job.replicates.push_back({s, {0, 0}});
        const Rendered r = render(witness, job, options);
        pilot.cpu_seconds += r.record.cpu_seconds;
        pilot.mean_radiance = mean_radiance(mean(r.images));
        if (!(pilot.mean_radiance > 0)) return pilot;
        points.push_back(
            {double(job.samples_per_pixel), halves * noise2_of_mean(r.images, pilot.mean_radiance)});
    }
    pilot.law = fit_noise_law(points);
    return pilot;
}

} // namespace threefold
