// SPDX-License-Identifier: MIT
#include "verifier/tolerance/tolerance.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scenes/error.h"
#include "scenes/validate.h"
#include "verifier/measure/radiance.h"
#include "verifier/tolerance/error_bound.h"
#include "verifier/tolerance/reference.h"
#include "verifier/tracer/sampler.h"

namespace threefold {

namespace {

constexpr int halves = 2; ///< of a pilot that only asks for the law of the noise
constexpr std::uint64_t most_attempts = 5;
/// Any of the attempts may be the one whose error is understated: their chances add up to 5 %.
constexpr double significance = 0.05 / most_attempts;
/// Few pixels tell little of their own noise: more parts do, and cost nothing there.
constexpr std::size_t few_pixels = 400;
constexpr std::uint64_t parts_of_few = 8;
/// Of each of these parts: what is narrower than a pixel's samples is not seen in their spread.
constexpr int least_samples_of_few = 16;
/// Of the square of the tolerance: the rest is for what a pilot does not know.
constexpr double share_of_tolerance = 0.8;

std::vector<std::uint64_t> seeds_of(std::uint64_t seed, std::uint64_t stage, std::uint64_t count = halves) {
    std::vector<std::uint64_t> seeds;
    for (std::uint64_t k = 0; k < count; ++k) seeds.push_back(tracer::mix(tracer::mix(seed + 97 * stage) + k));
    return seeds;
}

class Search {
public:
    Search(const Witness &witness, const Scene &scene, const ToleranceRequest &request)
        : witness_(witness), scene_(scene), request_(request), greatest_(greatest_radiance(scene)),
          few_pixels_(static_cast<std::size_t>(scene.camera.image_width_px()) *
                          static_cast<std::size_t>(scene.camera.image_height_px()) <
                      few_pixels),
          parts_(few_pixels_ ? parts_of_few : halves) {}

