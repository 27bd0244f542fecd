// SPDX-License-Identifier: MIT
#include "verifier/check/plan.h"

#include <algorithm>

#include "exporter/scene_json.h"
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
        const auto repeated = std::ranges::unique(valid);
        valid.erase(repeated.begin(), repeated.end());
        if (!std::ranges::binary_search(valid, a.name))
            throw Error(Exit::usage, unknown_name("parameter", a.name, valid));
    }
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
    std::vector<PlannedClaim> plan;
    for (const bool calibrating : {true, false})
        for (const Preset preset : request.presets)
            for (const Claim &claim : request.claims) {
                if ((claim.name == calibration_name) != calibrating) continue;
                const ClaimContext context{request.scenes, preset, request.assignments, request.quick};
                plan.push_back({&claim, context, claim.experiments(context)});
            }
    require_known(request.assignments, plan);
    for (PlannedClaim &p : plan)
        for (Experiment &e : p.experiments) {
            validate(e.scene);
            e.record.scene_hash = scene_hash(e.scene);
        }
    return plan;
}

std::vector<PlannedJob> planned_jobs(const CheckRequest &request) {
    std::vector<PlannedJob> jobs;
    for (const PlannedClaim &planned : plan_of(request))
        for (const Experiment &e : planned.experiments)
            if (!e.inspect) jobs.push_back({planned.claim->name, e.name, job_of(e, request.seed, request.threads)});
    return jobs;
}

} // namespace threefold
