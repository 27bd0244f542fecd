// SPDX-License-Identifier: MIT
// Without glass: does the camera look where the scene says, do images lie the right way, is radiance kept?
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "scenes/texture.h"
#include "verifier/claims/claim.h"
#include "verifier/claims/prediction.h"
#include "verifier/claims/scope_bounds.h"
#include "verifier/measure/optical_map.h"
#include "verifier/measure/radiance.h"

namespace threefold {

namespace {

const Quad &patches_of(const Scene &scene) { return std::get<Quad>(scene.objects.back().shape); }

std::optional<Vec3> straight_landing(const Quad &card, const Ray &ray) {
    return optics::landing_on_plane(ray, card.centre_mm, glm::cross(card.half_u_mm, card.half_v_mm));
}

double pixel_mm(const Scene &scene) {
    const Camera &camera = scene.camera;
    return 2 * film_half_width(camera) / camera.width_px * glm::length(camera.eye_mm - camera.target_mm);
}

/// Mean and slope of (measured - true landing) over the coordinate card, in pixels.
std::vector<Reading> measure_registration(const Scene &scene, const Image &image, const Camera &camera) {
    const Quad &card = card_of(scene);
    const double px = pixel_mm(scene);
    Vec2 sum(0), first(0), along(0);
    double count = 0;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const auto truth = straight_landing(card, camera_ray(camera, pixel_sample(camera, column, row)));
            if (!truth || !on_card(card, *truth, 1.5 * px)) continue;
            const auto landed = landing_point(card, image.at(column, row));
            const Vec3 d = landed ? *landed - *truth : 2.0 * card.half_u_mm;
            const Vec2 error(glm::dot(d, glm::normalize(card.half_u_mm)) / px,
                             -glm::dot(d, glm::normalize(card.half_v_mm)) / px);
            const Vec2 place(glm::dot(*truth - card.centre_mm, glm::normalize(card.half_u_mm)) / px,
                             -glm::dot(*truth - card.centre_mm, glm::normalize(card.half_v_mm)) / px);
            sum += error;
            first += error * place;
            along += place * place;
            count += 1;
        }
    return {{"horizontal shift", sum.x / count},
            {"vertical shift", sum.y / count},
            {"horizontal scale", 1 + first.x / along.x},
            {"vertical scale", 1 + first.y / along.y}};
}

/// The greatest departure of a patch's middle from its radiance, and the environment's radiance in the frame's corners.
std::vector<Reading> measure_radiance(const Scene &scene, const Image &image, const Camera &camera) {
    const Quad &card = patches_of(scene);
    const Texture &texture = *std::get<std::shared_ptr<const Texture>>(std::get<Emissive>(card.surface).radiance);
    double worst = 0;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const auto truth = straight_landing(card, camera_ray(camera, pixel_sample(camera, column, row)));
            if (!truth || !on_card(card, *truth)) continue;
            const Vec2 uv = coordinates_on(card, *truth);
            const Vec2 in_patch = glm::fract(uv * 4.0);
            if (std::min({in_patch.x, in_patch.y, 1 - in_patch.x, 1 - in_patch.y}) < 0.15) continue;
            const Rgb d = glm::abs(image.at(column, row) - sample(texture, uv));
            worst = std::max({worst, d.r, d.g, d.b});
        }
    return {{"greatest error of a known radiance", worst}, {"radiance of the surroundings", image.at(0, 0).g}};
}

std::vector<ScopeNumber> calibration_scope(const ClaimContext &context, const ScopeSettings &) {
    const Experiment e = claim_calibration().experiments(context).front();
    const LitBounds lit = nothing_is_lit(e.scene);
    EffectBounds bounds = none_of_them("there is no glass in its scene");
    bounds.light_size = lit.light_size;
    bounds.caustics = lit.caustics;
    bounds.interreflection = lit.interreflection;
    bounds.pupil = Bound::none(
        "both cards stand where the eye is focused: every point of the pupil sees the same point of them in a pixel");
    std::vector<ScopeNumber> numbers;
    for (const char *quantity : {"horizontal shift", "vertical scale", "greatest error of a known radiance"}) {
        const Expected row = expected_row(e, quantity);
        numbers.push_back({row.quantity, row.unit, row.value, total(row.budget), margin_is_tolerance, bounds});
    }
    return numbers;
}

} // namespace

Claim claim_calibration() {
    Claim claim;
    claim.name = "calibration";
    claim.statement =
        "Without glass, every renderer looks where the scene says, keeps images upright and unmirrored, and "
        "returns the radiance it was given.";
    claim.experiments = [](const ClaimContext &context) {
        const std::string size = context.quick ? "64" : "128";
        Experiment e =
            context.experiment("calibration", "a coordinate card beside patches of known radiance", "calibration",
                               {assign("image.width_px", size), assign("image.height_px", size)}, {});
        e.sampling = Sampling::pixel_centres;
        e.samples_per_pixel = 1;
        e.shift_replicates = true;
        const Scene scene = e.scene;
        e.predict = [scene](const Accuracy &a) {
            const double px = pixel_mm(scene), width = 2 * glm::length(card_of(scene).half_u_mm) / px;
            const std::vector<BudgetItem> shift{
                {"quantisation", 4 * a.radiance_step * width, "a ratio of two stored numbers, times the card's width"},
                {"arithmetic", 4 * a.rounding_mm / px, "rounding of positions at the scale of the scene"},
                {"filter", a.filter_px, "spread of the sample position"},
            };
            std::vector<BudgetItem> scale = shift;
            for (BudgetItem &item : scale) item.value *= 4 / width; // over half a card
            const std::vector<BudgetItem> radiance{
                {"quantisation", 2 * a.radiance_step, "of the stored picture"},
                {"interpolation", 2e-5, "16-bit samples, interpolated in single precision"},
            };
            const double surroundings = scene.environment ? scene.environment->radiance.g : 0;
            return std::vector<Expected>{
                {"horizontal shift", "px", Relation::equal, 0, shift},
                {"vertical shift", "px", Relation::equal, 0, shift},
                {"horizontal scale", "", Relation::equal, 1, scale},
                {"vertical scale", "", Relation::equal, 1, scale},
                {"greatest error of a known radiance", "", Relation::equal, 0, radiance},
                {"radiance of the surroundings", "", Relation::equal, surroundings, radiance},
            };
        };
        e.measure = [scene](const Image &image, const Camera &camera) {
            std::vector<Reading> readings = measure_registration(scene, image, camera);
            for (const Reading &r : measure_radiance(scene, image, camera)) readings.push_back(r);
            return readings;
        };
        return std::vector{e};
    };
    claim.summary = [](const ClaimContext &, Verdict verdict) {
        switch (verdict) {
        case Verdict::holds:
            return "The renderers can be trusted with the questions that follow.";
        case Verdict::fails:
            return "A renderer does not reproduce even a scene without glass: it has no vote in what follows.";
        case Verdict::undecided:
            return "Not every renderer could be calibrated.";
        }
        return "";
    };
    claim.scope = calibration_scope;
    claim.mutant = Fault::camera_one_pixel;
    return claim;
}

} // namespace threefold
