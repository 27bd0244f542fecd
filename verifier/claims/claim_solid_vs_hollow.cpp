// SPDX-License-Identifier: MIT
// "A solid orb inverts what lies behind it, a hollow one does not" (figure 3 of the study).
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "verifier/claims/claim.h"
#include "verifier/claims/prediction.h"
#include "verifier/measure/optical_map.h"

namespace threefold {

namespace {

constexpr double clear_share = 0.98;      ///< of the (inner) radius: beyond it a shell bends rays without bound
constexpr double axis_share = 0.3;        ///< of the clear radius: the central slope is fitted within it
constexpr double landing_goal = 1e-4;     ///< of the radius: what tessellation may cost a landing point
constexpr double finest_surface = 2.5e-6; ///< of the radius: finer spheres than this are not asked for

/// Distances from the axis point of the card along the direction in which a ray would land without glass.
std::optional<LandingPair> landing_pair(const OrbInScene &orb, const Quad &card, const Camera &camera, const Ray &ray,
                                        Vec3 landed) {
    const Vec3 normal = glm::cross(card.half_u_mm, card.half_v_mm);
    const auto straight = optics::landing_on_plane(ray, card.centre_mm, normal);
    const auto axis = optics::landing_on_plane({camera.eye_mm, glm::normalize(orb.centre_mm - camera.eye_mm)},
                                               card.centre_mm, normal);
    if (!straight || !axis) return std::nullopt;
    const double distance = glm::length(*straight - *axis);
    if (!(distance > 0)) return std::nullopt;
    return LandingPair{distance, glm::dot(landed - *axis, *straight - *axis) / distance};
}

/// Landing by the map of a picture, or by the closed form in its place: the same pixels, the same fit.
template <class Landing>
double slope_of(const Scene &scene, const OrbInScene &orb, const Camera &camera, Landing landing) {
    const Quad &card = card_of(scene);
    std::vector<LandingPair> pairs;
    for (int row = 0; row < camera.image_height_px(); ++row)
        for (int column = 0; column < camera.image_width_px(); ++column) {
            const Ray ray = camera_ray(camera, pixel_sample(camera, column, row));
            if (impact_parameter(ray, orb.centre_mm) > axis_share * orb.clear_radius_mm()) continue;
            if (const std::optional<Vec3> landed = landing(column, row, ray))
                if (const auto pair = landing_pair(orb, card, camera, ray, *landed)) pairs.push_back(*pair);
        }
    return central_slope(pairs);
}

/// Distance between measured and predicted landing of every pixel that the closed form puts on the card (or off it).
std::vector<double> landing_errors_mm(const Scene &scene, const OrbInScene &orb, const Image &image,
                                      const Camera &camera) {
    const Quad &card = card_of(scene);
    const double margin = 1e-3 * orb.optics.outer_mm, lost = 2 * glm::length(card.half_u_mm);
    std::vector<double> errors;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const Ray ray = camera_ray(camera, pixel_sample(camera, column, row));
            if (!(impact_parameter(ray, orb.centre_mm) < clear_share * orb.clear_radius_mm())) continue;
            const auto predicted = predicted_landing(orb, card, ray);
            const auto landed = landing_point(card, image.at(column, row));
            if (predicted && on_card(card, *predicted, margin))
                errors.push_back(landed ? glm::length(*landed - *predicted) : lost);
            else if (!predicted || !on_card(card, *predicted, -margin))
                errors.push_back(landed ? lost : 0); // it must miss the card as well
        }
    return errors;
}

Experiment map_experiment(const ClaimContext &context, const std::string &kind) {
    const std::string size = context.quick ? "64" : "128";
    Experiment e = context.experiment(kind + "-map", fmt::format("where each ray lands behind the {} orb", kind), kind,
                                      {assign("image.width_px", size), assign("image.height_px", size)},
                                      {assign("card.surface", "coordinate"), assign("glass.coating", "antireflective"),
                                       assign("glass.interface_transmittance", "1")});
    e.sampling = Sampling::pixel_centres;
    e.samples_per_pixel = 1;
    e.shift_replicates = true;

    const Scene scene = e.scene;
    const OrbInScene orb = orb_of(scene);
    const double leverage = landing_leverage(scene, clear_share, 0.95);
    e.surface_tolerance_mm = std::max(landing_goal / leverage, finest_surface) * orb.optics.outer_mm;
    const double eye = glm::length(scene.camera.eye_mm - orb.centre_mm);
    const double plane = std::abs(orb.centre_mm.z - card_of(scene).centre_mm.z);
    const double paraxial = optics::paraxial_slope(orb.optics, eye, plane);
    e.predict = [=](const Accuracy &a) {
        const double radius = orb.optics.outer_mm, width = 2 * glm::length(card_of(scene).half_u_mm);
        const double pixel = 2 * film_half_width(scene.camera) / scene.camera.width_px * eye;
        const std::vector<BudgetItem> landing{
            {"quantisation", 2 * std::sqrt(2.0) * a.radiance_step * width / radius,
             "two ratios of stored numbers, times the card's width"},
            {"tessellation", leverage * a.surface_mm / radius,
             fmt::format("distance of the rendered spheres from the true ones, times a leverage of {:.3g}", leverage)},
            {"arithmetic", 2 * leverage * a.rounding_mm / radius, "rounding of positions at the scale of the scene"},
            {"filter", leverage * a.filter_px * pixel / radius, "spread of the sample position"},
        };
        std::vector<BudgetItem> slope = landing;
        for (BudgetItem &item : slope) item.value *= radius / (axis_share * orb.clear_radius_mm());
        slope.push_back({"fit", 1e-9, "rounding of the fitted polynomial; its aberration is taken out"});
        std::vector<Expected> expected{
            {"landing error, 95th percentile", "radii", Relation::equal, 0, landing},
            {"central slope", "", Relation::equal, paraxial, slope, true},
        };
        // The conclusion itself, in the words of the study.
        expected.push_back(
            kind == "solid"
                ? Expected{"central slope of a solid orb is negative (inverted)", "", Relation::below, 0, {}}
                : Expected{"central slope of a hollow orb is positive (upright)", "", Relation::above, 0, {}});
        return expected;
    };
    e.measure = [=](const Image &image, const Camera &camera) {
        std::vector<double> errors = landing_errors_mm(scene, orb, image, camera);
        const double p95 = quantile(std::move(errors), 0.95) / orb.optics.outer_mm;
        const double fitted = slope_of(scene, orb, camera, [&](int column, int row, const Ray &) {
            return landing_point(card_of(scene), image.at(column, row));
        });
        // What the polynomial leaves of the aberration is the same on the closed form along the same rays.
        const double exact = slope_of(
            scene, orb, camera, [&](int, int, const Ray &ray) { return predicted_landing(orb, card_of(scene), ray); });
        const double slope = fitted - exact + paraxial;
        return std::vector<Reading>{{"landing error, 95th percentile", p95},
                                    {"central slope", slope},
                                    {kind == "solid" ? "central slope of a solid orb is negative (inverted)"
                                                     : "central slope of a hollow orb is positive (upright)",
                                     slope}};
    };
    return e;
}

/// For the eye alone: larger, and nothing is measured on it. Its ray trees may be cut early.
Experiment view_experiment(const ClaimContext &context, const std::string &kind) {
    const std::string size = context.quick ? "192" : "384";
    Experiment e = context.experiment(kind + "-view", fmt::format("what one sees behind the {} orb", kind), kind,
                                      {assign("image.width_px", size), assign("image.height_px", size)},
                                      {assign("card.surface", "textured")});
    e.sampling = Sampling::box;
    e.samples_per_pixel = 4;
    e.replicates = 1;
    e.cut_weight = 1e-3;
    e.surface_tolerance_mm = 1e-4 * orb_of(e.scene).optics.outer_mm;
    return e;
}

Experiment picture_experiment(const ClaimContext &context, const std::string &kind) {
    const std::string size = context.quick ? "48" : "96";
    Experiment e = context.experiment(
        kind + "-picture", fmt::format("the robe behind the {} orb, small, to be compared tile by tile", kind), kind,
        {assign("image.width_px", size), assign("image.height_px", size)}, {assign("card.surface", "textured")});
    e.sampling = Sampling::box;
    e.samples_per_pixel = kind == "solid" ? 72 : 32; // a solid orb splits a ray into few branches: they are cheap
    const Scene scene = e.scene;
    const OrbInScene orb = orb_of(scene);
    const double mean = predicted_mean_radiance(scene), brightest = 0.92;
    const double pixel =
        2 * film_half_width(scene.camera) / scene.camera.width_px * glm::length(scene.camera.eye_mm - orb.centre_mm);
    e.surface_tolerance_mm = 2e-3 * pixel;
    e.tile_budget = [=](const Accuracy &a, const Accuracy &b) {
        const auto dropped = [&](const Accuracy &x) {
            if (x.cuts_whole_trees) return 2 * x.cut_weight;
            return mean_missing_weight(orb, std::max(0.0, orb.optics.outer_mm - 8 * pixel), orb.optics.outer_mm,
                                       x.cut_weight);
        };
        const bool random = a.random_branches || b.random_branches;
        return std::vector<BudgetItem>{
            {"quantisation", a.radiance_step + b.radiance_step, "of the stored pictures"},
            {"truncation", (dropped(a) + dropped(b)) * brightest,
             "what cut ray trees lose in the outermost tile, computed"},
            {"tessellation", (a.surface_mm + b.surface_mm) / pixel * brightest / 8, "an edge of the orb across a tile"},
            {"resolution", (random ? 0.007 : 0.0035) * mean,
             random
                 ? "0.7 % of the mean radiance: the least difference that matters here, where a renderer follows one "
                   "branch at random"
                 : "0.35 % of the mean radiance: the least difference that matters here"},
        };
    };
    return e;
}

/// Which of the materials in the debate lie above an index.
std::string materials_above(double index) {
    struct Material {
        std::string_view name;
        double index; ///< sodium light; calcite: its lower one
    };
    constexpr Material materials[]{{"water", 1.333}, {"calcite", 1.486}, {"glass", 1.517}, {"rock crystal", 1.544}};
    std::vector<std::string_view> above;
    for (const Material &m : materials)
        if (m.index > index) above.push_back(m.name);
    return above.empty() ? "" : fmt::format(" Above it lie {}.", fmt::join(above, ", "));
}

} // namespace

