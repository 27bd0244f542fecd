// SPDX-License-Identifier: MIT
// White furnace: in surroundings that are the same everywhere, glass that neither takes nor gives light must vanish.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "verifier/claims/claim.h"
#include "verifier/claims/prediction.h"
#include "verifier/measure/radiance.h"

namespace threefold {

namespace {

constexpr int rings_full = 200; ///< half a percent of the radius each
constexpr int rings_quick = 20;

/// What the worst ring loses to a tree whose branches are cut.
double worst_missing(const OrbInScene &orb, int rings, double cut_weight) {
    double worst = 0;
    // The deficit grows towards the borders of the hollow and of the orb; rings further in lose less than a tenth of
    // it.
    for (int k = rings / 2; k < rings; ++k)
        worst = std::max(worst, mean_missing_weight(orb, orb.optics.outer_mm * k / rings,
                                                    orb.optics.outer_mm * (k + 1) / rings, cut_weight));
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
    e.predict = [orb, rings](const Accuracy &a) {
        // A deficit that the cut of a tree must leave is predicted, so that no tolerance has to hide it.
        const bool branches = a.cut_weight > 0 && !a.cuts_whole_trees;
        const double missing = branches ? worst_missing(orb, rings, a.cut_weight) : 0;
        std::vector<BudgetItem> budget{
            {"quantisation", 2 * a.radiance_step, "of the stored picture"},
            {"arithmetic", 2e-6, "a few tens of products of shares in single precision"},
        };
        if (a.cuts_whole_trees)
            budget.push_back(
                {"truncation", 2 * a.cut_weight, "what is left in a tree when it ends, by the renderer's own rule"});
        if (branches)
            budget.push_back({"truncation", 0.2 * missing,
                              fmt::format("branches under {:g} are dropped: the deficit of {:.2g} in the worst ring is "
                                          "predicted; how it falls on the pixels of a ring is known to a fifth",
                                          a.cut_weight, missing)});
        return std::vector<Expected>{
            {"darkest ring", "", Relation::equal, 1 - missing, budget},
            {"brightest ring", "", Relation::equal, 1, budget},
        };
    };
    e.measure = [orb, rings](const Image &image, const Camera &camera) {
        const auto means = ring_means(image, rings, [&](int column, int row) {
            const Ray ray = camera_ray(camera, pixel_sample(camera, column, row));
            return static_cast<int>(std::floor(impact_parameter(ray, orb.centre_mm) / orb.optics.outer_mm * rings));
        });
        // fmin and fmax pass over rings without a pixel; without any ring nothing is measured.
        double darkest = std::numeric_limits<double>::quiet_NaN(), brightest = darkest;
        for (const double m : means) {
            darkest = std::fmin(darkest, m);
            brightest = std::fmax(brightest, m);
        }
        return std::vector<Reading>{{"darkest ring", darkest}, {"brightest ring", brightest}};
    };
    return e;
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
    claim.mutant = Fault::radiance_slip;
    return claim;
}

} // namespace threefold
