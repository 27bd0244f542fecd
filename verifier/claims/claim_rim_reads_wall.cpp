// SPDX-License-Identifier: MIT
// A ray between the inner and the outer radius cannot enter the hollow: the totally reflecting rim is as wide as the
// wall. Light is counted by crossings: each lets half through, so that the surroundings appear at 1/16 through the
// hollow (four crossings), at 1/4 by total reflection (two), and at 1 beside the orb.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "verifier/claims/claim.h"
#include "verifier/claims/flip.h"
#include "verifier/claims/orb_marks.h"
#include "verifier/claims/prediction.h"
#include "verifier/claims/scope_bounds.h"
#include "verifier/measure/edges.h"
#include "verifier/measure/optical_map.h"
#include "verifier/optics/transmitted_ray.h"

namespace threefold {

namespace {

constexpr double wall_px = 8; ///< the film is so large that the rim is about this wide
constexpr double least_film_px = 160;
constexpr double orb_share = 0.8; ///< of the film's width
constexpr int margin_px = 12;     ///< of the crop beside the rim
constexpr int rows_px = 32;

double run_wall_mm(const ClaimContext &context) {
    return orb_of(context.experiment("", "", "rim", {}, {}).scene).optics.wall_mm;
}

double preset_wall_mm(ClaimContext context) {
    context.assignments.clear();
    return run_wall_mm(context);
}

/// In a thicker wall the outermost rays pass the hollow by, and the rim is narrower than the wall.
double greatest_wall_mm(const optics::Orb<double> &orb) { return orb.outer_mm - optics::critical_radius(orb); }

Experiment width_experiment(const ClaimContext &context, const std::string &name, const std::string &title,
                            double wall_mm) {
    Experiment e = context.experiment(name, title, "furnace", {},
                                      {assign("orb.kind", "hollow"), assign("glass.coating", "antireflective"),
                                       assign("glass.interface_transmittance", "0.5"),
                                       assign("environment.radiance", "1"), assign("orb.shift_mm", "0"),
                                       assign("image.orb_share", orb_share), assign("orb.wall_mm", wall_mm)});
    const OrbInScene orb = orb_of(e.scene);
    Camera &camera = e.scene.camera;
    const double wall_share = 0.5 * orb_share * orb.optics.wall_mm / orb.optics.outer_mm; // of the film's width
    const double film_px = std::clamp(wall_px / wall_share, least_film_px, 1e8);
    camera.width_px = camera.height_px = static_cast<int>(2 * std::round(film_px / 2));
    const double middle_of_rim = orb.optics.outer_mm - orb.optics.wall_mm / 2;
    const double middle = column_of(camera, orb, middle_of_rim, camera.height_px / 2.0);
    const int width = 2 * static_cast<int>(std::ceil(film_px * wall_share / 2)) + 2 * margin_px;
    camera.crop = Crop{std::clamp(static_cast<int>(middle) - width / 2, 0, camera.width_px - width),
                       (camera.height_px - rows_px) / 2, width, rows_px};
    // Counting crossings reads the rim only where every ray beside it is totally reflected, and where both borders
    // lie well inside the crop.
    const double left = column_of(camera, orb, orb.optics.inner_mm, rows_px / 2.0),
                 right = column_of(camera, orb, orb.optics.outer_mm, rows_px / 2.0);
    const bool readable = optics::rim_width(orb.optics) > orb.optics.wall_mm * (1 - 1e-9) && left > 2 &&
                          right < width - 2 && right - left > 2;
    e.sampling = Sampling::box;
    e.samples_per_pixel = 64; // coated glass does not split rays: they are cheap
    e.surface_tolerance_mm = 0.002 * orb.optics.wall_mm;

    const double expected = optics::rim_width(orb.optics);
    e.predict = [orb, expected](const Accuracy &a) {
        return std::vector<Expected>{
            {"width of the rim",
             "mm",
             Relation::equal,
             expected,
             {{"tessellation", 4 * a.surface_mm, "both borders lie on tessellated spheres"},
              {"quantisation", 8 * a.radiance_step * orb.optics.wall_mm, "shares of known brightness"},
              {"arithmetic", 4 * a.rounding_mm, "rounding of positions"},
              {"edge", 0.002 * orb.optics.wall_mm, "a border that curves through a pixel, and its finite samples"}},
             true}};
    };
    e.measure = [orb, readable, middle_of_rim](const Image &image, const Camera &at) {
        if (!readable) return std::vector<Reading>{{"width of the rim", std::numeric_limits<double>::quiet_NaN()}};
        const double split = std::round(column_of(at, orb, middle_of_rim, rows_px / 2.0));
        double sum = 0;
        for (int row = 0; row < image.height; ++row) {
            const Borders b = plateau_borders(image, row, static_cast<int>(split), {1.0 / 16, 1.0 / 4, 1});
            const auto impact = [&](double x) {
                return impact_parameter(camera_ray(at, {x, row + 0.5}), orb.centre_mm);
            };
            sum += impact(b.right_px) - impact(b.left_px);
        }
        return std::vector<Reading>{{"width of the rim", sum / image.height}};
    };
    e.draw = [orb](const Image &, const Camera &camera) {
        return std::vector{
            impact_circle(camera, orb, orb.optics.inner_mm, Mark::Meaning::expected, "hollow"),
            impact_circle(camera, orb, orb.optics.outer_mm, Mark::Meaning::expected, "orb"),
        };
    };
    return e;
}

// Beyond the flip point the outermost rays, n r < b < R, pass the hollow by: like the rim they cross two surfaces, but
// they go where a solid ball would send them. A card that stands there tells them apart.

constexpr double band_px = 12;               ///< that band, or what is missing to it, on the film
constexpr double greatest_same_share = 0.03; ///< of the radius: a landing so near the solid ball's is one
constexpr int phases = 8;                    ///< of the pixels' grid against the edge
const std::string rim_share = "width of the rim over the wall";
const std::string rim_full = "the rim is as wide as the wall";

/// Where a solid ball of the same glass would send the ray.
std::optional<Vec3> solid_landing(const OrbInScene &orb, const Quad &card, const Ray &ray) {
    OrbInScene solid = orb;
    solid.optics = optics::solid_ball(orb.optics.outer_mm, orb.optics.index);
    return predicted_landing(solid, card, ray);
}

/// `full`: whether the rim is stated to be as wide as the wall; none: by the closed form.
Experiment edge_experiment(const ClaimContext &context, const std::string &name, const std::string &title,
                           std::vector<Assignment> fixed, std::optional<Relation> full = {}) {
    for (const Assignment &a : {assign("glass.coating", "antireflective"), assign("glass.interface_transmittance", "1"),
                                assign("orb.shift_mm", "0"), assign("image.orb_share", orb_share)})
        fixed.push_back(a);
    const Scene plan = context.experiment("", "", "rim", {}, fixed).scene;
    const OrbInScene orb = orb_of(plan);
    const double radius = orb.optics.outer_mm, eye = glm::length(plan.camera.eye_mm - orb.centre_mm);
    const double off = radius - orb.optics.index * orb.optics.inner_mm; // over 0: beyond the flip point
    const double band_mm = std::max(0.0, off), wall = orb.optics.wall_mm;
    // The card faces the middle of what the band sends to it: a wide band fans out.
    const double middle = radius - band_mm / 2;
    const double turn = 2 * optics::turn_at_outer(orb.optics, optics::impact_at(orb.optics, middle));
    const double bearing = optics::eye_angle(middle, eye) - turn;
    fixed.push_back(assign("card.bearing_deg", bearing * 180 / std::numbers::pi));
    fixed.push_back(assign("card.distance_mm", 3 * radius));
    fixed.push_back(assign("card.half_width_mm", 4 * radius));
    Experiment e = context.experiment(name, title, "rim", {}, fixed);

    Camera &camera = e.scene.camera;
    camera.width_px = camera.height_px =
        2 * static_cast<int>(std::clamp(std::round(band_px * radius / (orb_share * std::abs(off))), 320.0, 1e8));
    const int edge = static_cast<int>(camera.width_px / 2.0 +
                                      impact_circle(camera, orb, radius, Mark::Meaning::expected, "").radius_px);
    const double pixel_mm = 2 * film_half_width(camera) / camera.width_px * eye;
    const int width = std::min(edge, static_cast<int>(std::max(2.5 * band_px, 1.3 * band_mm / pixel_mm)));
    camera.crop = Crop{edge + 4 - width, (camera.height_px - rows_px) / 2, width, rows_px};
    // A totally reflected ray that all but slips through goes where the solid ball would send it but for twice its
    // angle to the hollow, three radii away: within a twentieth of a pixel that is less than this.
    const double same_share =
        std::min(greatest_same_share, 6 * std::sqrt(0.1 * pixel_mm / (orb.optics.index * orb.optics.inner_mm)));
    e.sampling = Sampling::pixel_centres;
    e.samples_per_pixel = 1;
    e.shift_replicates = true;
    e.surface_tolerance_mm = 2e-5 * radius;
    const Scene scene = e.scene;
    e.predict = [=](const Accuracy &a) {
        return std::vector<Expected>{
            {rim_share,
             "",
             Relation::equal,
             1 - band_mm / wall,
             {{"pixels", 0.3 * pixel_mm / wall, "rays are counted: a third of a pixel"},
              {"tessellation", 4 * a.surface_mm / wall, "both borders lie on tessellated spheres"},
              {"arithmetic", 4 * a.rounding_mm / wall, "rounding of positions"}},
             true},
            {rim_full,
             "",
             full.value_or(off > 0 ? Relation::below : Relation::above),
             1 - 0.5 * std::abs(off) / wall,
             {}}};
    };
    const auto share_of = [=](const Camera &at, const auto &landing) {
        const Quad &card = card_of(scene);
        double band = 0; // summed over the rows
        for (int row = 0; row < at.image_height_px(); ++row)
            for (int column = 0; column < at.image_width_px(); ++column) {
                const Vec2 sample = pixel_sample(at, column, row);
                const Ray ray = camera_ray(at, sample);
                const auto impact = [&](const Ray &r) { return impact_parameter(r, orb.centre_mm); };
                if (!(impact(ray) < radius)) continue;
                const std::optional<Vec3> landed = landing(card, column, row, ray);
                const auto solid = solid_landing(orb, card, ray);
                if (landed && solid && glm::length(*landed - *solid) < same_share * radius)
                    band +=
                        impact(camera_ray(at, sample + Vec2(0.5, 0))) - impact(camera_ray(at, sample - Vec2(0.5, 0)));
            }
        return 1 - band / at.image_height_px() / wall;
    };
    // Counting works where exact optics itself would be read so: not from an eye that all but touches the orb, nor
    // where rays inside the rim land near a solid ball's too.
    const auto exact_share = [=](const Camera &at) {
        return share_of(at, [&](const Quad &card, int, int, const Ray &ray) {
            const auto out = optics::coated_ray(orb.optics, orb.centre_mm, ray);
            const auto landed =
                out ? optics::landing_on_plane(*out, card.centre_mm, glm::cross(card.half_u_mm, card.half_v_mm))
                    : std::nullopt;
            return landed && on_card(card, *landed) ? landed : std::nullopt;
        });
    };
    const double expected = 1 - band_mm / wall;
    double counted = 0;
    for (int k = 0; k < phases; ++k) {
        Camera at = camera;
        at.film_offset_px.x = (k + 0.5) / phases - 0.5;
        counted += exact_share(at) / phases;
    }
    const bool readable = std::abs(counted - expected) < 0.3 * pixel_mm / wall;
    e.measure = [=](const Image &image, const Camera &at) {
        // What counting itself errs by on these very rays is known, and taken off.
        const double share =
            readable ? share_of(at, [&](const Quad &card, int column, int row,
                                        const Ray &) { return landing_point(card, image.at(column, row)); }) -
                           exact_share(at) + expected
                     : std::numeric_limits<double>::quiet_NaN();
        return std::vector<Reading>{{rim_share, share}, {rim_full, share}};
    };
    e.draw = [orb](const Image &, const Camera &camera_) {
        const double passes = orb.optics.index * orb.optics.inner_mm;
        return std::vector{
            impact_circle(camera_, orb, orb.optics.outer_mm, Mark::Meaning::expected, "orb"),
            impact_circle(camera_, orb, std::min(passes, orb.optics.outer_mm), Mark::Meaning::expected, "rim ends")};
    };
    return e;
}

/// Between these indices of the glass at the flip point the outermost rays can be told from the totally reflected ones
/// by where they land: with less glass both hardly bend, with more the card does not catch them.
constexpr double least_read_index = 1.015, greatest_read_index = 4;

/// The wall at which inner radius = R/n, at the run's index; and the index R/r, at the run's wall. Without a bracket
/// where a picture would not tell the sides apart.
std::vector<FlipPoint> flip_points(const ClaimContext &context) {
    const OrbInScene orb = orb_of(context.experiment("", "", "rim", {}, {}).scene);
    const auto bracket = [](double index, const std::string &what) {
        return index > least_read_index && index < greatest_read_index
                   ? std::vector<std::string>{"rim-" + what + "-flip-below", "rim-" + what + "-flip-above"}
                   : std::vector<std::string>{};
    };
    std::vector<FlipPoint> flips;
    const double wall = greatest_wall_mm(orb.optics);
    if (wall > 1e-6 * orb.optics.outer_mm)
        flips.push_back({"orb.wall_mm", "mm", wall, orb.optics.wall_mm,
                         "in a thicker wall rays pass outside the hollow, and the rim is narrower than the wall",
                         bracket(orb.optics.index, "wall")});
    const double index = orb.optics.outer_mm / orb.optics.inner_mm;
    if (index > 1 + 1e-4)
        flips.push_back({"glass.index", "", index, orb.optics.index,
                         "under it rays pass outside the hollow, and the rim is narrower than the wall",
                         bracket(index, "index")});
    return flips;
}

/// The rim's width by impact parameters of the eye's middle, as a pinhole beside it sees it in the plane through the
/// orb's centre, at the right edge. Exact for a shift to the side; a shift up or down counts by the distance alone.
double width_seen(const optics::Orb<double> &orb, double eye_mm, Vec2 aside_mm) {
    const double distance = std::sqrt(eye_mm * eye_mm + glm::dot(aside_mm, aside_mm));
    const auto seen = [&](double b) {
        const double x = aside_mm.x + eye_mm * std::tan(std::asin(b / distance) - std::atan(aside_mm.x / eye_mm));
        return eye_mm * std::sin(std::atan(x / eye_mm));
    };
    return seen(orb.outer_mm) - seen(orb.outer_mm - optics::rim_width(orb));
}

std::vector<ScopeNumber> rim_scope(const ClaimContext &context, const ScopeSettings &settings) {
    const double wall = run_wall_mm(context);
    const Experiment e = width_experiment(context, "", "", wall);
    const OrbInScene orb = orb_of(e.scene);
    const double eye = glm::length(e.scene.camera.eye_mm - orb.centre_mm);
    const Expected row = expected_row(e, "width of the rim");
    const IndexBounds index = by_index(orb.optics.index, settings, [&](double n) {
        return optics::rim_width(optics::shell(orb.optics.outer_mm, wall, n));
    });
    return {{row.quantity, row.unit, row.value, total(row.budget), margin_is_tolerance,
             of_directions(e.scene, index,
                           by_pupil(settings, [&](Vec2 aside) { return width_seen(orb.optics, eye, aside); }))}};
}

} // namespace

Claim claim_rim_reads_wall() {
    Claim claim;
    claim.name = "rim-reads-wall";
    claim.statement =
        "Seen against its surroundings, a hollow orb has a totally reflecting rim that is exactly as wide as "
        "its wall, whatever the glass.";
    claim.experiments = [](const ClaimContext &context) {
        const double own = run_wall_mm(context), thin = preset_wall_mm(context);
        const optics::Orb<double> orb = orb_of(context.experiment("", "", "rim", {}, {}).scene).optics;
        const double greatest = greatest_wall_mm(orb);
        std::vector all{
            own < greatest
                ? width_experiment(context, "rim", "the right edge of a hollow orb, magnified", own)
                : edge_experiment(context, "rim", "the outermost rays of the hollow orb", {}, Relation::above)};
        if (own != thin && thin < greatest)
            all.push_back(width_experiment(context, "rim-thin", "the same with the study's thin wall", thin));
        if (own != 2 * thin && 2 * thin < greatest)
            all.push_back(width_experiment(context, "rim-thick", "the same with the study's thick wall", 2 * thin));
        for (const FlipPoint &flip : flip_points(context))
            for (std::size_t k = 0; k < flip.bracket.size(); ++k) {
                const bool of_index = flip.parameter == "glass.index";
                const BracketSide side = (of_index ? bracket_of(flip.value, 1) : bracket_of(flip.value))[k];
                all.push_back(edge_experiment(context, flip.bracket[k],
                                              fmt::format("the outermost rays, at {} just {} the flip point",
                                                          of_index ? "an index" : "a wall", side.label),
                                              {assign(flip.parameter, side.value)}));
            }
        return all;
    };
    claim.summary = [](const ClaimContext &context, Verdict verdict) -> std::string {
        switch (verdict) {
        case Verdict::holds:
            return "The rim is as wide as the wall in every renderer: who measures the rim in a picture knows how "
                   "thick the wall is, whatever the glass.";
        case Verdict::fails:
            if (const optics::Orb<double> orb = orb_of(context.experiment("", "", "rim", {}, {}).scene).optics;
                orb.wall_mm > greatest_wall_mm(orb))
                return fmt::format(
                    "In a wall of {:.4g} mm rays pass outside the hollow: the rim is {:.4g} mm wide, less "
                    "than the wall.",
                    orb.wall_mm, optics::rim_width(orb));
            return "In some renderer the rim is not as wide as the wall.";
        case Verdict::undecided:
            return "It is not settled that the rim is as wide as the wall.";
        }
        return "";
    };
    claim.notes = [](const ClaimContext &context) {
        const OrbInScene orb = orb_of(context.experiment("", "", "rim", {}, {}).scene);
        return std::vector<std::string>{fmt::format(
            "It flips where the wall is so thick that rays pass outside the hollow: inner radius under R/n = {:.4g} mm "
            "(wall over {:.4g} mm at this index). The rim is then (n - 1) r wide.",
            optics::critical_radius(orb.optics), greatest_wall_mm(orb.optics))};
    };
    claim.flips = flip_points;
    claim.scope = rim_scope;
    claim.mutant = Fault::wall_doubled;
    return claim;
}

} // namespace threefold