Claim claim_solid_vs_hollow() {
    Claim claim;
    claim.name = "solid-vs-hollow";
    claim.statement = "A solid orb inverts what lies behind it, a hollow one does not.";
    claim.experiments = [](const ClaimContext &context) {
        return std::vector{view_experiment(context, "solid"),    view_experiment(context, "hollow"),
                           map_experiment(context, "solid"),     map_experiment(context, "hollow"),
                           picture_experiment(context, "solid"), picture_experiment(context, "hollow")};
    };
    claim.summary = [](const ClaimContext &, Verdict verdict) {
        switch (verdict) {
        case Verdict::holds:
            return "Seen through the solid orb the robe stands on its head; through the hollow orb it stays upright "
                   "and "
                   "nearly in place. Every renderer shows it, and each agrees with exact optics.";
        case Verdict::fails:
            return "Some renderer, or exact optics itself, contradicts the statement for this scene.";
        case Verdict::undecided:
            return "The renders do not settle the statement yet.";
        }
        return "";
    };
    claim.notes = [](const ClaimContext &context) {
        std::vector<std::string> notes;
        const Experiment solid = context.experiment("", "", "solid", {}, {}),
                         hollow = context.experiment("", "", "hollow", {}, {});
        const OrbInScene ball = orb_of(solid.scene), shell = orb_of(hollow.scene);
        const auto distances = [](const Scene &scene, const OrbInScene &orb) {
            return std::pair(glm::length(scene.camera.eye_mm - orb.centre_mm),
                             std::abs(orb.centre_mm.z - card_of(scene).centre_mm.z));
        };
        const auto [eye, plane] = distances(solid.scene, ball);
        if (const auto index = optics::critical_inversion_index(ball.optics.outer_mm, eye, plane))
            notes.push_back(fmt::format("It flips at an index of {:.4f}: a solid orb inverts this plane only above it "
                                        "(here {:g}), not at every index denser than air.{}",
                                        *index, ball.optics.index, materials_above(*index)));
        if (const auto magnification = optics::image_magnification(ball.optics, eye, plane))
            notes.push_back(
                fmt::format("The solid orb shows the plane {:.3f} times its size on the axis (negative: inverted).",
                            *magnification));
        if (const auto where = optics::plane_where_magnifying_ends(ball.optics, eye))
            notes.push_back(fmt::format("It magnifies planes nearer than {:.4g} mm behind its centre and reduces those "
                                        "farther away (here {:g} mm).",
                                        *where, plane));
        const auto [shell_eye, shell_plane] = distances(hollow.scene, shell);
        const double slope = optics::paraxial_slope(shell.optics, shell_eye, shell_plane);
        notes.push_back(
            fmt::format("The hollow orb's slope on the axis is {:.4f}: {}, and shown {:.3f} times its size.", slope,
                        slope > 0 ? "upright" : "inverted", std::abs(1 / slope)));
        return notes;
    };
    claim.mutant = Fault::index_one_percent;
    return claim;
}

} // namespace threefold
