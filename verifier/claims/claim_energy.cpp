// SPDX-License-Identifier: MIT
// White furnace: in surroundings that are the same everywhere, glass that neither takes nor gives light must vanish.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "verifier/claims/claim.h"
#include "verifier/claims/prediction.h"
#include "verifier/claims/scope_bounds.h"
#include "verifier/measure/radiance.h"

namespace threefold {

namespace {

constexpr int rings_full = 200; ///< half a percent of the radius each
constexpr int rings_quick = 20;

/// What a tree whose branches are cut loses: in the worst ring, and over the whole disc.
struct Missing {
    double worst_ring = 0, disc = 0;
};

Missing missing_of(const OrbInScene &orb, int rings, double cut_weight) {
    Missing missing;
    for (int k = 0; k < rings; ++k) {
        const double inner = static_cast<double>(k) / rings, outer = static_cast<double>(k + 1) / rings;
        const double ring =
            mean_missing_weight(orb, orb.optics.outer_mm * inner, orb.optics.outer_mm * outer, cut_weight);
        missing.worst_ring = std::max(missing.worst_ring, ring);
        missing.disc += ring * (outer * outer - inner * inner);
    }
    return missing;
}

/// The number of the ring that the pixel's ray meets the orb in; beyond the orb it is `rings` or more.
int ring_of(const OrbInScene &orb, int rings, const Camera &camera, int column, int row) {
    const Ray ray = camera_ray(camera, pixel_sample(camera, column, row));
    return static_cast<int>(std::floor(impact_parameter(ray, orb.centre_mm) / orb.optics.outer_mm * rings));
}

std::vector<int> pixels_of_rings(const OrbInScene &orb, int rings, const Camera &camera) {
    std::vector<int> counts(static_cast<std::size_t>(rings), 0);
    for (int row = 0; row < camera.image_height_px(); ++row)
        for (int column = 0; column < camera.image_width_px(); ++column)
            if (const int k = ring_of(orb, rings, camera, column, row); k < rings)
                ++counts[static_cast<std::size_t>(k)];
    return counts;
}

/// The greatest share of a ring's paths that may be missing by rare losses, so many a path on average: in each ring no
/// more are lost than its Poisson number exceeds once in a thousand pictures.
double worst_loss(const std::vector<int> &pixels, const Accuracy &a) {
    double worst = 0;
    const double chance = 1e-3 / static_cast<double>(pixels.size());
    for (const int count : pixels) {
        if (count == 0) continue;
        const double n = count * a.paths_per_pixel, mean = n * a.lost_paths;
        double at_least = 1 - std::exp(-mean), term = std::exp(-mean); // P(more than m), P(m)
        int m = 0;
        while (at_least > chance && m < n) {
            ++m;
            term *= mean / m;
            at_least -= term;
        }
        worst = std::max(worst, m / n);
    }
    return worst;
}

Experiment furnace(const ClaimContext &context, const std::string &kind) {
    const std::string size = context.quick ? "64" : "256";
    Experiment e =
        context.experiment("furnace-" + kind, fmt::format("a {} orb in uniform surroundings", kind), "furnace",
                           {assign("image.width_px", size), assign("image.height_px", size)},
                           {assign("orb.kind", kind), assign("glass.coating", "fresnel"),
                            assign("glass.interface_transmittance", "1"), assign("environment.radiance", "1")});
    e.sampling = Sampling::pixel_centres;
    e.samples_per_pixel = 1;
    e.shift_replicates = true;
    const int rings = context.quick ? rings_quick : rings_full;
    const Scene scene = e.scene;
    const OrbInScene orb = orb_of(scene);
    const std::vector<int> pixels = pixels_of_rings(orb, rings, scene.camera);
    e.predict = [orb, rings, pixels](const Accuracy &a) {
        // A deficit that the cut of a tree must leave is predicted, so that no tolerance has to hide it.
        const bool branches = a.cut_weight > 0 && !a.cuts_whole_trees;
        const Missing missing = branches ? missing_of(orb, rings, a.cut_weight) : Missing{};
        const auto budget = [&](double deficit, double lost, const std::string &where) {
            std::vector<BudgetItem> items{
                {"quantisation", 2 * a.radiance_step, "of the stored picture"},
                {"arithmetic", 2e-6, "a few tens of products of shares in single precision"},
            };
            if (a.cuts_whole_trees)
                items.push_back({"truncation", 2 * a.cut_weight,
                                 "what is left in a tree when it ends, by the renderer's own rule"});
            if (branches)
                items.push_back(
                    {"truncation", 0.2 * deficit,
                     fmt::format("branches under {:g} are dropped: the deficit of {:.2g} in {} is predicted; "
                                 "how it falls on the pixels is known to a fifth",
                                 a.cut_weight, deficit, where)});
            if (lost > 0)
                items.push_back({"lost paths", lost,
                                 fmt::format("up to {:.2g} of all paths are lost, each {} of {}", a.lost_paths,
                                             a.paths_per_pixel > 1 ? fmt::format("1/{:g} of a pixel", a.paths_per_pixel)
                                                                   : "a whole pixel",
                                             where)});
            return items;
        };
        const std::vector<BudgetItem> ring =
            budget(missing.worst_ring, a.lost_paths > 0 ? worst_loss(pixels, a) : 0, "a ring");
        // Where a lost path is a small share of a pixel, a few more of them than on average are no more than that.
        const double disc_loss = a.paths_per_pixel > 1 && a.lost_paths > 0
                                     ? worst_loss({std::accumulate(pixels.begin(), pixels.end(), 0)}, a)
                                     : a.lost_paths;
        return std::vector<Expected>{
            {"darkest ring", "", Relation::equal, 1 - missing.worst_ring, ring},
            {"brightest ring", "", Relation::equal, 1, ring},
            {"the whole disc", "", Relation::equal, 1 - missing.disc, budget(missing.disc, disc_loss, "the disc")},
        };
    };
    e.measure = [orb, rings](const Image &image, const Camera &camera) {
        const auto means =
            ring_means(image, rings, [&](int column, int row) { return ring_of(orb, rings, camera, column, row); });
        const auto disc =
            ring_means(image, 1, [&](int column, int row) { return ring_of(orb, 1, camera, column, row); });
        // fmin and fmax pass over rings without a pixel; without any ring nothing is measured.
        double darkest = std::numeric_limits<double>::quiet_NaN(), brightest = darkest;
        for (const double m : means) {
            darkest = std::fmin(darkest, m);
            brightest = std::fmax(brightest, m);
        }
        return std::vector<Reading>{
            {"darkest ring", darkest}, {"brightest ring", brightest}, {"the whole disc", disc.front()}};
    };
    return e;
}

/// Of the darkest of many thin rings, when every order of the light is followed: in surroundings of 1 the sum of what
/// comes out.
double darkest_ring(const OrbInScene &orb, const LightModel &model) {
    constexpr int rings = 100;
    double darkest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < rings; ++k) {
        const double b = orb.optics.outer_mm * (k + 0.5) / rings;
        double sum = 0;
        for (const ExitRay &exit :
             exit_rays(orb, {orb.centre_mm + Vec3(b, 0, 10 * orb.optics.outer_mm), {0, 0, -1}}, 1e-9, model))
            sum += exit.weight;
        darkest = std::min(darkest, sum);
    }
    return darkest;
}

std::vector<ScopeNumber> energy_scope(const ClaimContext &context, const ScopeSettings &settings) {
    std::vector<ScopeNumber> numbers;
    for (const std::string kind : {"hollow", "solid"}) {
        const Experiment e = furnace(context, kind);
        const OrbInScene orb = orb_of(e.scene);
        const Expected row = expected_row(e, "darkest ring");
        const auto by_model = [&](const LightModel &model) { return darkest_ring(orb, model); };
        const IndexBounds index = by_index(orb.optics.index, settings, [&](double n) {
            OrbInScene changed = orb;
            changed.optics.index = n;
            return darkest_ring(changed, {});
        });
        const LitBounds lit = nothing_is_lit(e.scene);
        const char *alike = "surroundings that are the same everywhere look the same from every point of the pupil";
        numbers.push_back({fmt::format("radiance of the darkest ring of the {} orb", kind),
                           "",
                           row.value,
                           total(row.budget),
                           margin_is_tolerance,
                           {.polarisation = by_polarisation(by_model),
                            .dispersion = index.dispersion,
                            .absorption = by_absorption(settings, by_model),
                            .birefringence = index.birefringence,
                            .light_size = lit.light_size,
                            .caustics = lit.caustics,
                            .interreflection = lit.interreflection,
                            .pupil = Bound::none(alike)}});
    }
    return numbers;
}

} // namespace

Claim claim_energy() {
    Claim claim;
    claim.name = "energy";
    claim.statement =
        "Clear glass neither takes nor gives light: in surroundings that are the same everywhere, the orb "
        "cannot be seen.";
    claim.experiments = [](const ClaimContext &context) {
        return std::vector{furnace(context, "hollow"), furnace(context, "solid")};
    };
    claim.summary = [](const ClaimContext &, Verdict verdict) {
        switch (verdict) {
        case Verdict::holds:
            return "No renderer loses or invents light in the glass, up to what its cut of the ray tree is known to "
                   "drop.";
        case Verdict::fails:
            return "A renderer loses or invents light in the glass.";
        case Verdict::undecided:
            return "It is not settled whether every renderer keeps the light in the glass.";
        }
        return "";
    };
    claim.scope = energy_scope;
    claim.mutant = Fault::radiance_slip;
    return claim;
}

} // namespace threefold
