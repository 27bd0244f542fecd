// SPDX-License-Identifier: MIT
// Any scene as a claim: no number, the renderers make the same picture.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scenes/access.h"
#include "verifier/claims/picture_scope.h"
#include "verifier/claims/whole_picture.h"

namespace threefold {

namespace {

int orbs_in(const Scene &scene) {
    return static_cast<int>(
        std::ranges::count_if(scene.objects, [](const Object &object) { return glass_of(object.shape) != nullptr; }));
}

/// A larger picture is made smaller; one whose size the user gives is left as it is.
Experiment picture_of(const SceneRecipe &recipe, const ClaimContext &context) {
    const std::vector<SceneRecipe> alone{recipe};
    const ClaimContext own{alone, context.preset, context.assignments, context.quick};
    const auto make = [&](const std::vector<Assignment> &defaults) {
        return own.experiment("picture", recipe.summary + ", to be compared tile by tile", recipe.name, defaults, {});
    };
    Experiment e = make({});
    const int width = e.scene.camera.image_width_px(), height = e.scene.camera.image_height_px();
    const int most_px = context.quick ? 128 : 256;
    const bool sized = std::ranges::any_of(context.assignments, [](const Assignment &a) {
        return a.name == "image.width_px" || a.name == "image.height_px";
    });
    if (!sized && std::max(width, height) > most_px) {
        const double share = static_cast<double>(most_px) / std::max(width, height);
        const auto smaller = [share](int px) { return std::max(1.0, std::round(share * px)); };
        e = make({assign("image.width_px", smaller(width)), assign("image.height_px", smaller(height))});
    }
    compare_as_picture(e, 8);
    return e;
}

} // namespace

Claim claim_picture(SceneRecipe recipe) {
    Claim claim;
    claim.name = "picture";
    claim.statement = fmt::format("{} is the same picture in every renderer.", recipe.name);
    claim.experiments = [recipe](const ClaimContext &context) { return std::vector{picture_of(recipe, context)}; };
    claim.summary = [name = recipe.name](const ClaimContext &, Verdict verdict) {
        switch (verdict) {
        case Verdict::holds:
            return fmt::format("Every renderer makes the same picture of {}: no tile that matters differs.", name);
        case Verdict::fails:
            return fmt::format("The renderers do not make the same picture of {}.", name);
        case Verdict::undecided:
            return fmt::format("It is not settled whether the renderers make the same picture of {}.", name);
        }
        return std::string();
    };
    claim.notes = [recipe](const ClaimContext &context) {
        std::vector<std::string> notes{
            "Nothing in the scene says what the picture should be: that all renderers agree is "
            "what is judged, and that each looks where it should is their calibration."};
        const int orbs = orbs_in(picture_of(recipe, context).scene);
        if (orbs == 0) notes.emplace_back("The scene holds no glass: nothing is learnt here of how it is rendered.");
        if (orbs > 1) notes.emplace_back("With several orbs there is no bound on what the model leaves out.");
        return notes;
    };
    claim.scope = [recipe](const ClaimContext &context, const ScopeSettings &settings) {
        const Experiment e = picture_of(recipe, context);
        // The bounds are those of one orb.
        return orbs_in(e.scene) == 1 ? picture_scope(e, settings) : std::vector<ScopeNumber>();
    };
    claim.mutant = Fault::camera_one_pixel;
    return claim;
}

} // namespace threefold
