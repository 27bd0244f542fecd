// SPDX-License-Identifier: MIT
// "The glass darkens the robe behind it": the study lets 0.89 of the light through each surface. With coated glass the
// tint stands alone, tau^4 on a path of four surfaces; with real glass Fresnel's losses join it and grow to the rim.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "verifier/claims/claim.h"
#include "verifier/claims/flip.h"
#include "verifier/claims/orb_light.h"
#include "verifier/claims/orb_marks.h"
#include "verifier/claims/scope_bounds.h"
#include "verifier/measure/dark_line.h"
#include "verifier/measure/optical_map.h"
#include "verifier/measure/radiance.h"

namespace threefold {

namespace {

constexpr double centre_share = 0.2;                                ///< of the radius: "the centre" is within it
constexpr double rim_ring_share = 0.88, rim_ring_half_share = 0.02; ///< "towards the rim": a ring about it
constexpr double clear_most = 0.95; ///< of the hollow's radius: beyond it rays are flung aside
constexpr double beside_share = 1.02;
constexpr double least_difference = 0.006; ///< of a brightness, that matters here

const std::string through_centre = "brightness of the card through the centre, over the card beside the orb";
const std::string through_ring = "brightness of the card towards the rim, over the card beside the orb";
const std::string tint_darkens = "darkening by the tint alone, at the centre";
const std::string rim_darker = "brightness towards the rim over that at the centre";

/// The regions of the picture, by impact parameter.
struct Regions {
    double centre_mm, ring_from_mm, ring_to_mm, beside_mm;
};

Regions regions_of(const OrbInScene &orb) {
    const double radius = orb.optics.outer_mm;
    const double to = std::min((rim_ring_share + rim_ring_half_share) * radius, clear_most * orb.optics.inner_mm);
    return {std::min(centre_share * radius, to / 3), to - 2 * rim_ring_half_share * radius, to, beside_share * radius};
}

int region(const Regions &r, double b) {
    if (b < r.centre_mm) return 0;
    if (b > r.ring_from_mm && b < r.ring_to_mm) return 1;
    return b > r.beside_mm ? 2 : -1;
}

struct Ratios {
    double centre, ring;
};

/// Behind coated glass each region is one plateau: its median is not moved by a ray that was lost between two
/// triangles.
Ratios plateaus_of(const Image &image, const Camera &camera, const OrbInScene &orb) {
    const Regions regions = regions_of(orb);
    std::array<std::vector<double>, 3> values;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const Ray ray = camera_ray(camera, pixel_sample(camera, column, row));
            const int k = region(regions, impact_parameter(ray, orb.centre_mm));
            const Rgb &p = image.at(column, row);
            if (k >= 0) values[static_cast<std::size_t>(k)].push_back((p.r + p.g + p.b) / 3);
        }
    const double beside = quantile(std::move(values[2]), 0.5);
    return {quantile(std::move(values[0]), 0.5) / beside, quantile(std::move(values[1]), 0.5) / beside};
}

Ratios ratios_of(const Image &image, const Camera &camera, const OrbInScene &orb) {
    const Regions regions = regions_of(orb);
    const auto means = ring_means(image, 3, [&](int column, int row) {
        return region(regions, impact_parameter(camera_ray(camera, pixel_sample(camera, column, row)), orb.centre_mm));
    });
    return {means[0] / means[2], means[1] / means[2]};
}

/// The same regions of the picture that the closed form would take.
Ratios exact_ratios(const Scene &scene, const Camera &camera, const OrbInScene &orb) {
    const Regions regions = regions_of(orb);
    Image image(camera.image_width_px(), camera.image_height_px());
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const Ray ray = camera_ray(camera, pixel_sample(camera, column, row));
            const double b = impact_parameter(ray, orb.centre_mm);
            const int k = region(regions, b);
            if (k >= 0) image.at(column, row) = Rgb(predicted_radiance(scene, orb, ray));
        }
    return ratios_of(image, camera, orb);
}

/// So large that every straight path of the regions ends on it: what it sends elsewhere is counted, ray by ray.
double card_half_width(const Scene &scene) {
    const OrbInScene orb = orb_of(scene);
    const Quad &card = card_of(scene);
    const double eye = scene.camera.eye_mm.z, plane = -card.centre_mm.z;
    double farthest = 2 * std::abs(optics::straight_landing(orb.optics.outer_mm, eye, plane));
    for (const double share : {0.5, 1.0}) {
        const double b = share * regions_of(orb).ring_to_mm;
        if (const auto landed = optics::landing(orb.optics, optics::impact_at(orb.optics, b), eye, plane))
            farthest = std::max(farthest, 1.3 * std::abs(*landed));
    }
    return farthest;
}

