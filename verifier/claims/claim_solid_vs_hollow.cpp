// SPDX-License-Identifier: MIT
// "A solid orb inverts what lies behind it, a hollow one does not" (figure 3 of the study).
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/geometric.hpp>

#include "verifier/claims/claim.h"
#include "verifier/claims/flip.h"
#include "verifier/claims/prediction.h"
#include "verifier/claims/scope_bounds.h"
#include "verifier/measure/optical_map.h"

namespace threefold {

namespace {

constexpr double clear_share = 0.98;  ///< of the (inner) radius: beyond it a shell bends rays without bound
constexpr double axis_share = 0.3;    ///< of the clear radius: the central slope is fitted within it
constexpr double landing_goal = 1e-4; ///< of the radius: what tessellation may cost a landing point
constexpr double flip_goal = 1e-3;    ///< the same for the renders beside a flip point: they need only a sign
constexpr double least_slope = 0.05;
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

/// From where a ray would land without glass to where it lands, as the eye sees both: a few arrows over the orb.
std::vector<Mark> displacements(const Scene &scene, const OrbInScene &orb, const Image &image, const Camera &camera) {
    constexpr int arrows = 5; // a row of them
    const Quad &card = card_of(scene);
    const CameraFrame frame = camera_frame(camera);
    const double pixel = 2 * film_half_width(camera) / camera.width_px;
    const auto seen = [&](Vec3 point) {
        const Vec3 d = point - camera.eye_mm;
        const double depth = glm::dot(d, frame.forward);
        return Vec2(camera.width_px / 2.0 + glm::dot(d, frame.right) / depth / pixel,
                    camera.height_px / 2.0 - glm::dot(d, frame.up) / depth / pixel);
    };
    std::vector<Mark> marks;
    for (int i = 0; i < arrows; ++i)
        for (int j = 0; j < arrows; ++j) {
            const int column = (2 * i + 1) * image.width / (2 * arrows),
                      row = (2 * j + 1) * image.height / (2 * arrows);
            const Ray ray = camera_ray(camera, pixel_sample(camera, column, row));
            if (!(impact_parameter(ray, orb.centre_mm) < 0.9 * orb.clear_radius_mm())) continue;
            const Vec2 from = pixel_sample(camera, column, row);
            if (const auto landed = landing_point(card, image.at(column, row)))
                marks.push_back({Mark::Kind::arrow, from, seen(*landed), 0, Mark::Meaning::measured, ""});
            if (const auto predicted = predicted_landing(orb, card, ray))
                marks.push_back({Mark::Kind::cross, seen(*predicted), {}, 0, Mark::Meaning::expected, ""});
        }
    for (Mark &m : marks)
        if (m.label.empty()) {
            m.label = m.kind == Mark::Kind::arrow ? "from where one looks to the point of the card seen there"
                                                  : "by exact optics";
            if (m.kind == Mark::Kind::cross) break;
        }
    return marks;
}

/// What the conclusion says of the slope on the axis, in the words of the study.
struct SlopeConclusion {
    std::string quantity;
    Relation relation;
    double threshold;
};

struct MapPlan {
    std::string name, title, kind;
    std::vector<Assignment> fixed; ///< beside what the measuring needs
    double goal;                   ///< of the radius: what tessellation may cost a landing point
    SlopeConclusion conclusion;
};

Experiment map_experiment(const ClaimContext &context, const MapPlan &plan) {
    const std::string size = context.quick ? "64" : "128";
    std::vector<Assignment> fixed{assign("card.surface", "coordinate"), assign("glass.coating", "antireflective"),
                                  assign("glass.interface_transmittance", "1")};
    fixed.insert(fixed.end(), plan.fixed.begin(), plan.fixed.end());
    Experiment e = context.experiment(plan.name, plan.title, plan.kind,
                                      {assign("image.width_px", size), assign("image.height_px", size)}, fixed);
    e.sampling = Sampling::pixel_centres;
    e.samples_per_pixel = 1;
    e.shift_replicates = true;

    const Scene scene = e.scene;
    const OrbInScene orb = orb_of(scene);
    const double leverage = landing_leverage(scene, clear_share, 0.95);
    e.surface_tolerance_mm = std::max(plan.goal / leverage, finest_surface) * orb.optics.outer_mm;
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
        // Near a slope of 0 one point of the plane fills the view, and its size has no meaning.
        if (std::abs(paraxial) > least_slope) {
            std::vector<BudgetItem> magnification = slope;
            for (BudgetItem &item : magnification) item.value *= 1.1 / (paraxial * paraxial);
            expected.push_back(
                {"image magnification on the axis", "", Relation::equal, 1 / paraxial, magnification, true});
        }
        expected.push_back({plan.conclusion.quantity, "", plan.conclusion.relation, plan.conclusion.threshold, {}});
        return expected;
    };
    e.draw = [=](const Image &image, const Camera &camera) { return displacements(scene, orb, image, camera); };
    e.measure = [=](const Image &image, const Camera &camera) {
        std::vector<double> errors = landing_errors_mm(scene, orb, image, camera);
        const double p95 = quantile(std::move(errors), 0.95) / orb.optics.outer_mm;
        // Over the rays that land on the card in the picture and by the closed form: what the polynomial leaves of the
        // aberration is then the same in both.
        const Quad &card = card_of(scene);
        const auto landings = [&](int column, int row, const Ray &ray) {
            const auto landed = landing_point(card, image.at(column, row));
            const auto predicted = predicted_landing(orb, card, ray);
            const bool both = landed && predicted && on_card(card, *predicted);
            return both ? std::pair(landed, predicted) : std::pair<std::optional<Vec3>, std::optional<Vec3>>();
        };
        const double fitted = slope_of(
            scene, orb, camera, [&](int column, int row, const Ray &ray) { return landings(column, row, ray).first; });
        const double exact = slope_of(
            scene, orb, camera, [&](int column, int row, const Ray &ray) { return landings(column, row, ray).second; });
        const double slope = fitted - exact + paraxial;
        return std::vector<Reading>{{"landing error, 95th percentile", p95},
                                    {"central slope", slope},
                                    {"image magnification on the axis", 1 / slope},
                                    {plan.conclusion.quantity, slope}};
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
    // One ray a pixel, through another point of it in each replicate and through the same one in all renderers: what
    // the points do to a picture is then no noise, and few rays do.
    e.sampling = Sampling::pixel_centres;
    e.shift_replicates = true;
    e.samples_per_pixel = kind == "solid" ? 64 : context.quick ? 96 : 160; // where one branch is followed at random
    e.replicates = 8;
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

/// An orb, and how far the eye and the plane are from its centre.
struct View {
    optics::Orb<double> orb;
    double eye_mm, plane_mm;
};

View view_of(const ClaimContext &context, std::string_view kind) {
    const Scene scene = context.experiment("", "", kind, {}, {}).scene;
    const OrbInScene orb = orb_of(scene);
    return {orb.optics, glm::length(scene.camera.eye_mm - orb.centre_mm),
            std::abs(orb.centre_mm.z - card_of(scene).centre_mm.z)};
}

/// What --set takes, so that what is reported can be rendered.
constexpr double greatest_index = 10;

std::optional<double> flip_index(const View &view) {
    const auto index = optics::critical_inversion_index(view.orb.outer_mm, view.eye_mm, view.plane_mm);
    return index && *index * (1 + bracket_share) < greatest_index ? index : std::nullopt;
}

/// The orb must not reach the plane; a plane nearer than its surface cannot be rendered.
std::optional<double> flip_plane(const View &view) {
    const auto plane = optics::plane_where_magnifying_ends(view.orb, view.eye_mm);
    return plane && *plane * (1 - bracket_share) > 1.001 * view.orb.outer_mm ? plane : std::nullopt;
}

std::vector<Experiment> flip_experiments(const ClaimContext &context) {
    const View view = view_of(context, "solid");
    std::vector<Experiment> all;
    const auto add = [&](std::string_view what, std::string_view parameter, const BracketSide &side,
                         const SlopeConclusion &conclusion) {
        all.push_back(map_experiment(
            context, {fmt::format("solid-vs-hollow-{}-{}", what, side.label),
                      fmt::format("a solid orb just {} the {} where it flips, {:.5g}", side.label, what, side.value),
                      "solid",
                      {assign(parameter, side.value)},
                      flip_goal,
                      conclusion}));
    };
    if (const auto index = flip_index(view))
        for (const BracketSide &side : bracket_of(*index, 1))
            add("index", "glass.index", side,
                side.label == "below"
                    ? SlopeConclusion{"central slope is positive (upright) below the index", Relation::above, 0}
                    : SlopeConclusion{"central slope is negative (inverted) above the index", Relation::below, 0});
    if (const auto plane = flip_plane(view))
        for (const BracketSide &side : bracket_of(*plane))
            add("plane", "card.distance_mm", side,
                side.label == "below"
                    ? SlopeConclusion{"central slope is above -1 (magnified) nearer than it", Relation::above, -1}
                    : SlopeConclusion{"central slope is below -1 (reduced) beyond it", Relation::below, -1});
    return all;
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

std::vector<ScopeNumber> map_scope(const ClaimContext &context, const ScopeSettings &settings) {
    std::vector<ScopeNumber> numbers;
    for (const std::string kind : {"solid", "hollow"}) {
        const View view = view_of(context, kind);
        const double slope = optics::paraxial_slope(view.orb, view.eye_mm, view.plane_mm);
        const IndexBounds index = by_index(view.orb.index, settings, [&](double n) {
            optics::Orb<double> orb = view.orb;
            orb.index = n;
            return optics::paraxial_slope(orb, view.eye_mm, view.plane_mm);
        });
        // A pinhole beside the eye is farther from the orb, and sees the plane at a slant.
        const Bound pupil = by_pupil(settings, [&](Vec2 aside) {
            const double eye = std::hypot(view.eye_mm, glm::length(aside));
            return optics::paraxial_slope(view.orb, eye, view.plane_mm * eye / view.eye_mm);
        });
        numbers.push_back({fmt::format("central slope of the {} orb", kind), "", slope, margin_to(slope, {0}),
                           margin_words({0}, ""),
                           of_directions(context.experiment("", "", kind, {}, {}).scene, index, pupil)});
    }
    return numbers;
}

} // namespace

Claim claim_solid_vs_hollow() {
    Claim claim;
    claim.name = "solid-vs-hollow";
    claim.statement = "A solid orb inverts what lies behind it, a hollow one does not.";
    claim.experiments = [](const ClaimContext &context) {
        std::vector all{
            view_experiment(context, "solid"),
            view_experiment(context, "hollow"),
            map_experiment(context, {"solid-map",
                                     "where each ray lands behind the solid orb",
                                     "solid",
                                     {},
                                     landing_goal,
                                     {"central slope of a solid orb is negative (inverted)", Relation::below, 0}}),
            map_experiment(context, {"hollow-map",
                                     "where each ray lands behind the hollow orb",
                                     "hollow",
                                     {},
                                     landing_goal,
                                     {"central slope of a hollow orb is positive (upright)", Relation::above, 0}}),
            picture_experiment(context, "hollow"), // takes longest: before the other
            picture_experiment(context, "solid")};
        for (Experiment &e : flip_experiments(context)) all.push_back(std::move(e));
        return all;
    };
    claim.summary = [](const ClaimContext &, Verdict verdict) {
        switch (verdict) {
        case Verdict::holds:
            return "Seen through the solid orb the robe stands on its head; through the hollow orb it stays upright "
                   "and nearly in place. Every renderer shows it, and each agrees with exact optics.";
        case Verdict::fails:
            return "Some renderer, or exact optics itself, contradicts the statement for this scene.";
        case Verdict::undecided:
            return "The renders do not settle the statement yet.";
        }
        return "";
    };
    claim.notes = [](const ClaimContext &context) {
        std::vector<std::string> notes;
        const View solid = view_of(context, "solid"), hollow = view_of(context, "hollow");
        if (const auto index = flip_index(solid))
            notes.push_back(fmt::format("Not \"any orb denser than air\", as the study says: a solid orb inverts this "
                                        "plane only above an index of {:.4f} (here {:g}).{}",
                                        *index, solid.orb.index, materials_above(*index)));
        else
            notes.emplace_back("At these distances no index makes a solid orb invert the plane.");
        if (const auto magnification = optics::image_magnification(solid.orb, solid.eye_mm, solid.plane_mm))
            notes.push_back(
                fmt::format("The solid orb shows the plane {:.3f} times its size on the axis (negative: inverted).{}",
                            *magnification,
                            std::abs(*magnification) < 1 ? " It reduces it; the study says that it magnifies." : ""));
        if (const auto where = flip_plane(solid))
            notes.push_back(fmt::format("It magnifies planes nearer than {:.4g} mm behind its centre and reduces those "
                                        "farther away (here {:g} mm).",
                                        *where, solid.plane_mm));
        else
            notes.emplace_back("From so near an eye the solid orb magnifies every plane that it inverts.");
        const double slope = optics::paraxial_slope(hollow.orb, hollow.eye_mm, hollow.plane_mm);
        notes.push_back(
            fmt::format("The hollow orb's slope on the axis is {:.4f}: {}, and shown {:.3f} times its size.", slope,
                        slope > 0 ? "upright" : "inverted", std::abs(1 / slope)));
        return notes;
    };
    claim.flips = [](const ClaimContext &context) {
        const View solid = view_of(context, "solid");
        std::vector<FlipPoint> flips;
        if (const auto index = flip_index(solid))
            flips.push_back({"glass.index",
                             "",
                             *index,
                             solid.orb.index,
                             "a solid orb inverts the plane only above this index",
                             {"solid-vs-hollow-index-below", "solid-vs-hollow-index-above"}});
        if (const auto plane = flip_plane(solid))
            flips.push_back({"card.distance_mm",
                             "mm",
                             *plane,
                             solid.plane_mm,
                             "a solid orb magnifies a plane nearer than this, and reduces one beyond",
                             {"solid-vs-hollow-plane-below", "solid-vs-hollow-plane-above"}});
        return flips;
    };
    claim.scope = map_scope;
    claim.mutant = Fault::index_one_percent;
    return claim;
}

} // namespace threefold
