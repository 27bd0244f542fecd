// SPDX-License-Identifier: MIT
#include "verifier/check/plan.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "exporter/scene_json.h"
#include "scenes/error.h"
#include "scenes/validate.h"
#include "verifier/tracer/sampler.h"

namespace threefold {

namespace {

void require_known(const std::vector<Assignment> &assignments, const std::vector<PlannedClaim> &plan) {
    for (const Assignment &a : assignments) {
        std::vector<std::string> valid;
        for (const PlannedClaim &p : plan)
            for (const Experiment &e : p.experiments)
                for (const auto &[name, value] : e.record.parameters) valid.push_back(name);
        std::ranges::sort(valid);
        valid.erase(std::unique(valid.begin(), valid.end()), valid.end()); // not of std::ranges, for Clang 14
        if (!std::ranges::binary_search(valid, a.name))
            throw Error(Exit::usage, unknown_name("parameter", a.name, valid));
    }
}

/// A value that no scene can have is the user's mistake; one that does not go with the others may suit another claim.
void require_in_range(const CheckRequest &request) {
    for (const Preset preset : request.presets)
        for (const SceneRecipe &recipe : request.scenes)
            for (const Assignment &a : request.assignments) {
                Parameters values(recipe.parameters, preset);
                if (values.has(a.name)) values.set(a.name, a.value);
            }
}

/// "1e3" and "1000" are the same; a word or a path is itself.
bool is_same_value(const std::string &a, const std::string &b) {
    const auto x = parse_number(a), y = parse_number(b);
    return a == b || (x && y && *x == *y);
}

/// " with orb.radius_mm=160, glass.index=1.6"
std::string with_values(const CheckRequest &request) {
    std::string text;
    for (const Assignment &a : request.assignments)
        text += fmt::format("{}{}={}", text.empty() ? " with " : ", ", a.name, a.value);
    return text;
}

std::vector<Experiment> experiments_of(const Claim &claim, const ClaimContext &context, int least_replicates) {
    std::vector<Experiment> all = claim.experiments(context);
    for (Experiment &e : all) {
        if (e.replicates > 1) e.replicates = std::max(e.replicates, least_replicates);
        validate(e.scene);
        e.record.scene_hash = scene_hash(e.scene);
    }
    return all;
}

} // namespace

std::vector<Replicate> replicates_of(const Experiment &e, std::uint64_t seed) {
    std::vector<Replicate> all;
    for (int k = 0; k < e.replicates; ++k) {
        Replicate r;
        r.seed = tracer::mix(seed * 0x10001 + static_cast<std::uint64_t>(k));
        // Cosets of a lattice: each replicate looks through another point of its pixels.
        if (e.shift_replicates) {
            const tracer::PixelSampler where(seed, 0, 0);
            r.film_offset_px = where.position(static_cast<std::uint32_t>(k)) - Vec2(0.5);
        }
        all.push_back(r);
    }
    return all;
}

Camera camera_of(const Experiment &e, const Replicate &replicate) {
    Camera camera = e.scene.camera;
    camera.film_offset_px += replicate.film_offset_px;
    return camera;
}

RenderJob job_of(const Experiment &e, std::uint64_t seed, int threads) {
    RenderJob job;
    job.scene = e.scene;
    job.sampling = e.sampling;
    job.samples_per_pixel = e.samples_per_pixel;
    job.replicates = replicates_of(e, seed);
    job.surface_tolerance_mm = e.surface_tolerance_mm;
    job.cut_weight = e.cut_weight;
    job.threads = threads;
    return job;
}

std::vector<PlannedClaim> plan_of(const CheckRequest &request) {
    require_in_range(request);
    std::vector<PlannedClaim> plan;
    std::optional<Error> first;
    for (const bool calibrating : {true, false})
        for (const Preset preset : request.presets)
            for (const Claim &claim : request.claims) {
                if ((claim.name == calibration_name) != calibrating) continue;
                const ClaimContext context{request.scenes, preset, request.assignments, request.quick};
                plan.push_back({&claim, context, {}});
                try {
                    plan.back().experiments = experiments_of(claim, context, request.least_replicates);
                } catch (const Error &error) {
                    if (error.code() != Exit::bad_data) throw;
                    plan.back().problem = fmt::format("{} ({}) has no scene{}: {}", claim.name, to_string(preset),
                                                      with_values(request), error.what());
                    if (!first) first = Error(error.code(), plan.back().problem, error.hint());
                }
            }
    const auto calibrates = [](const PlannedClaim &p) { return p.claim->name == calibration_name; };
    const bool some = std::ranges::any_of(plan, [&](const auto &p) { return !calibrates(p) && p.problem.empty(); });
    const bool all_calibrate =
        std::ranges::all_of(plan, [&](const auto &p) { return !calibrates(p) || p.problem.empty(); });
    if (first && !(some && all_calibrate)) throw *first;
    if (!first) require_known(request.assignments, plan); // what a claim left out would have known is not known here
    return plan;
}

std::vector<std::string> unused_values(const PlannedClaim &planned) {
    std::vector<std::string> names;
    for (const Assignment &a : planned.context.assignments) {
        bool known = false, used = false;
        for (const Experiment &e : planned.experiments) {
            const auto value = e.record.parameters.find(a.name);
            if (value == e.record.parameters.end()) continue;
            known = true;
            used = used || is_same_value(value->second, a.value);
        }
        if (known && !used && std::ranges::count(names, a.name) == 0) names.push_back(a.name);
    }
    return names;
}

std::vector<PlannedJob> planned_jobs(const CheckRequest &request) {
    std::vector<PlannedJob> jobs;
    for (const PlannedClaim &planned : plan_of(request))
        for (const Experiment &e : planned.experiments)
            if (!e.inspect) jobs.push_back({planned.claim->name, e.name, job_of(e, request.seed, request.threads)});
    return jobs;
}

} // namespace threefold