double contrast_criterion(const ExperimentRecord &record) {
    return std::stod(record.parameters.at("criterion.contrast"));
}

Experiment card_experiment(const ClaimContext &context, const std::string &name, const std::string &title,
                           std::string_view coating, const std::vector<Assignment> &more) {
    const std::string size = context.quick ? "64" : "96";
    std::vector<Assignment> fixed{assign("glass.coating", coating), assign("card.surface", "plain"),
                                  assign("card.radiance", "1"),     assign("environment.radiance", "0"),
                                  assign("orb.shift_mm", "0"),      assign("image.orb_share", "0.9"),
                                  assign("image.width_px", size),   assign("image.height_px", size)};
    fixed.insert(fixed.end(), more.begin(), more.end());
    const Scene plan = context.experiment("", "", "tint", {}, fixed).scene;
    fixed.push_back(assign("card.half_width_mm", card_half_width(plan)));
    Experiment e = context.experiment(name, title, "tint", {}, fixed);
    e.sampling = Sampling::pixel_centres;
    e.samples_per_pixel = coating == "fresnel" ? (context.quick ? 40 : 48) : 1;
    e.shift_replicates = true;
    e.surface_tolerance_mm = 1e-4 * orb_of(e.scene).optics.outer_mm;
    e.draw = [orb = orb_of(e.scene)](const Image &, const Camera &camera) {
        const Regions r = regions_of(orb);
        return std::vector{impact_circle(camera, orb, r.centre_mm, Mark::Meaning::measured, "centre"),
                           impact_circle(camera, orb, r.ring_from_mm, Mark::Meaning::measured, ""),
                           impact_circle(camera, orb, r.ring_to_mm, Mark::Meaning::measured, "towards the rim")};
    };
    return e;
}

/// Coated glass: the tint alone. `side`: on which side of the criterion the darkening is claimed to lie.
Experiment alone(const ClaimContext &context, const std::string &name, const std::string &title, Relation side,
                 const std::vector<Assignment> &more) {
    Experiment e = card_experiment(context, name, title, "antireflective", more);
    const Scene scene = e.scene;
    const OrbInScene orb = orb_of(scene);
    const double least = contrast_criterion(e.record), through = std::pow(orb.glass.interface_transmittance, 4);
    e.predict = [=](const Accuracy &a) {
        const std::vector<BudgetItem> budget{{"quantisation", 4 * a.radiance_step, "a ratio of two stored radiances"},
                                             {"arithmetic", 2e-6, "products of a few shares in single precision"}};
        return std::vector<Expected>{{through_centre, "", Relation::equal, through, budget, true},
                                     {through_ring, "", Relation::equal, through, budget, true},
                                     {tint_darkens, "", side, least, {}}};
    };
    e.measure = [=](const Image &image, const Camera &camera) {
        const Ratios r = plateaus_of(image, camera, orb);
        return std::vector<Reading>{{through_centre, r.centre}, {through_ring, r.ring}, {tint_darkens, 1 - r.centre}};
    };
    return e;
}

Experiment with_reflections(const ClaimContext &context) {
    Experiment e = card_experiment(context, "tint-glass", "a white card in the dark through tinted glass that reflects",
                                   "fresnel", {});
    const Scene scene = e.scene;
    const OrbInScene orb = orb_of(scene);
    const Ratios exact = exact_ratios(scene, scene.camera, orb);
    e.predict = [=](const Accuracy &a) {
        const Regions r = regions_of(orb);
        const auto budget = [&](double value, double from, double to) {
            const double dropped =
                a.cuts_whole_trees ? 2 * a.cut_weight : mean_missing_weight(orb, from, to, a.cut_weight);
            return std::vector<BudgetItem>{
                {"quantisation", 4 * a.radiance_step, "a ratio of two stored radiances"},
                {"truncation", dropped, "what cut ray trees lose in these rings, computed"},
                {"resolution", least_difference * value,
                 "0.6 %: the least difference that matters here; one surface without its tint is 12 %"}};
        };
        return std::vector<Expected>{
            {through_centre, "", Relation::equal, exact.centre, budget(exact.centre, 0, r.centre_mm), true},
            {through_ring, "", Relation::equal, exact.ring, budget(exact.ring, r.ring_from_mm, r.ring_to_mm), true},
            {rim_darker, "", Relation::below, 1 - least_difference, {}}};
    };
    e.measure = [=](const Image &image, const Camera &camera) {
        // The closed form along the same rays takes out where the pixels of a replicate happen to lie.
        const Ratios r = ratios_of(image, camera, orb), here = exact_ratios(scene, camera, orb);
        const double centre = r.centre - here.centre + exact.centre, ring = r.ring - here.ring + exact.ring;
        return std::vector<Reading>{{through_centre, centre}, {through_ring, ring}, {rim_darker, ring / centre}};
    };
    return e;
}

