// SPDX-License-Identifier: MIT
// Error against CPU seconds of our tracer on a scene file of Mitsuba's, setting by setting:
//   threefold_referee SCENE.xml [SIZE_PX [REFERENCE.exr]]
// The error is the root mean square over all pixels and channels, against the reference picture if one is given and
// otherwise against our own of many samples and another seed, whose error is told. One thread; the settings are taken
// in turn three times and each one's median is told: set-up and rendering apart.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "exporter/file_reader.h"
#include "exporter/image/image_io.h"
#include "exporter/mitsuba/read_mitsuba.h"
#include "scenes/error.h"
#include "scenes/validate.h"
#include "verifier/tracer/tracer.h"

namespace threefold {
namespace {

struct Setting {
    const char *name;
    int samples;
    double cut_weight;
    TracerSettings tracer{};
};

constexpr TracerSettings roulette{Precision::double_precision, Transport::roulette};
constexpr TracerSettings single{Precision::single_precision};
constexpr TracerSettings by_sampler(Sampler sampler) {
    TracerSettings settings;
    settings.sampler = sampler;
    return settings;
}

const std::array settings{
    Setting{"tree, cut 0.03", 8, 0.03},
    Setting{"tree, cut 0.03", 12, 0.03},
    Setting{"tree, cut 0.03", 16, 0.03},
    Setting{"tree, cut 0.03", 64, 0.03},
    Setting{"tree, cut 0.003", 16, 0.003},
    Setting{"tree, cut 0.003", 64, 0.003},
    Setting{"roulette", 16, 0.03, roulette},
    Setting{"roulette", 64, 0.03, roulette},
    Setting{"stratified, cut 0.03", 16, 0.03, by_sampler(Sampler::stratified)},
    Setting{"stratified, cut 0.03", 64, 0.03, by_sampler(Sampler::stratified)},
    Setting{"random, cut 0.03", 16, 0.03, by_sampler(Sampler::random)},
    Setting{"random, cut 0.03", 64, 0.03, by_sampler(Sampler::random)},
    Setting{"float, cut 0.03", 16, 0.03, single},
};

double root_mean_square(const Image &a, const Image &b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const Rgb d = a.pixels[i] - b.pixels[i];
        sum += d.r * d.r + d.g * d.g + d.b * d.b;
    }
    return std::sqrt(sum / (3.0 * static_cast<double>(a.pixels.size())));
}

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

TracerOutcome render(const Scene &scene, int samples, double cut_weight, std::uint64_t seed,
                     const TracerSettings &tracer, int threads) {
    RenderJob job;
    job.scene = scene;
    job.samples_per_pixel = samples;
    job.cut_weight = cut_weight;
    job.replicates = {{seed, {}}};
    job.threads = threads;
    return trace(job, tracer);
}

Image reference_of(const Scene &scene, const char *file) {
    if (file) {
        Image image = read_image(file);
        if (image.width != scene.camera.image_width_px() || image.height != scene.camera.image_height_px())
            throw Error(Exit::bad_data, fmt::format("{} is not of the size of the picture", file));
        return image;
    }
    constexpr int samples = 256;
    const Image one = render(scene, samples, 1e-4, 1001, {}, 0).images[0];
    const Image two = render(scene, samples, 1e-4, 1002, {}, 0).images[0];
    Image mean = one;
    for (std::size_t i = 0; i < mean.pixels.size(); ++i) mean.pixels[i] = 0.5 * (one.pixels[i] + two.pixels[i]);
    fmt::print("reference: 2 x {} samples; they differ by {:.2e}, so its own error is some {:.1e}\n", samples,
               root_mean_square(one, two), root_mean_square(one, two) / 2);
    return mean;
}

void run(const char *file, int size_px, const char *reference_file) {
    const SceneRecipe recipe = mitsuba_scene(file);
    Scene scene = recipe.make(Parameters(recipe.parameters, Preset::text, file_reader()));
    scene.camera.width_px = scene.camera.height_px = size_px;
    validate(scene);
    const Image reference = reference_of(scene, reference_file);
    std::array<std::vector<double>, settings.size()> errors, seconds, set_up;
    constexpr int turns = 3;
    for (int turn = 0; turn < turns; ++turn)
        for (std::size_t i = 0; i < settings.size(); ++i) {
            const Setting &s = settings[i];
            const TracerOutcome outcome =
                render(scene, s.samples, s.cut_weight, static_cast<std::uint64_t>(turn) + 1, s.tracer, 1);
            errors[i].push_back(root_mean_square(outcome.images[0], reference));
            seconds[i].push_back(outcome.cpu_seconds - outcome.set_up_cpu_seconds);
            set_up[i].push_back(outcome.set_up_cpu_seconds);
        }
    fmt::print("{:24} {:>7} {:>9} {:>9} {:>9} {:>12}\n", "setting", "samples", "RMSE", "CPU s", "set-up s", "RMSE^2 s");
    for (std::size_t i = 0; i < settings.size(); ++i) {
        const double e = median(errors[i]), t = median(seconds[i]);
        fmt::print("{:24} {:7} {:9.2e} {:9.3f} {:9.4f} {:12.2e}\n", settings[i].name, settings[i].samples, e, t,
                   median(set_up[i]), e * e * t);
    }
}

} // namespace
} // namespace threefold

int main(int argc, char **argv) {
    const int size_px = argc > 2 ? std::atoi(argv[2]) : 512;
    if (argc < 2 || argc > 4 || size_px < 1) {
        fmt::print(stderr, "usage: threefold_referee SCENE.xml [SIZE_PX [REFERENCE.exr]]\n");
        return 64;
    }
    try {
        threefold::run(argv[1], size_px, argc > 3 ? argv[3] : nullptr);
    } catch (const threefold::Error &error) {
        fmt::print(stderr, "{}\n", error.what());
        return static_cast<int>(error.code());
    }
    return 0;
}
