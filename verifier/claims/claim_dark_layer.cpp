// SPDX-License-Identifier: MIT
// "At a thick wall a dark layer cuts the folds": the totally reflecting rim, which shows the surroundings instead of
// the robe. Its rays are turned outwards (by up to 2 acos(r/R) less twice the wall's angle), so that this is true only
// of a robe that ends near the orb: where it stops being true is the second flip point.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "verifier/claims/claim.h"
#include "verifier/claims/flip.h"
#include "verifier/claims/orb_light.h"
#include "verifier/claims/orb_marks.h"
#include "verifier/claims/scope_bounds.h"
#include "verifier/measure/radiance.h"

namespace threefold {

namespace {

constexpr double layer_from = 0.15, layer_to = 0.6; ///< of the rim's width, from the hollow outwards: what is measured
constexpr double beside_from = 1.004, beside_to = 1.012; ///< of the orb's radius: the robe beside it
constexpr double film_orb_share = 0.9;
constexpr int layer_rows_px = 16, layer_margin_px = 2, columns_fine = 32;
constexpr double least_layer_px = 4; ///< the measured part of the rim is at least so wide

const std::string layer_radiance = "radiance of the layer, over the robe's";
const std::string contrast = "contrast of the layer against the robe beside it";
const std::string contrast_seen = "contrast of the layer: darker, and seen";
const std::string own_share = "share of the surroundings in the layer's light";
const std::string shows_surroundings = "the layer shows the surroundings more than the robe";

struct Band {
    double from_mm, to_mm;
};

Band layer_of(const OrbInScene &orb) {
    const double width = optics::rim_width(orb.optics), inner = orb.optics.inner_mm;
    return {inner + layer_from * width, inner + layer_to * width};
}

Band beside(const OrbInScene &orb) { return {beside_from * orb.optics.outer_mm, beside_to * orb.optics.outer_mm}; }

double radius_px(const Camera &camera, const OrbInScene &orb, double impact_mm) {
    return impact_circle(camera, orb, impact_mm, Mark::Meaning::expected, "").radius_px;
}

struct Radiances {
    double layer, robe;
};

Radiances radiances_of(const Image &image, const Camera &camera, const OrbInScene &orb) {
    const Band layer = layer_of(orb), robe = beside(orb);
    const auto means = ring_means(image, 2, [&](int column, int row) {
        const double b = impact_parameter(camera_ray(camera, pixel_sample(camera, column, row)), orb.centre_mm);
        if (b > layer.from_mm && b < layer.to_mm) return 0;
        return b > robe.from_mm && b < robe.to_mm ? 1 : -1;
    });
    return {means[0], means[1]};
}

/// Whether the robe is what stands beside the orb, in all that is measured of it.
bool robe_stands_beside(const Scene &scene, const OrbInScene &orb) {
    const Camera &camera = scene.camera;
    const Band robe = beside(orb);
    const Quad &card = card_of(scene);
    const Vec3 normal = glm::cross(card.half_u_mm, card.half_v_mm);
    for (int row = 0; row < camera.image_height_px(); ++row)
        for (int column = 0; column < camera.image_width_px(); ++column) {
            const Ray ray = camera_ray(camera, pixel_sample(camera, column, row));
            const double b = impact_parameter(ray, orb.centre_mm);
            if (!(b > robe.from_mm && b < robe.to_mm)) continue;
            const auto landed = optics::landing_on_plane(ray, card.centre_mm, normal);
            if (!landed || !on_card(card, *landed)) return false;
        }
    return true;
}

/// By how much of its light the layer shows the surroundings: along the rays of a picture, or (`fine` > 1) over all its
/// columns, as many replicates see them.
double exact_share(const Scene &scene, const Camera &camera, const OrbInScene &orb, int fine = 1,
                   const LightModel &model = {}, Vec2 pupil_mm = Vec2(0)) {
    const CameraFrame frame = camera_frame(camera);
    const double focus = glm::dot(orb.centre_mm - camera.eye_mm, frame.forward);
    const Band layer = layer_of(orb);
    Scene probe = scene; // surroundings of 1 behind a black robe
    probe.environment = Environment{Rgb(1)};
    for (Object &object : probe.objects)
        if (Quad *quad = std::get_if<Quad>(&object.shape)) quad->surface = Emissive{Rgb(0)};
    double sum = 0, count = 0;
    for (int row = 0; row < camera.image_height_px(); ++row)
        for (int column = 0; column < camera.image_width_px() * fine; ++column) {
            const Vec2 at((column + 0.5) / fine, row + 0.5);
            const Ray ray = camera_ray(camera, at + camera.film_offset_px);
            const double b = impact_parameter(ray, orb.centre_mm);
            if (!(b > layer.from_mm && b < layer.to_mm)) continue;
            sum += predicted_radiance(probe, orb, from_pupil(ray, frame, pupil_mm, focus), model);
            count += 1;
        }
    return sum / count;
}

double grey_environment(const Scene &scene) { return scene.environment ? scene.environment->radiance.r : 0; }
double robe_radiance(const Scene &scene) {
    const Emissive *surface = std::get_if<Emissive>(&card_of(scene).surface);
    const Rgb *colour = surface ? std::get_if<Rgb>(&surface->radiance) : nullptr;
    return colour ? colour->r : std::numeric_limits<double>::quiet_NaN();
}

/// The right edge of the orb, so magnified that the measured part of the rim has `least_layer_px` columns, and the robe
/// beside it enough that some pixels' centres lie in it.
void look_at_the_rim(Camera &camera, const OrbInScene &orb) {
    const Band layer = layer_of(orb), robe = beside(orb);
    constexpr double least_robe_px = 1.5;
    const double px_per_mm = std::max(least_layer_px / (layer.to_mm - layer.from_mm),
                                      robe.to_mm > robe.from_mm ? least_robe_px / (robe.to_mm - robe.from_mm) : 0.0);
    const double orb_px = px_per_mm * orb.optics.outer_mm;
    camera.width_px = camera.height_px =
        2 * static_cast<int>(std::clamp(std::ceil(orb_px / film_orb_share), 64.0, 1e7));
    const int left = static_cast<int>(camera.width_px / 2.0 + radius_px(camera, orb, layer.from_mm)) - layer_margin_px;
    const int right =
        static_cast<int>(camera.width_px / 2.0 + radius_px(camera, orb, robe.to_mm)) + 1 + layer_margin_px;
    camera.crop =
        Crop{left, (camera.height_px - layer_rows_px) / 2, std::min(right, camera.width_px) - left, layer_rows_px};
}

std::vector<Assignment> plain(const std::vector<Assignment> &more) {
    std::vector<Assignment> all{assign("card.surface", "plain"), assign("glass.coating", "fresnel"),
                                assign("glass.interface_transmittance", "1"), assign("orb.shift_mm", "0"),
                                assign("image.orb_share", film_orb_share)};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

/// The study's robe, or a wider one where the orb would hide that: unless asked otherwise, it ends beside the orb.
Assignment robe_beside(const ClaimContext &context) {
    constexpr double robe_over_hidden = 1.14;
    const Scene study = context.experiment("", "", "dark-layer", {}, {}).scene;
    const OrbInScene orb = orb_of(study);
    const Quad &card = card_of(study);
    const double eye = study.camera.eye_mm.z - orb.centre_mm.z, radius = orb.optics.outer_mm;
    const double hidden =
        radius / std::sqrt((eye - radius) * (eye + radius)) * (study.camera.eye_mm.z - card.centre_mm.z);
    return assign("card.half_width_mm", std::max(glm::length(card.half_u_mm), robe_over_hidden * hidden));
}

Experiment base(const ClaimContext &context, const std::string &name, const std::string &title,
                const std::vector<Assignment> &more) {
    Experiment e = context.experiment(name, title, "dark-layer", {robe_beside(context)}, plain(more));
    const OrbInScene orb = orb_of(e.scene);
    look_at_the_rim(e.scene.camera, orb);
    e.sampling = Sampling::pixel_centres;
    e.samples_per_pixel = context.quick ? 16 : 64;
    e.shift_replicates = true;
    e.surface_tolerance_mm = 0.005 * orb.optics.wall_mm;
    e.draw = [orb](const Image &, const Camera &camera) {
        const Band layer = layer_of(orb);
        return std::vector{
            impact_circle(camera, orb, orb.optics.inner_mm, Mark::Meaning::expected, "hollow"),
            impact_circle(camera, orb, orb.optics.outer_mm, Mark::Meaning::expected, "orb"),
            impact_circle(camera, orb, layer.from_mm, Mark::Meaning::measured, "measured"),
            impact_circle(camera, orb, layer.to_mm, Mark::Meaning::measured, ""),
        };
    };
    return e;
}

/// What the closed form cannot foresee of a share of light in the layer.
std::vector<BudgetItem> share_budget(const Scene &scene, const OrbInScene &orb, const Accuracy &a) {
    const Band layer = layer_of(orb);
    const double missing =
        a.cuts_whole_trees ? 2 * a.cut_weight : mean_missing_weight(orb, layer.from_mm, layer.to_mm, a.cut_weight);
    const double least = std::max(robe_radiance(scene), 1e-6);
    return {{"quantisation", 4 * a.radiance_step / least, "stored radiances, over the robe's"},
            {"truncation", missing, "what cut ray trees lose in the rim, computed"},
            {"tessellation", 2 * a.surface_mm / (layer.to_mm - layer.from_mm),
             "which rays reach the robe, where the rendered spheres are not the true ones"},
            {"resolution", 0.002, "0.2 % of the light: the least difference that matters here"}};
}

double layer_criterion(const ExperimentRecord &record) { return std::stod(record.parameters.at("criterion.contrast")); }

/// `claimed`: on which side of the criterion the contrast is claimed to lie.
Experiment layer(const ClaimContext &context, const std::string &name, const std::string &title, Relation claimed,
                 const std::vector<Assignment> &more) {
    Experiment e = base(context, name, title, more);
    const Scene scene = e.scene;
    const OrbInScene orb = orb_of(scene);
    const double share = exact_share(scene, scene.camera, orb, columns_fine), least = layer_criterion(e.record);
    const double surroundings = grey_environment(scene) / robe_radiance(scene);
    const double expected = share * surroundings + 1 - share;
    const bool readable = robe_stands_beside(scene, orb);
    e.predict = [=](const Accuracy &a) {
        std::vector<BudgetItem> budget = share_budget(scene, orb, a);
        for (BudgetItem &item : budget)
            if (item.name != "quantisation" && item.name != "truncation") item.value *= std::abs(1 - surroundings);
        return std::vector<Expected>{{layer_radiance, "", Relation::equal, expected, budget, true},
                                     {contrast, "", Relation::equal, 1 - expected, budget, true},
                                     {contrast_seen, "", claimed, least, {}}};
    };
    e.measure = [=](const Image &image, const Camera &camera) {
        Radiances r = radiances_of(image, camera, orb);
        if (!readable) r.robe = std::numeric_limits<double>::quiet_NaN();
        const double here = exact_share(scene, camera, orb);
        const double value = r.layer / r.robe - (here - share) * (surroundings - 1);
        return std::vector<Reading>{{layer_radiance, value}, {contrast, 1 - value}, {contrast_seen, 1 - value}};
    };
    return e;
}

/// The same layer in darkness and in surroundings as bright as the robe, or brighter: what the layer gains is theirs.
Experiment proportional(const ClaimContext &context) {
    const Scene plan = context.experiment("", "", "dark-layer", {}, plain({})).scene;
    const double before = grey_environment(plan), step = std::max(before, 0.1 * robe_radiance(plan));
    Experiment e = base(context, "layer-brighter", "the same rim in brighter surroundings",
                        {assign("environment.radiance", before + step)});
    const Scene scene = e.scene;
    const OrbInScene orb = orb_of(scene);
    const double share = exact_share(scene, scene.camera, orb, columns_fine);
    e.predict = [=](const Accuracy &a) {
        std::vector<BudgetItem> budget = share_budget(scene, orb, a);
        for (BudgetItem &item : budget)
            if (item.name == "quantisation") item.value *= 2 * robe_radiance(scene) / step;
        for (BudgetItem &item : budget)
            if (item.name == "resolution") {
                item.value = 0.01;
                item.reason = "1 %: the least difference that matters here";
            }
        return std::vector<Expected>{{own_share, "", Relation::equal, share, budget, true},
                                     {shows_surroundings, "", Relation::above, 0.5, {}}};
    };
    e.partner = "layer";
    e.measure_pair = [=](const Image &image, const Image &dimmer, const Camera &camera) {
        const double gained = (radiances_of(image, camera, orb).layer - radiances_of(dimmer, camera, orb).layer) / step;
        const double value = gained - exact_share(scene, camera, orb) + share;
        return std::vector<Reading>{{own_share, value}, {shows_surroundings, value}};
    };
    return e;
}

std::optional<FlipPoint> brightness_flip(const ClaimContext &context) {
    const Experiment e = base(context, "", "", {});
    const OrbInScene orb = orb_of(e.scene);
    const double share = exact_share(e.scene, e.scene.camera, orb, columns_fine), robe = robe_radiance(e.scene);
    // robe (1 - share) + surroundings * share = (1 - criterion) robe
    const double value = robe * (1 - layer_criterion(e.record) / share);
    if (!(value > 0) || !std::isfinite(value)) return std::nullopt;
    return FlipPoint{"environment.radiance",
                     "",
                     value,
                     grey_environment(e.scene),
                     fmt::format("in brighter surroundings the layer is not darker than the robe by {:g} %",
                                 100 * layer_criterion(e.record)),
                     {"layer-flip-below", "layer-flip-above"}};
}

/// The half width of the robe at which half of the layer's light comes from it: by area, on the horizontal through the
/// orb's centre, where the crop is.
std::optional<FlipPoint> width_flip(const ClaimContext &context) {
    const Experiment e = base(context, "", "", {});
    const OrbInScene orb = orb_of(e.scene);
    const Quad &card = card_of(e.scene);
    const Camera &camera = e.scene.camera;
    const Vec3 across = glm::cross(card.half_u_mm, card.half_v_mm);
    struct Arrival {
        double width_mm, weight;
    };
    std::vector<Arrival> arrivals;
    double all = 0;
    for (int row = 0; row < camera.image_height_px(); ++row)
        for (int column = 0; column < camera.image_width_px(); ++column)
            for (int fine = 0; fine < columns_fine; ++fine) { // as a pixel is seen by replicates that are shifted
                const Ray ray = camera_ray(camera, Vec2(column + (fine + 0.5) / columns_fine, row + 0.5));
                const double b = impact_parameter(ray, orb.centre_mm);
                const Band band = layer_of(orb);
                if (!(b > band.from_mm && b < band.to_mm)) continue;
                all += 1;
                for (const ExitRay &exit : exit_rays(orb, ray, 1e-4))
                    if (const auto met = optics::landing_on_plane(exit.ray, card.centre_mm, across))
                        arrivals.push_back({std::max(std::abs(met->x), std::abs(met->y)), exit.weight});
            }
    std::ranges::sort(arrivals, {}, &Arrival::width_mm);
    double sum = 0, before = 0;
    for (const Arrival &a : arrivals) {
        if (sum + a.weight >= all / 2) {
            const double value = std::midpoint(before, a.width_mm);
            return FlipPoint{"card.half_width_mm",
                             "mm",
                             value,
                             glm::length(card.half_u_mm),
                             "before a wider robe the layer shows more of the robe than of the surroundings",
                             {"layer-robe-below", "layer-robe-above"}};
        }
        sum += a.weight;
        before = a.width_mm;
    }
    return std::nullopt;
}

/// A robe just narrower or wider than the flip point, black, in surroundings of 1: the layer's radiance is their share.
Experiment robe_width(const ClaimContext &context, const BracketSide &side) {
    const bool below = side.label == "below";
    Experiment e = base(
        context, fmt::format("layer-robe-{}", side.label),
        fmt::format("a black robe just {} than the flip point, in white surroundings", below ? "narrower" : "wider"),
        {assign("card.half_width_mm", side.value), assign("card.radiance", "0"), assign("environment.radiance", "1")});
    e.samples_per_pixel = context.quick ? 48 : 96;
    const Scene scene = e.scene;
    const OrbInScene orb = orb_of(scene);
    const double share = exact_share(scene, scene.camera, orb, columns_fine);
    e.predict = [=](const Accuracy &a) {
        std::vector<BudgetItem> budget = share_budget(scene, orb, a);
        for (BudgetItem &item : budget) {
            if (item.name == "quantisation") item.value = 2 * a.radiance_step;
            if (item.name == "resolution") item.value = 0.005;
        }
        return std::vector<Expected>{{own_share, "", Relation::equal, share, budget},
                                     {shows_surroundings, "", below ? Relation::above : Relation::below, 0.5, {}}};
    };
    e.measure = [=](const Image &image, const Camera &camera) {
        const double value = radiances_of(image, camera, orb).layer - exact_share(scene, camera, orb) + share;
        return std::vector<Reading>{{own_share, value}, {shows_surroundings, value}};
    };
    return e;
}

/// `doubled`: with twice the wall of `context`.
std::vector<ScopeNumber> scope_of(const ClaimContext &context, const ClaimContext &doubled,
                                  const ScopeSettings &settings) {
    constexpr int fine = 2;
    std::vector<ScopeNumber> numbers;
    for (const bool thick : {true, false}) {
        const Experiment e = base(thick ? doubled : context, "", "", {});
        const OrbInScene orb = orb_of(e.scene);
        const double surroundings = grey_environment(e.scene) / robe_radiance(e.scene), gain = 1 - surroundings;
        const double least = layer_criterion(e.record);
        const auto share = [&](const OrbInScene &o, const LightModel &model, Vec2 aside) {
            return exact_share(e.scene, e.scene.camera, o, fine, model, aside);
        };
        const double here = share(orb, {}, Vec2(0)),
                     leg = optics::glass_leg_mm(orb.optics, optics::impact_at(orb.optics, layer_of(orb).from_mm));
        const EffectBounds of_share = of_light(e.scene, orb, settings, leg, share);
        EffectBounds of_contrast = of_share;
        for (const EffectEntry &entry : effects()) of_contrast.of(entry.effect).value *= std::abs(gain);
        // Lost light darkens the layer whatever it shows: by at most all of what the orders lose.
        const double lost = -std::expm1(-4 * settings.absorption_per_mm * leg) * std::max(1.0, surroundings);
        of_contrast.absorption = {lost, fmt::format("the layer's light goes through {:.3g} mm of glass and, reflected "
                                                    "within, again: at most {:.2g} of it is lost",
                                                    2 * leg, lost)};
        const std::string wall = fmt::format(", wall {:g} mm", orb.optics.wall_mm);
        const double value = here * gain;
        numbers.push_back(
            {contrast + wall, "", value, margin_to(value, {least}), margin_words({least}, ""), of_contrast});
        if (thick)
            numbers.push_back({own_share + wall, "", here, margin_to(here, {0.5}), margin_words({0.5}, ""), of_share});
    }
    return numbers;
}

/// The run's scene with a thin wall, and with one twice as thick.
struct Walls {
    ClaimContext thin, thick;
};

} // namespace

Claim claim_dark_layer() {
    Claim claim;
    claim.name = "dark-layer";
    claim.statement = "Before a robe that ends near the orb, the totally reflecting rim of a thick wall is a dark "
                      "layer: it shows the dim surroundings instead of the robe.";
    // The rim of the thick wall, twice the run's own, and that of the wall itself.
    const auto walls = [](const ClaimContext &context) {
        const optics::Orb<double> orb = orb_of(context.experiment("", "", "dark-layer", {}, {}).scene).optics;
        const auto with = [&](double wall_mm) {
            ClaimContext changed = context;
            changed.assignments.push_back(assign("orb.wall_mm", wall_mm));
            return changed;
        };
        // Where there is no room for twice the wall, it is the thick one itself.
        if (2 * orb.wall_mm < orb.outer_mm) return Walls{context, with(2 * orb.wall_mm)};
        return Walls{with(orb.wall_mm / 2), context};
    };
    claim.experiments = [walls](const ClaimContext &context) {
        const auto [thin, thick] = walls(context);
        std::vector all{layer(thick, "layer", "the right edge of an orb with a thick wall, before a brighter robe",
                              Relation::above, {}),
                        proportional(thick),
                        layer(thin, "layer-thin", "the same with half the wall: the layer is as dark, and half as wide",
                              Relation::above, {})};
        if (const auto flip = brightness_flip(thick))
            for (const BracketSide &side : bracket_of(flip->value))
                all.push_back(layer(thick, fmt::format("layer-flip-{}", side.label),
                                    fmt::format("surroundings just {} the flip point", side.label),
                                    side.label == "below" ? Relation::above : Relation::below,
                                    {assign("environment.radiance", side.value)}));
        if (const auto flip = width_flip(thick))
            for (const BracketSide &side : bracket_of(flip->value)) all.push_back(robe_width(thick, side));
        return all;
    };
    claim.summary = [](const ClaimContext &, Verdict verdict) -> std::string {
        switch (verdict) {
        case Verdict::holds:
            return "The rim is a layer as dark as the surroundings, in every renderer, and as wide as the wall. It is "
                   "dark because the robe ends near the orb: a wider robe would be reflected in it.";
        case Verdict::fails:
            return "In these surroundings, before this robe, the rim is not the dark layer that was stated, or some "
                   "renderer shows another one.";
        case Verdict::undecided:
            return "It is not settled whether the rim is a dark layer.";
        }
        return "";
    };
    claim.notes = [walls](const ClaimContext &context) {
        std::vector<std::string> notes;
        const auto [thin, thick] = walls(context);
        for (const ClaimContext &c : {thin, thick}) {
            const Experiment e = context.experiment("", "", "dark-layer", {}, {});
            const OrbInScene orb = orb_of(c.experiment("", "", "dark-layer", {}, {}).scene);
            const double eye = glm::length(e.scene.camera.eye_mm - orb.centre_mm), inner = orb.optics.inner_mm;
            const double plane = std::abs(orb.centre_mm.z - card_of(e.scene).centre_mm.z);
            const auto turn = optics::rim_deflection(orb.optics, optics::impact_at(orb.optics, inner));
            const auto lands = turn ? optics::landing_after_turn(inner, *turn, eye, plane) : std::optional<double>();
            notes.push_back(fmt::format(
                "A wall of {:g} mm makes a layer {:.1f} minutes of arc wide at {:g} mm; normal acuity is about 1.",
                orb.optics.wall_mm, optics::rim_width(orb.optics) / eye * 180 * 60 / 3.141592653589793, eye));
            if (turn)
                notes.back() +=
                    fmt::format(" At its inner border rays are turned outwards by {:.1f} degrees and {}.",
                                -*turn * 180 / 3.141592653589793,
                                lands ? fmt::format("reach the robe's plane {:.0f} mm from the axis", *lands)
                                      : "never reach the robe's plane");
        }
        const Experiment shown = base(thick, "", "", {});
        if (!robe_stands_beside(shown.scene, orb_of(shown.scene)))
            notes.push_back("The robe ends behind the orb, as the eye sees it: nothing stands beside the layer that it "
                            "could be held against.");
        notes.push_back(
            "The study's words are too strong: the rim does not show the surroundings whatever the robe. It "
            "shows what stands beside the orb, turned outwards; before a robe that reaches far enough it "
            "shows that robe. The outermost thread of the rim shows the robe straight behind in any case.");
        return notes;
    };
    claim.flips = [walls](const ClaimContext &context) {
        std::vector<FlipPoint> flips;
        const ClaimContext thick = walls(context).thick;
        if (const auto flip = brightness_flip(thick)) flips.push_back(*flip);
        if (const auto flip = width_flip(thick)) flips.push_back(*flip);
        return flips;
    };
    claim.scope = [walls](const ClaimContext &context, const ScopeSettings &settings) {
        const auto [thin, thick] = walls(context);
        return scope_of(thin, thick, settings);
    };
    claim.mutant = Fault::inner_surface_missing;
    return claim;
}

} // namespace threefold
