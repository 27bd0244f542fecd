// SPDX-License-Identifier: MIT
// "A solid calcite ball distorts far more than its double image separates" (figure 7 of the study). Both are lengths on
// the card: how far the middle of a pixel's two landing points lies from where its ray would land without the ball, and
// how far the two lie apart; root mean square, without the largest 0.5 %, over the part of the ball that shows the card
// in both images.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "verifier/claims/claim.h"
#include "verifier/claims/flip.h"
#include "verifier/claims/orb_marks.h"
#include "verifier/claims/scope_bounds.h"
#include "verifier/measure/double_image.h"
#include "verifier/measure/optical_map.h"

namespace threefold {

namespace {

constexpr double calcite_landing_goal = 1e-4; ///< of the radius: what tessellation may cost a landing point
constexpr double card_share = 0.98;           ///< of the card's half width: both images land within it
constexpr double steepest_share = 0.97;

const std::string displacement = "displacement by one ray, root mean square";
const std::string distortion = "distortion, root mean square";
const std::string separation = "separation of the two images, root mean square";
const std::string ratio = "distortion over separation";

struct Calcite {
    Scene ordinary, extraordinary;
    OrbInScene ordinary_orb, extraordinary_orb;
    double visible_mm; ///< impact parameter up to which both rays land on the card
    double least_ratio;
};

double eye_of(const Scene &scene) { return glm::length(scene.camera.eye_mm - orb_of(scene).centre_mm); }
double plane_of(const Scene &scene) { return std::abs(orb_of(scene).centre_mm.z - card_of(scene).centre_mm.z); }

/// Both grow without bound towards some b: the largest below which the rays of both indices stay on the card.
double visible_radius(const Scene &ordinary, const Scene &extraordinary) {
    const double radius = orb_of(ordinary).optics.outer_mm;
    const double farthest = card_share * glm::length(card_of(ordinary).half_u_mm);
    const auto lands = [&](const Scene &scene, double b) {
        const optics::Orb<double> orb = orb_of(scene).optics;
        const auto landed = optics::landing(orb, optics::impact_at(orb, b), eye_of(scene), plane_of(scene));
        return landed && std::abs(*landed) < farthest;
    };
    double b = 0;
    constexpr int steps = 2000;
    for (int k = 1; k <= steps; ++k) {
        const double next = radius * k / steps;
        if (!lands(ordinary, next) || !lands(extraordinary, next)) break;
        b = next;
    }
    return steepest_share * b;
}

/// The closed form's means over the disc, by area.
DoubleImage exact_means(const Calcite &c) {
    constexpr int points = 4000;
    std::vector<DoubleLanding> landings;
    const double eye = eye_of(c.ordinary), plane = plane_of(c.ordinary);
    for (int k = 0; k < points; ++k) {
        const double b = c.visible_mm * std::sqrt((k + 0.5) / points);
        const auto at = [&](const OrbInScene &orb) {
            return optics::landing(orb.optics, optics::impact_at(orb.optics, b), eye, plane).value_or(0);
        };
        landings.push_back({{at(c.ordinary_orb), 0, 0},
                            {at(c.extraordinary_orb), 0, 0},
                            {optics::straight_landing(b, eye, plane), 0, 0}});
    }
    return double_image(landings);
}

Calcite calcite_with(const ClaimContext &context, const std::vector<Assignment> &fixed) {
    const auto scene = [&](std::string_view ray) {
        std::vector<Assignment> all{assign("calcite.ray", ray), assign("card.surface", "coordinate"),
                                    assign("glass.coating", "antireflective"),
                                    assign("glass.interface_transmittance", "1"), assign("orb.shift_mm", "0")};
        all.insert(all.end(), fixed.begin(), fixed.end());
        return context.experiment("", "", "calcite", {}, all);
    };
    const Experiment ordinary = scene("ordinary"), extraordinary = scene("extraordinary");
    return {ordinary.scene,
            extraordinary.scene,
            orb_of(ordinary.scene),
            orb_of(extraordinary.scene),
            visible_radius(ordinary.scene, extraordinary.scene),
            std::stod(ordinary.record.parameters.at("criterion.ratio"))};
}

/// Landing points of both rays in every pixel of the disc. A pixel that shows no card where it must is put as far from
/// the card's middle as the card is wide.
template <class Ordinary, class Extraordinary>
std::vector<DoubleLanding> landings_of(const Calcite &c, const Camera &camera, Ordinary ordinary,
                                       Extraordinary extraordinary) {
    const Quad &card = card_of(c.ordinary);
    const Vec3 normal = glm::cross(card.half_u_mm, card.half_v_mm), lost = card.centre_mm + 2.0 * card.half_u_mm;
    std::vector<DoubleLanding> all;
    for (int row = 0; row < camera.image_height_px(); ++row)
        for (int column = 0; column < camera.image_width_px(); ++column) {
            const Ray ray = camera_ray(camera, pixel_sample(camera, column, row));
            if (!(impact_parameter(ray, c.ordinary_orb.centre_mm) < c.visible_mm)) continue;
            const auto straight = optics::landing_on_plane(ray, card.centre_mm, normal);
            if (!straight) continue;
            all.push_back(
                {ordinary(column, row, ray).value_or(lost), extraordinary(column, row, ray).value_or(lost), *straight});
        }
    return all;
}

DoubleImage measured_means(const Calcite &c, const Image &ordinary, const Image &extraordinary, const Camera &camera) {
    const Quad &card = card_of(c.ordinary);
    const auto by = [&](const Image &image) {
        return [&](int column, int row, const Ray &) { return landing_point(card, image.at(column, row)); };
    };
    return double_image(landings_of(c, camera, by(ordinary), by(extraordinary)));
}

/// What the closed form gives along the same rays: its difference to the mean over the area is due to the pixels alone.
DoubleImage exact_means_on(const Calcite &c, const Camera &camera) {
    const Quad &card = card_of(c.ordinary);
    const auto by = [&](const OrbInScene &orb) {
        return [&](int, int, const Ray &ray) { return predicted_landing(orb, card, ray); };
    };
    return double_image(landings_of(c, camera, by(c.ordinary_orb), by(c.extraordinary_orb)));
}

/// A lost ray counts as far away, so it pushes one more of the largest displacements that count into the mean.
double lost_ray_effect(const Calcite &c, const OrbInScene &orb) {
    const double eye = eye_of(c.ordinary), plane = plane_of(c.ordinary);
    const auto landed = optics::landing(orb.optics, optics::impact_at(orb.optics, c.visible_mm), eye, plane);
    const double largest = landed.value_or(0) - optics::straight_landing(c.visible_mm, eye, plane);
    return largest * largest / (2 * exact_means(c).ordinary_mm);
}

std::vector<BudgetItem> landing_budget(const Calcite &c, const OrbInScene &orb, double leverage, const Accuracy &a) {
    const double width = 2 * glm::length(card_of(c.ordinary).half_u_mm);
    const double pixel = 2 * film_half_width(c.ordinary.camera) / c.ordinary.camera.width_px * eye_of(c.ordinary);
    return {{"quantisation", 2 * std::sqrt(2.0) * a.radiance_step * width,
             "two ratios of stored numbers, times the card's width"},
            {"tessellation", leverage * a.surface_mm,
             fmt::format("distance of the rendered spheres from the true ones, times a leverage of {:.3g}", leverage)},
            {"arithmetic", 2 * leverage * a.rounding_mm, "rounding of positions at the scale of the scene"},
            {"filter", leverage * a.filter_px * pixel, "spread of the sample position"},
            {"lost rays", a.lost_paths * lost_ray_effect(c, orb),
             fmt::format("up to {:.2g} of the rays, beside the {:g} left out", a.lost_paths, left_out_share)},
            {"mean", 1e-7 * orb.optics.outer_mm, "the closed form's mean over the disc, by 4000 rings"}};
}

Experiment calcite_experiment(const ClaimContext &context, const std::string &name, const std::string &title,
                              const std::string &ray, const std::vector<Assignment> &more) {
    const std::string size = context.quick ? "48" : "96";
    std::vector<Assignment> fixed{assign("calcite.ray", ray), assign("card.surface", "coordinate"),
                                  assign("glass.coating", "antireflective"),
                                  assign("glass.interface_transmittance", "1"), assign("orb.shift_mm", "0")};
    fixed.insert(fixed.end(), more.begin(), more.end());
    Experiment e = context.experiment(name, title, "calcite",
                                      {assign("image.width_px", size), assign("image.height_px", size)}, fixed);
    e.sampling = Sampling::pixel_centres;
    e.samples_per_pixel = 1;
    e.shift_replicates = true;
    return e;
}

Experiment ordinary_experiment(const ClaimContext &context) {
    Experiment e =
        calcite_experiment(context, "calcite-ordinary", "where the ordinary ray of each pixel lands", "ordinary", {});
    const Calcite c = calcite_with(context, {});
    const double leverage = landing_leverage(e.scene, c.visible_mm / c.ordinary_orb.optics.outer_mm, 0.9);
    e.surface_tolerance_mm = std::max(calcite_landing_goal / leverage, 2.5e-6) * c.ordinary_orb.optics.outer_mm;
    const double exact = exact_means(c).ordinary_mm;
    e.predict = [=](const Accuracy &a) {
        return std::vector<Expected>{
            {displacement, "mm", Relation::equal, exact, landing_budget(c, c.ordinary_orb, leverage, a), true}};
    };
    e.measure = [=](const Image &image, const Camera &camera) {
        return std::vector<Reading>{{displacement, measured_means(c, image, image, camera).ordinary_mm -
                                                       exact_means_on(c, camera).ordinary_mm + exact}};
    };
    return e;
}

/// The second picture, and what takes both. `claimed`: on which side of the criterion the ratio is claimed to lie.
Experiment extraordinary_experiment(const ClaimContext &context, const std::string &name, const std::string &title,
                                    Relation claimed, const std::vector<Assignment> &more) {
    Experiment e = calcite_experiment(context, name, title, "extraordinary", more);
    const Calcite c = calcite_with(context, more);
    const double share = c.visible_mm / c.ordinary_orb.optics.outer_mm;
    const double own_leverage = landing_leverage(e.scene, share, 0.9);
    const double leverage = std::max(own_leverage, landing_leverage(c.ordinary, share, 0.9));
    e.surface_tolerance_mm = std::max(calcite_landing_goal / leverage, 2.5e-6) * c.ordinary_orb.optics.outer_mm;
    const DoubleImage exact = exact_means(c);
    e.predict = [=](const Accuracy &a) {
        const std::vector<BudgetItem> one = landing_budget(c, c.ordinary_orb, leverage, a);
        std::vector<BudgetItem> two = one, relative = one;
        for (BudgetItem &item : two) item.value *= 2; // errors of both pictures
        for (BudgetItem &item : relative)
            item.value *= 1 / exact.separation_mm + 2 * exact.distortion_mm / std::pow(exact.separation_mm, 2);
        return std::vector<Expected>{
            {displacement, "mm", Relation::equal, exact.extraordinary_mm, one, true},
            {distortion, "mm", Relation::equal, exact.distortion_mm, two, true},
            {separation, "mm", Relation::equal, exact.separation_mm, two, true},
            {ratio, "", Relation::equal, exact.distortion_mm / exact.separation_mm, relative, true},
            {fmt::format("{} {} {:g}", ratio, claimed == Relation::above ? "over" : "under", c.least_ratio),
             "",
             claimed,
             c.least_ratio,
             {}}};
    };
    e.partner = "calcite-ordinary";
    e.measure_pair = [=](const Image &image, const Image &ordinary, const Camera &camera) {
        const DoubleImage here = measured_means(c, ordinary, image, camera), on = exact_means_on(c, camera);
        const double one = here.extraordinary_mm - on.extraordinary_mm + exact.extraordinary_mm;
        const double distorted = here.distortion_mm - on.distortion_mm + exact.distortion_mm;
        const double separated = here.separation_mm - on.separation_mm + exact.separation_mm;
        return std::vector<Reading>{
            {displacement, one},
            {distortion, distorted},
            {separation, separated},
            {ratio, distorted / separated},
            {fmt::format("{} {} {:g}", ratio, claimed == Relation::above ? "over" : "under", c.least_ratio),
             distorted / separated}};
    };
    // Arrows on the card's plane as the eye sees it without the ball: from where each ray would land to where it does.
    e.draw = [c](const Image &image, const Camera &camera) {
        const Quad &card = card_of(c.ordinary);
        const Vec3 normal = glm::cross(card.half_u_mm, card.half_v_mm);
        std::vector<Mark> marks{impact_circle(camera, c.ordinary_orb, c.visible_mm, Mark::Meaning::expected,
                                              "shows the card in both images")};
        const int step = std::max(1, camera.image_width_px() / 10);
        for (int row = step; row < image.height; row += step)
            for (int column = step; column < image.width; column += step) {
                const Ray ray = camera_ray(camera, pixel_sample(camera, column, row));
                if (impact_parameter(ray, c.ordinary_orb.centre_mm) > 0.6 * c.visible_mm) continue;
                const auto straight = optics::landing_on_plane(ray, card.centre_mm, normal);
                const auto landed = landing_point(card, image.at(column, row));
                const auto other = predicted_landing(c.ordinary_orb, card, ray);
                if (!straight || !landed || !other) continue;
                marks.push_back({Mark::Kind::arrow, image_of(camera, *straight), image_of(camera, *landed), 0,
                                 Mark::Meaning::measured, ""});
                marks.push_back({Mark::Kind::line, image_of(camera, *landed), image_of(camera, *other), 0,
                                 Mark::Meaning::expected, ""});
            }
        return marks;
    };
    return e;
}

double ratio_at(const ClaimContext &context, double extraordinary_index) {
    const DoubleImage m =
        exact_means(calcite_with(context, {assign("calcite.extraordinary_index", extraordinary_index)}));
    return m.distortion_mm / m.separation_mm;
}

/// Below the ordinary index the separation grows as the extraordinary one falls.
std::optional<double> index_of_ratio(const ClaimContext &context, double wanted) {
    const double ordinary = calcite_with(context, {}).ordinary_orb.optics.index;
    return root_between([&](double n) { return ratio_at(context, n) - wanted; }, 1, 1 + (ordinary - 1) * 0.999);
}

std::optional<FlipPoint> calcite_flip_of(const ClaimContext &context) {
    const Calcite c = calcite_with(context, {});
    if (c.extraordinary_orb.optics.index >= c.ordinary_orb.optics.index) return std::nullopt;
    const auto value = index_of_ratio(context, c.least_ratio);
    if (!value || *value * (1 - bracket_share) < 1) return std::nullopt;
    return FlipPoint{
        "calcite.extraordinary_index",
        "",
        *value,
        c.extraordinary_orb.optics.index,
        fmt::format("under it the images would separate by more than 1/{:g} of the distortion", c.least_ratio),
        {"calcite-flip-below", "calcite-flip-above"}};
}

/// Distortion over separation along a grid of rays from a pinhole beside the eye, the card's landings by `ordinary` and
/// `extraordinary`. A ray whose way ends in the crystal, or beside every plane, is left out.
using Through = std::function<std::optional<Ray>(const Ray &)>;
double ratio_over(const Calcite &c, Vec2 aside_mm, const Through &ordinary, const Through &extraordinary) {
    constexpr int side = 40;
    const Camera &camera = c.ordinary.camera;
    const CameraFrame frame = camera_frame(camera);
    const Quad &card = card_of(c.ordinary);
    const Vec3 normal = glm::cross(card.half_u_mm, card.half_v_mm), centre = c.ordinary_orb.centre_mm;
    const double focus = glm::dot(card.centre_mm - camera.eye_mm, frame.forward);
    const double eye = eye_of(c.ordinary), reach = c.visible_mm / std::sqrt(eye * eye - c.visible_mm * c.visible_mm);
    const auto landing = [&](const std::optional<Ray> &ray) {
        return ray ? optics::landing_on_plane(*ray, card.centre_mm, normal) : std::nullopt;
    };
    std::vector<DoubleLanding> all;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const Vec2 at = reach * (2.0 * Vec2(column + 0.5, row + 0.5) / double(side) - 1.0);
            const Ray middle{camera.eye_mm, glm::normalize(frame.forward + at.x * frame.right + at.y * frame.up)};
            if (!(impact_parameter(middle, centre) < c.visible_mm)) continue;
            const Ray ray = from_pupil(middle, frame, aside_mm, focus);
            const auto o = landing(ordinary(ray)), e = landing(extraordinary(ray)), s = landing(ray);
            if (o && e && s) all.push_back({*o, *e, *s});
        }
    const DoubleImage image = double_image(all);
    return image.distortion_mm / image.separation_mm;
}

Through isotropic(const Calcite &c, double index) {
    return [orb = optics::solid_ball(c.ordinary_orb.optics.outer_mm, index),
            centre = c.ordinary_orb.centre_mm](const Ray &ray) { return optics::transmitted_ray(orb, centre, ray); };
}

/// The crystal as it is: over the optic axis's directions, the ratio farthest from that of two isotropic balls.
struct RealCrystal {
    double least, greatest, towards; ///< the ratios; and how far from the model towards the threshold
};

RealCrystal real_crystal(const Calcite &c) {
    const double o = c.ordinary_orb.optics.index, e = c.extraordinary_orb.optics.index;
    const double model = ratio_over(c, Vec2(0), isotropic(c, o), isotropic(c, e));
    const CameraFrame frame = camera_frame(c.ordinary.camera);
    RealCrystal found{std::numeric_limits<double>::infinity(), 0, 0};
    constexpr int tilts = 12; // the ball and the card are alike about the sight line: tilt alone counts, but for pixels
    for (int k = 0; k <= tilts; ++k) {
        const double tilt = std::numbers::pi / 2 * k / tilts;
        const optics::Uniaxial crystal{o, e, std::cos(tilt) * frame.forward + std::sin(tilt) * frame.right};
        const double ratio = ratio_over(c, Vec2(0), isotropic(c, o), [&](const Ray &ray) {
            return optics::extraordinary_ray(c.ordinary_orb.optics.outer_mm, crystal, c.ordinary_orb.centre_mm, ray);
        });
        found.least = std::min(found.least, ratio);
        found.greatest = std::max(found.greatest, ratio);
    }
    if (!(found.least <= found.greatest)) // no ray came through
        return {found.least, found.greatest, std::numeric_limits<double>::infinity()};
    found.towards = std::max(0.0, model > c.least_ratio ? model - found.least : found.greatest - model);
    return found;
}

std::vector<ScopeNumber> calcite_scope(const ClaimContext &context, const ScopeSettings &settings) {
    const Calcite c = calcite_with(context, {});
    const DoubleImage exact = exact_means(c);
    const double here = exact.distortion_mm / exact.separation_mm;
    const double o = c.ordinary_orb.optics.index, e = c.extraordinary_orb.optics.index;
    const double model = ratio_over(c, Vec2(0), isotropic(c, o), isotropic(c, e));
    double coloured = 0, least = here, greatest = here;
    constexpr int colours = 7;
    for (int k = 0; k < colours; ++k) {
        const double nm = settings.least_wavelength_nm +
                          (settings.greatest_wavelength_nm - settings.least_wavelength_nm) * k / (colours - 1);
        const double ratio =
            ratio_over(c, Vec2(0), isotropic(c, optics::index_at_wavelength(o, settings.calcite_abbe_ordinary, nm)),
                       isotropic(c, optics::index_at_wavelength(e, settings.calcite_abbe_extraordinary, nm)));
        if (!(std::abs(ratio - model) <= coloured)) coloured = std::abs(ratio - model);
        least = std::min(least, ratio);
        greatest = std::max(greatest, ratio);
    }
    const RealCrystal real = real_crystal(c);
    const double walk_off = optics::greatest_walk_off_rad({o, e, {0, 0, 1}}) * 180 / std::numbers::pi;
    const LitBounds lit = nothing_is_lit(c.ordinary);
    return {
        {ratio, "", here, margin_to(here, {c.least_ratio}), margin_words({c.least_ratio}, ""),
         EffectBounds{
             .polarisation = Bound::none("the two rays are polarised across each other and never exchanged; where "
                                         "each lands is read, not how bright it is"),
             .dispersion = {coloured,
                            fmt::format("the closed form from {:g} to {:g} nm, Abbe numbers {:g} (ordinary) and {:g} "
                                        "(extraordinary): {:.3g} to {:.3g}",
                                        settings.least_wavelength_nm, settings.greatest_wavelength_nm,
                                        settings.calcite_abbe_ordinary, settings.calcite_abbe_extraordinary, least,
                                        greatest)},
             .absorption = directions_know_no_absorption(),
             .birefringence = {real.towards,
                               fmt::format("rays traced through the uniaxial crystal itself, walk-off (up to {:.2f} "
                                           "degrees) and an index by direction included, the optic axis at 13 "
                                           "angles to the sight line: {:.3g} to {:.3g} in place of {:.3g}; what "
                                           "counts is the way towards the threshold",
                                           walk_off, real.least, real.greatest, model)},
             .light_size = lit.light_size,
             .caustics = lit.caustics,
             .interreflection = lit.interreflection,
             .pupil = by_pupil(settings,
                               [&](Vec2 aside) { return ratio_over(c, aside, isotropic(c, o), isotropic(c, e)); })}}};
}

} // namespace

