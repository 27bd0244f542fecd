// SPDX-License-Identifier: MIT
// The whole composition (figure 1B of the study): no number, the renderers make the same picture.
#include "scenes/catalogue/composition.h"
#include "verifier/claims/picture_scope.h"
#include "verifier/claims/whole_picture.h"

namespace threefold {

Claim claim_salvator() {
    Claim claim;
    claim.name = "salvator";
    claim.statement = "The whole composition, figure, hand and orb in the study's light, is the same picture in every "
                      "renderer.";
    claim.experiments = [](const ClaimContext &context) {
        // The relief is raised along the lines of sight: its border stands where the composition has it.
        const Border border{"robe", identity_colour("robe"), [](const Camera &camera, double) {
                                return 0.5 * camera.width_px * (1 + figure::relief_low.x);
                            }};
        std::vector<Experiment> all{context.quick ? whole_picture(context, "salvator", 88, 130, 5)
                                                  : whole_picture(context, "salvator", 144, 212, 5)};
        const auto &parameters = all.front().record.parameters;
        if (parameters.at("robe.mesh").empty() && std::stod(parameters.at("robe.shift_mm")) == 0)
            all.push_back(border_experiment(context, "salvator", 176, 259, border));
        return all;
    };
    claim.summary = [](const ClaimContext &, Verdict verdict) {
        switch (verdict) {
        case Verdict::holds:
            return "Every renderer paints the same picture of the figure with the orb: no tile that matters differs.";
        case Verdict::fails:
            return "The renderers do not paint the same picture of the figure with the orb.";
        case Verdict::undecided:
            return "It is not settled whether the renderers paint the same picture.";
        }
        return "";
    };
    claim.notes = [](const ClaimContext &) {
        return std::vector<std::string>{
            "Light that glass gathers (caustics) and light that surfaces throw on each other are left out, in every "
            "renderer: the orb's shadow is the same share of the light wherever it falls."};
    };
    claim.scope = [](const ClaimContext &context, const ScopeSettings &settings) {
        return picture_scope(whole_picture(context, "salvator", 144, 212, 1), settings);
    };
    claim.mutant = Fault::camera_one_pixel;
    return claim;
}

} // namespace threefold