std::optional<FlipPoint> tint_flip_of(const ClaimContext &context) {
    const Experiment e = context.experiment("", "", "tint", {}, {});
    const double least = contrast_criterion(e.record);
    const auto value = root_between([&](double tau) { return 1 - std::pow(tau, 4) - least; }, 0.01, 1);
    if (!value || *value >= 1) return std::nullopt;
    return FlipPoint{"glass.interface_transmittance",
                     "",
                     *value,
                     orb_of(e.scene).glass.interface_transmittance,
                     fmt::format("above it the tint of four surfaces darkens by less than {:g} %", 100 * least),
                     {"tint-flip-below", "tint-flip-above"}};
}

/// Mean radiance of the card of 1 over a region, by area, all orders; through a point of the pupil, which is focused at
/// the orb's centre.
double mean_over(const Scene &scene, const OrbInScene &orb, double from_mm, double to_mm, const LightModel &model,
                 Vec2 aside_mm = Vec2(0)) {
    constexpr int circles = 6, azimuths = 24; // the card is square: outer orders miss it between its corners
    const CameraFrame frame = camera_frame(scene.camera);
    const double focus = glm::dot(orb.centre_mm - scene.camera.eye_mm, frame.forward);
    double sum = 0, weights = 0;
    for (int k = 0; k < circles; ++k)
        for (int j = 0; j < azimuths; ++j) {
            const double b = from_mm + (to_mm - from_mm) * (k + 0.5) / circles;
            const double azimuth = 2 * std::numbers::pi * (j + 0.5) / azimuths;
            const auto ray = ray_past(scene.camera, orb.centre_mm, b, azimuth);
            sum += b * predicted_radiance(scene, orb, from_pupil(*ray, frame, aside_mm, focus), model);
            weights += b;
        }
    return sum / weights;
}

std::vector<ScopeNumber> tint_scope(const ClaimContext &context, const ScopeSettings &settings) {
    const Experiment glass = with_reflections(context), coated = alone(context, "", "", Relation::above, {});
    const Scene &scene = glass.scene;
    const OrbInScene orb = orb_of(scene);
    const Regions r = regions_of(orb);
    const auto centre = [&](const OrbInScene &o, const LightModel &model, Vec2 aside) {
        return mean_over(scene, o, 0, r.centre_mm, model, aside);
    };
    const auto ring = [&](const OrbInScene &o, const LightModel &model, Vec2 aside) {
        return mean_over(scene, o, r.ring_from_mm, r.ring_to_mm, model, aside);
    };
    // The mean of two polarisations of a ratio is not the ratio of the means: each is carried on its own.
    const auto ratio = [&](const OrbInScene &o, const LightModel &model, Vec2 aside) {
        return ring(o, model, aside) / centre(o, model, aside);
    };
    const double leg = optics::glass_leg_mm(orb.optics, optics::impact_at(orb.optics, r.ring_to_mm));
    std::vector<ScopeNumber> numbers;
    for (const std::string &quantity : {through_centre, through_ring}) {
        const Expected row = expected_row(glass, quantity);
        const bool at_centre = quantity == through_centre;
        numbers.push_back(
            {quantity, "", row.value, total(row.budget), margin_is_tolerance,
             at_centre ? of_light(scene, orb, settings, leg, centre) : of_light(scene, orb, settings, leg, ring)});
    }
    const double here = ratio(orb, {}, Vec2(0));
    EffectBounds of_ratio = of_light(scene, orb, settings, leg, ratio);
    const double truth = carried([&](const LightModel &m) { return ring(orb, m, Vec2(0)); }) /
                         carried([&](const LightModel &m) { return centre(orb, m, Vec2(0)); });
    of_ratio.polarisation = {
        std::abs(truth - here),
        fmt::format("s and p keep apart in the ring and at the centre: {:.4g} in place of {:.4g}", truth, here)};
    numbers.push_back({rim_darker, "", here, margin_to(here, {1 - least_difference}),
                       margin_words({1 - least_difference}, ""), of_ratio});

    // Coated: nothing is reflected, so that only the tint and what the glass absorbs are left.
    const double least = contrast_criterion(coated.record), tint = std::pow(orb.glass.interface_transmittance, 4);
    const double lost = 1 - std::exp(-2 * settings.absorption_per_mm * orb.optics.wall_mm);
    const LitBounds lit = nothing_is_lit(coated.scene);
    const char *alike = "coated glass reflects neither polarisation at any index: the tint stands alone, as a factor";
    numbers.push_back(
        {tint_darkens, "", 1 - tint, margin_to(1 - tint, {least}), margin_words({least}, ""),
         EffectBounds{.polarisation = Bound::none(alike),
                      .dispersion = Bound::none(alike),
                      .absorption = {tint * lost, fmt::format("twice through the wall, exp(-{:g} per mm x {:g} mm)",
                                                              settings.absorption_per_mm, 2 * orb.optics.wall_mm)},
                      .birefringence = Bound::none(alike),
                      .light_size = lit.light_size,
                      .caustics = lit.caustics,
                      .interreflection = lit.interreflection,
                      .pupil = Bound::none("the card is alike all over and the tint the same in every direction")}});
    return numbers;
}

} // namespace