    WithinTolerance run() {
        const double tolerance2 = request_.tolerance * request_.tolerance;
        say(0, "pilot");
        std::vector<Setting> systems = systems_of(witness_, scene_);
        if (witness_.is_tracer()) {
            // The mean radiance alone is asked here, roughly: each picture tells it better.
            Setting rough = systems.front();
            rough.samples = 1;
            const Rendered first = take(rough, 90);
            mean_ = mean_radiance(mean(first.images));
            require_light();
            Setting only = systems.back();
            if (systems.size() > 1)
                only.cut_weight =
                    std::clamp(0.2 * request_.tolerance * mean_ / std::max(greatest_, mean_), 1e-12, 1e-2);
            systems = {only};
        } else {
            say(0.02, "reference");
            reference_ = make_reference(scene_, {.error = request_.tolerance / (few_pixels_ ? 16 : 4),
                                                 .seed = tracer::mix(request_.seed ^ 0x5eedu),
                                                 .threads = request_.threads,
                                                 .pictures = few_pixels_ ? 8 : 4,
                                                 .on_progress = {}});
            cpu_ += reference_->cpu_seconds;
            mean_ = reference_->mean_radiance;
        }
        std::size_t system = choose_system(systems, tolerance2 * share_of_tolerance);
        Setting setting = systems[system];
        const double parts = static_cast<double>(parts_);
        // What of the square the picture's noise may have: less where few pixels carry it, who may err further.
        const auto room = [&](double systematic2) {
            const double goal2 = tolerance2 * share_of_tolerance;
            return std::max(goal2 - systematic2, goal2 / 8) / widening_;
        };
        setting.samples = samples_of(law_.samples(parts * room(bias2_)));
        WithinTolerance best;
        for (std::uint64_t attempt = 0; attempt < most_attempts; ++attempt) {
            say(0.3, describe(setting, witness_, scene_));
            WithinTolerance now = attempt_with(setting, attempt);
            const bool better = attempt == 0 || now.error_upper < best.error_upper;
            const double noise2 = now.noise * now.noise, systematic2 = now.systematic * now.systematic;
            if (better) best = std::move(now);
            if (best.met) break;
            if (systematic2 > tolerance2 * share_of_tolerance && noise2 < tolerance2 * share_of_tolerance) {
                if (++system >= systems.size()) break; // no setting of this renderer is nearer to the truth
                setting = {systems[system]};
                setting.samples = std::max(setting.samples, best.setting.samples);
                continue;
            }
            setting.samples = samples_of(setting.samples *
                                         std::clamp(std::pow(noise2 / room(systematic2), 1 / law_.rate), 1.3, 64.0));
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

    int samples_of(double samples) const {
        return round_up_samples(witness_, std::max<double>(samples, few_pixels_ ? least_samples_of_few : 1));
    }

    Rendered take(const Setting &setting, std::uint64_t stage) {
        RenderOptions options;
        options.folder = request_.folder;
        options.label = request_.label;
        options.time_limit = request_.time_limit;
        options.tracer = setting.tracer;
        Rendered r = render(witness_, job_of(setting, scene_, seeds_of(request_.seed, stage, parts_), request_.threads),
                            options);
        cpu_ += r.record.cpu_seconds;
        return r;
    }

    /// One point of the law: of the relative variance of one part.
    NoisePoint point_of(const Setting &setting, const std::vector<Image> &pictures) {
        const PartsNoise noise = noise_of_parts(pictures, mean(pictures), mean_);
        widening_ = std::max(1.0, noise.widening(significance));
        return {double(setting.samples), static_cast<double>(parts_) * noise.square};
    }

    /// The coarsest system whose systematic error leaves room for noise; the law of the noise on the way. That error is
    /// read from the step to the next finer system with the same seeds: most of it goes in one step, and noise, which
    /// hides it from a comparison with the reference in so few samples, goes out.
    std::size_t choose_system(const std::vector<Setting> &systems, double goal2) {
        const int few = pilot_samples(witness_);
        std::vector<NoisePoint> points;
        const auto pilot_of = [&](std::size_t system, int samples) {
            Setting setting = systems[system];
            setting.samples = round_up_samples(witness_, samples);
            return setting;
        };
        std::vector<Image> coarse = take(pilot_of(0, few), 100).images;
        points.push_back(point_of(pilot_of(0, few), coarse));
        std::size_t chosen = 0;
        for (; chosen + 1 < systems.size(); ++chosen) {
            std::vector<Image> fine = take(pilot_of(chosen + 1, few), 100).images;
            bias2_ = std::max(0.0, paired_bias2(coarse, fine, mean_).value);
            if (bias2_ <= goal2 / 2) break;
            coarse = std::move(fine);
            bias2_ = 0; // of the last nothing is known
        }
        const Setting more = pilot_of(chosen, 4 * few);
        points.push_back(point_of(more, take(more, 200).images));
        // Two estimates from few pixels may make any slope: independent samples are the worst that is known then.
        if (few_pixels_) points.erase(points.begin());
        law_ = fit_noise_law(points);
        return chosen;
    }

    WithinTolerance attempt_with(const Setting &setting, std::uint64_t attempt) {
        WithinTolerance out;
        out.setting = setting;
        out.rendered = take(setting, attempt);
        std::vector<Image> &pictures = out.rendered.images;
        Image middle = mean(pictures);
        if (!reference_) {
            mean_ = mean_radiance(middle);
            require_light();
        }
        const PartsNoise noise = noise_of_parts(pictures, middle, mean_);
        out.noise = std::sqrt(noise.square);
        widening_ = std::max(1.0, noise.widening(significance));
        if (reference_) {
            const Square error2 = error2_of_mean({&middle, 1}, *reference_);
            out.error = error2.root();
            out.error_upper = std::sqrt(error2_upper(middle, *reference_, significance));
            out.systematic = std::sqrt(std::max(0.0, error2.value - noise.square));
            out.reference = reference_->kind;
        } else {
            out.systematic = out.rendered.record.missing_weight_greatest.value_or(0) * greatest_ / mean_;
            out.systematic_is_bound = true;
            out.error = std::hypot(out.noise, out.systematic);
            out.error_upper = std::sqrt(noise.upper2(out.systematic, significance));
        }
        out.met = out.error_upper <= request_.tolerance;
        out.description = fmt::format("{} pictures of {}", parts_, describe(setting, witness_, scene_));
        pictures = {std::move(middle)};
        return out;
    }

    const Witness &witness_;
    const Scene &scene_;
    const ToleranceRequest &request_;
    double greatest_, mean_ = 0, bias2_ = 0, cpu_ = 0;
    bool few_pixels_;
    std::uint64_t parts_;
    double widening_ = 1; ///< of the square of the noise, to its bound
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
        points.push_back({double(job.samples_per_pixel), halves * noise2_of_mean(r.images, pilot.mean_radiance)});
    }
    pilot.law = fit_noise_law(points);
    return pilot;
}

} // namespace threefold