Claim claim_calcite() {
    Claim claim;
    claim.name = "calcite";
    claim.statement =
        "A solid calcite ball, taken as two isotropic balls of its two indices, distorts what lies behind "
        "it far more than its two images separate.";
    claim.experiments = [](const ClaimContext &context) {
        std::vector all{ordinary_experiment(context),
                        extraordinary_experiment(context, "calcite-extraordinary",
                                                 "where the extraordinary ray of each pixel lands", Relation::above,
                                                 {})};
        if (const auto flip = calcite_flip_of(context))
            for (const BracketSide &side : bracket_of(flip->value))
                all.push_back(
                    extraordinary_experiment(context, fmt::format("calcite-flip-{}", side.label),
                                             fmt::format("an extraordinary index just {} the flip point", side.label),
                                             side.label == "below" ? Relation::below : Relation::above,
                                             {assign("calcite.extraordinary_index", side.value)}));
        return all;
    };
    claim.summary = [](const ClaimContext &context, Verdict verdict) -> std::string {
        const Calcite c = calcite_with(context, {});
        const DoubleImage m = exact_means(c);
        switch (verdict) {
        case Verdict::holds:
            return fmt::format("A calcite ball throws what lies behind it {:.0f} mm out of place, and its two images "
                               "lie {:.0f} mm apart, {:.1f} times less: the doubling would not be what one notices.",
                               m.distortion_mm, m.separation_mm, m.distortion_mm / m.separation_mm);
        case Verdict::fails:
            return fmt::format("For these indices the distortion is {:.2f} times the separation, where {:g} was asked, "
                               "or some renderer contradicts exact optics.",
                               m.distortion_mm / m.separation_mm, c.least_ratio);
        case Verdict::undecided:
            return "It is not settled whether the ball distorts more than it doubles.";
        }
        return "";
    };
    claim.notes = [](const ClaimContext &context) {
        const Calcite c = calcite_with(context, {});
        const DoubleImage m = exact_means(c);
        const double o = c.ordinary_orb.optics.index, x = c.extraordinary_orb.optics.index;
        const double radius = c.ordinary_orb.optics.outer_mm;
        const double po = optics::power_per_mm(c.ordinary_orb.optics),
                     px = optics::power_per_mm(c.extraordinary_orb.optics);
        std::vector<std::string> notes{fmt::format("Taken where both images show the card: within {:.3f} of the "
                                                   "radius. On the axis, wherever the card stands, "
                                                   "the ratio is {:.3f}.",
                                                   c.visible_mm / radius, (po + px) / 2 / std::abs(po - px))};
        if (const auto equal = index_of_ratio(context, 1))
            notes.push_back(
                fmt::format("Both would be equal at an extraordinary index of {:.4f}, {:.3f} from the ordinary one "
                            "(here {:g} against {:g}, {:.3f}).",
                            *equal, std::abs(o - *equal), x, o, std::abs(o - x)));
        const double walk_off = std::atan(std::abs(o * o - x * x) / (2 * o * x));
        notes.push_back(fmt::format(
            "Left out, as in the study: in real calcite the extraordinary index runs from {:g} along the optic axis, "
            "where nothing is doubled, to {:g} across it, and the extraordinary ray walks off by up to {:.2f} degrees, "
            "at most {:.1f} mm over the whole ball, against a distortion of {:.0f} mm.",
            o, x, walk_off * 180 / 3.141592653589793, 2 * radius * std::tan(walk_off), m.distortion_mm));
        return notes;
    };
    claim.flips = [](const ClaimContext &context) {
        const auto flip = calcite_flip_of(context);
        return flip ? std::vector{*flip} : std::vector<FlipPoint>{};
    };
    claim.scope = calcite_scope;
    claim.mutant = Fault::index_one_percent;
    return claim;
}

} // namespace threefold