Claim claim_tint() {
    Claim claim;
    claim.name = "tint";
    claim.statement = "Tinted glass darkens what is seen through a hollow orb by the fourth power of what one surface "
                      "lets through, and glass reflects more towards its rim.";
    claim.experiments = [](const ClaimContext &context) {
        std::vector all{
            alone(context, "tint-alone", "a white card in the dark through tinted, coated glass", Relation::above, {}),
            with_reflections(context)};
        if (const auto flip = tint_flip_of(context))
            for (const BracketSide &side : bracket_of(flip->value))
                all.push_back(alone(context, fmt::format("tint-flip-{}", side.label),
                                    fmt::format("an interface transmittance just {} the flip point", side.label),
                                    side.label == "below" ? Relation::above : Relation::below,
                                    {assign("glass.interface_transmittance", std::min(side.value, 1.0))}));
        return all;
    };
    claim.summary = [](const ClaimContext &context, Verdict verdict) -> std::string {
        const double tau = orb_of(context.experiment("", "", "tint", {}, {}).scene).glass.interface_transmittance;
        switch (verdict) {
        case Verdict::holds:
            return fmt::format("The tint alone leaves {:.1f} % of the robe's light, everywhere in the hollow; the "
                               "reflections of the glass take more, and most towards the rim.",
                               100 * std::pow(tau, 4));
        case Verdict::fails:
            return fmt::format("At {:g} a surface the tint does not darken as stated (it leaves {:.1f} %), or some "
                               "renderer shows another brightness.",
                               tau, 100 * std::pow(tau, 4));
        case Verdict::undecided:
            return "It is not settled how much the tint darkens the robe.";
        }
        return "";
    };
    claim.notes = [](const ClaimContext &context) {
        const OrbInScene orb = orb_of(context.experiment("", "", "tint", {}, {}).scene);
        const Regions r = regions_of(orb);
        const double b = 0.5 * (r.ring_from_mm + r.ring_to_mm), tint = std::pow(orb.glass.interface_transmittance, 4);
        const auto at = [&](double impact) {
            return *optics::path_transmittance(orb.optics, optics::impact_at(orb.optics, impact));
        };
        return std::vector<std::string>{
            fmt::format("The straight path alone carries {:.3f} of the light at the centre and {:.3f} at {:.2f} of the "
                        "radius: {:.3f} by the tint, {:.3f} and {:.3f} by Fresnel.",
                        tint * at(0).unpolarised, tint * at(b).unpolarised, b / orb.optics.outer_mm, tint,
                        at(0).unpolarised, at(b).unpolarised),
            fmt::format(
                "Renderers take light as unpolarised anew at every surface. Every surface of an orb has the same "
                "plane of incidence, so the truth at {:.2f} of the radius is {:.3f} instead of {:.3f} before "
                "the tint, {:.1f} % brighter: an error that all renderers share and no comparison of them "
                "shows.",
                b / orb.optics.outer_mm, at(b).polarised, at(b).unpolarised,
                100 * (at(b).polarised / at(b).unpolarised - 1))};
    };
    claim.flips = [](const ClaimContext &context) {
        const auto flip = tint_flip_of(context);
        return flip ? std::vector{*flip} : std::vector<FlipPoint>{};
    };
    claim.scope = tint_scope;
    claim.mutant = Fault::inner_surface_missing;
    return claim;
}

} // namespace threefold
