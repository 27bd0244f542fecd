// SPDX-License-Identifier: MIT
#include "verifier/studies/power_pictures.h"

#include <algorithm>
#include <cmath>

#include "scenes/access.h"
#include "scenes/figure/light.h"
#include "scenes/validate.h"
#include "verifier/tracer/sampler.h"
#include "verifier/tracer/tracer.h"

namespace threefold {

namespace {

constexpr int samples_per_pixel = 64, reference_replicates = 16;
constexpr double longest_side_px = 128;

/// Small, textured, and with glass that takes some light, so that no fault is out of the judges' sight.
Scene picture_scene(const SceneRecipe &recipe) {
    Parameters values(recipe.parameters, Preset::text);
    for (const Assignment &a : {Assignment{"card.surface", "textured"}, {"glass.interface_transmittance", "0.89"}})
        if (values.has(a.name)) values.set(a.name, a.value);
    if (values.has("image.width_px") && values.has("image.height_px")) {
        const double width = values.number("image.width_px"), height = values.number("image.height_px");
        const double factor = std::min(1.0, longest_side_px / std::max(width, height));
        values.set("image.width_px", std::max(1.0, std::round(width * factor)));
        values.set("image.height_px", std::max(1.0, std::round(height * factor)));
    }
    return recipe.make(values);
}

/// The robe lit by the study's hundred and two lights instead of shining by itself.
Scene lit(Scene scene) {
    for (Object &object : scene.objects)
        if (Surface *surface = surface_of(object.shape))
            if (const Emissive *emissive = std::get_if<Emissive>(surface)) *surface = Diffuse{emissive->radiance};
    scene.environment.reset();
    scene.lights = study_lights();
    scene.glass_shadow = {GlassShadow::Rule::constant, 0.8};
    return scene;
}

} // namespace

PowerPictures::PowerPictures(const PowerRequest &request)
    : threads_(request.threads), tracer_(request.tracer), seed_(request.seed) {
    const auto has = [&](std::string_view name) {
        return std::ranges::count(request.scenes, name, &SceneRecipe::name) > 0;
    };
    if (has("hollow")) {
        const Scene hollow = picture_scene(find_scene(request.scenes, "hollow"));
        places_.push_back({"hollow", hollow, {}, {}});
        if (!has("salvator")) places_.push_back({"hollow, lit", lit(hollow), {}, {}});
    }
    if (has("salvator")) places_.push_back({"salvator", picture_scene(find_scene(request.scenes, "salvator")), {}, {}});
    for (const Place &place : places_) validate(place.scene);
}

std::vector<std::string> PowerPictures::names() const {
    std::vector<std::string> all;
    for (const Place &place : places_) all.push_back(place.name);
    return all;
}

RenderJob PowerPictures::job_of(const Scene &scene, std::vector<std::uint64_t> seeds) const {
    RenderJob job;
    job.scene = scene;
    job.sampling = Sampling::box;
    job.samples_per_pixel = samples_per_pixel;
    job.cut_weight = 1e-4;
    job.threads = threads_;
    job.replicates.clear();
    for (const std::uint64_t seed : seeds) job.replicates.push_back({seed, {0, 0}});
    return job;
}

void PowerPictures::make_references() {
    for (Place &place : places_) {
        std::vector<std::uint64_t> seeds;
        for (int k = 0; k < reference_replicates; ++k)
            seeds.push_back(tracer::mix(seed_ + 0x5eed0000u + static_cast<std::uint64_t>(k)));
        const std::vector<Image> replicates = trace(job_of(place.scene, seeds), tracer_).images;
        place.mean = mean(replicates);
        place.variance = variance_of_a_sample(replicates, samples_per_pixel);
    }
}

std::vector<PictureJudgement> PowerPictures::judge(const InjectedFault *fault, std::uint64_t seed) const {
    std::vector<PictureJudgement> all;
    for (const Place &place : places_) {
        RenderJob job = job_of(place.scene, {seed});
        if (fault) job = with_fault(std::move(job), *fault);
        const Image picture = trace(job, tracer_).images.front();
        all.push_back({place.name, judge_by_idiff(place.mean, picture), judge_by_rms(place.mean, picture),
                       judge_by_z_test(place.mean, place.variance, picture, samples_per_pixel)});
    }
    return all;
}

} // namespace threefold
