// SPDX-License-Identifier: MIT
// The study's main light is a cluster of 100 directions: a straight edge casts as many shadows, and their edges make a
// penumbra of steps. Each light's step lies where its direction says, so the whole profile down the wall is known.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scenes/figure/light.h"
#include "scenes/light.h"
#include "verifier/claims/claim.h"
#include "verifier/claims/flip.h"
#include "verifier/claims/parallel_planes.h"
#include "verifier/claims/scope_bounds.h"
#include "verifier/measure/penumbra.h"

namespace threefold {

namespace {

struct Stage {
    Quad wall, board;
    double reflectance;
    double top_mm, row_mm; ///< height of the picture's upper edge in the world, and of a row of pixels
    double eye_to_wall_mm, acuity_arcmin;
};

Stage stage_of(const Experiment &e) {
    const Scene &s = e.scene;
    const Quad &wall = std::get<Quad>(s.objects[0].shape), &board = std::get<Quad>(s.objects[1].shape);
    const double row = s.camera.orthographic_width_mm / s.camera.width_px;
    return {wall,
            board,
            std::get<Rgb>(std::get<Diffuse>(wall.surface).reflectance).r,
            s.camera.eye_mm.y + row * s.camera.height_px / 2,
            row,
            s.camera.eye_mm.z - wall.centre_mm.z,
            std::stod(e.record.parameters.at("criterion.acuity_arcmin"))};
}

/// Where a light's shadow of the board covers the column through the picture's middle: heights on the wall.
struct Shadow {
    double low_mm = 0, high_mm = 0;
};

Shadow shadow_of(const Stage &stage, Vec3 travel) {
    const double gap = stage.board.centre_mm.z - stage.wall.centre_mm.z;
    const Vec3 centre = stage.board.centre_mm + travel * (gap / -travel.z);
    if (std::abs(centre.x) > glm::length(stage.board.half_u_mm)) return {};
    const double half = glm::length(stage.board.half_v_mm);
    return {centre.y - half, centre.y + half};
}

/// Irradiance of the wall, the mean over each row of the picture: exact, since a shadow's edge is a straight line.
std::vector<double> irradiance_by_row(const Stage &stage, const Scene &scene) {
    std::vector<double> rows(static_cast<std::size_t>(scene.camera.height_px), 0.0);
    for (const Directional &light : lights_on_diffuse(scene)) {
        const Vec3 travel = glm::normalize(light.travel);
        if (!(travel.z < 0)) continue; // from behind the wall
        const double full = light.irradiance.r * -travel.z;
        const Shadow shadow = shadow_of(stage, travel);
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const double high = stage.top_mm - static_cast<double>(k) * stage.row_mm;
            const double low = high - stage.row_mm;
            const double covered = std::max(0.0, std::min(high, shadow.high_mm) - std::max(low, shadow.low_mm));
            rows[k] += full * (1 - covered / stage.row_mm);
        }
    }
    return rows;
}

double width_arcmin(double length_mm, double distance_mm) {
    return std::atan(length_mm / distance_mm) * 180 * 60 / std::numbers::pi;
}

constexpr std::string_view full_light = "irradiance beside the shadow", umbra = "irradiance within the shadow",
                           width = "width of the penumbra", seen = "width of the penumbra as the eye sees it";

std::vector<Reading> readings(const std::vector<double> &irradiance, const Stage &stage) {
    const Penumbra p = measure_penumbra(irradiance);
    const double width_mm = p.width_rows * stage.row_mm;
    return {{std::string(full_light), p.light},
            {std::string(umbra), p.dark},
            {std::string(width), width_mm},
            {std::string(seen), width_arcmin(width_mm, stage.eye_to_wall_mm)}};
}

Experiment penumbra_experiment(const ClaimContext &context, const std::string &name, const std::string &title,
                               const std::vector<Assignment> &fixed, Relation side) {
    Experiment e = context.experiment(
        name, title, "soft-light",
        {assign("image.width_px", context.quick ? 8.0 : 16.0), assign("image.height_px", context.quick ? 64.0 : 128.0)},
        fixed);
    e.sampling = Sampling::box;
    e.samples_per_pixel = 32;
    const Stage stage = stage_of(e);
    const Scene scene = e.scene;
    e.predict = [=](const Accuracy &a) {
        const std::vector<Reading> exact = readings(irradiance_by_row(stage, scene), stage);
        const double all = exact[0].value;
        // Stored radiance to irradiance.
        const double step = a.radiance_step * std::numbers::pi / stage.reflectance;
        const std::vector<BudgetItem> light{
            {"quantisation", step, "half a step of a stored number"},
            {"arithmetic", 1e-6 * all, "a sum over the lights in single precision"},
            {"edge", 1e-4 * all, "lights that graze the wall, whose shadow of the board's side may cross the picture"},
            {"resolution", 0.0025 * all, "a third of what one of the cluster's lights adds: less does not matter"},
        };
        const std::vector<BudgetItem> length{
            {"quantisation", 4 * step / all * exact[2].value, "both ends of the profile, and its moments"},
            {"edge", 0.05 * stage.row_mm, "a twentieth of a row: edges of shadows by finite samples"},
            {"arithmetic", 2 * a.rounding_mm, "rounding of positions"},
            {"resolution", 0.01 * exact[2].value, "one per cent of the width: less does not matter"},
        };
        std::vector<Expected> expected{
            {std::string(full_light), "", Relation::equal, exact[0].value, light, true},
            {std::string(umbra), "", Relation::equal, exact[1].value, light, true},
            {std::string(width), "mm", Relation::equal, exact[2].value, length, true},
        };
        expected.push_back({std::string(seen), "arcmin", side, stage.acuity_arcmin, {}});
        return expected;
    };
    e.measure = [=](const Image &image, const Camera &) {
        std::vector<double> rows = row_means(image);
        for (double &r : rows) r *= std::numbers::pi / stage.reflectance;
        return readings(rows, stage);
    };
    e.draw = [=](const Image &image, const Camera &) {
        const auto edges = [&](const std::vector<double> &rows, Mark::Meaning meaning, const std::string &label) {
            const Penumbra p = measure_penumbra(rows);
            std::vector<Mark> marks;
            for (const double end : {p.middle_row - p.width_rows / 2, p.middle_row + p.width_rows / 2})
                marks.push_back({Mark::Kind::line, {0, end}, {image.width, end}, 0, meaning, ""});
            marks.front().label = label;
            return marks;
        };
        std::vector<Mark> marks = edges(row_means(image), Mark::Meaning::measured, "penumbra");
        for (Mark &m : edges(irradiance_by_row(stage, scene), Mark::Meaning::expected, "by the lights' directions"))
            marks.push_back(std::move(m));
        return marks;
    };
    return e;
}

/// The distance of board and wall at which the penumbra is as wide as the criterion.
std::optional<double> least_visible_distance(const ClaimContext &context) {
    const auto excess = [&](double distance_mm) {
        const Experiment e = context.experiment("", "", "soft-light", {}, {assign("board.distance_mm", distance_mm)});
        const Stage stage = stage_of(e);
        return readings(irradiance_by_row(stage, e.scene), stage)[3].value - stage.acuity_arcmin;
    };
    return root_between(excess, 1e-3, 1e3);
}

/// Irradiance of the wall at one height, without what surfaces throw on each other.
double direct_at(const Stage &stage, const std::vector<Directional> &lights, double height_mm) {
    double sum = 0;
    for (const Directional &light : lights) {
        const Vec3 travel = glm::normalize(light.travel);
        if (!(travel.z < 0)) continue;
        const Shadow shadow = shadow_of(stage, travel);
        if (!(height_mm > shadow.low_mm && height_mm < shadow.high_mm)) sum += light.irradiance.r * -travel.z;
    }
    return sum;
}

std::vector<double> with_reflected_light(const Stage &stage, const Scene &scene) {
    const std::vector<Directional> lights = lights_on_diffuse(scene);
    const double gap = stage.board.centre_mm.z - stage.wall.centre_mm.z;
    const double foot =
        stage.board.centre_mm.y - glm::length(stage.board.half_v_mm); // of the board, where heights begin
    const auto &board = std::get<Rgb>(std::get<Diffuse>(stage.board.surface).reflectance);
    const double half_wall = glm::length(stage.wall.half_v_mm);
    const auto extra = thrown_back({gap, 2 * glm::length(stage.board.half_v_mm), stage.reflectance, board.r,
                                    std::max(-half_wall, -20 * gap), std::min(half_wall, 20 * gap)},
                                   [&](double height) { return direct_at(stage, lights, foot + height); });
    std::vector<double> rows = irradiance_by_row(stage, scene);
    for (std::size_t k = 0; k < rows.size(); ++k)
        rows[k] += extra(stage.top_mm - (static_cast<double>(k) + 0.5) * stage.row_mm - foot);
    return rows;
}

std::vector<ScopeNumber> soft_light_scope(const ClaimContext &context, const ScopeSettings &settings) {
    const Experiment e = penumbra_experiment(context, "", "", {}, Relation::above);
    const Stage stage = stage_of(e);
    const std::vector<Reading> here = readings(irradiance_by_row(stage, e.scene), stage),
                               discs =
                                   readings(irradiance_by_row(stage, with_discs(e.scene, settings.light_deg)), stage),
                               lit = readings(with_reflected_light(stage, e.scene), stage);
    std::vector<ScopeNumber> numbers;
    const char *no_glass = "there is no glass in its scene";
    for (std::size_t k = 0; k < here.size(); ++k) {
        const bool is_seen = here[k].quantity == seen;
        const Expected row = expected_row(e, here[k].quantity);
        EffectBounds bounds = none_of_them(no_glass);
        bounds.polarisation =
            Bound::none("there is no glass in its scene, and a matt wall takes all polarisations alike");
        bounds.light_size = {
            std::abs(discs[k].value - here[k].value),
            fmt::format("each of the lights as seven over a disc of {:g} degrees, their shadows' edges by "
                        "the closed form: {:.4g} in place of {:.4g}",
                        settings.light_deg, discs[k].value, here[k].value)};
        bounds.interreflection = {std::abs(lit[k].value - here[k].value),
                                  fmt::format("wall and board as two parallel planes that light each other, all "
                                              "reflections, form factors of long strips: {:.4g} in place of {:.4g}",
                                              lit[k].value, here[k].value)};
        bounds.pupil = Bound::none("the wall is flat and in focus: every point of the pupil sees the same of it");
        numbers.push_back({here[k].quantity, row.unit, here[k].value,
                           is_seen ? margin_to(here[k].value, {stage.acuity_arcmin}) : total(row.budget),
                           is_seen ? margin_words({stage.acuity_arcmin}, "arcmin") : margin_is_tolerance, bounds});
    }
    return numbers;
}

} // namespace

Claim claim_soft_light() {
    Claim claim;
    claim.name = "soft-light";
    claim.statement = "The study's main light, a cluster of 100 directions, casts slightly soft shadows: the edge of a "
                      "shadow is as wide as the cluster is.";
    claim.experiments = [](const ClaimContext &context) {
        std::vector all{penumbra_experiment(context, "penumbra", "the shadow of a board's lower edge on the wall", {},
                                            Relation::above)};
        if (const auto flip = least_visible_distance(context))
            for (const auto &[label, distance] : bracket_of(*flip))
                all.push_back(penumbra_experiment(
                    context, fmt::format("soft-light-flip-{}", label),
                    fmt::format("the board {:.4g} mm from the wall, {} where its shadow's edge looks sharp", distance,
                                label),
                    {assign("board.distance_mm", distance)}, label == "below" ? Relation::below : Relation::above));
        return all;
    };
    claim.summary = [](const ClaimContext &, Verdict verdict) {
        switch (verdict) {
        case Verdict::holds:
            return "Every renderer shows the same soft edge, as wide as the directions of the lights say, and adds up "
                   "all 102 lights and the dim surroundings to the same irradiance.";
        case Verdict::fails:
            return "In some renderer the light does not add up, or the shadow's edge is not as soft as the lights' "
                   "directions say; or here it is too sharp to be seen as soft.";
        case Verdict::undecided:
            return "It is not settled that the shadow is as soft as the lights' directions say.";
        }
        return "";
    };
    claim.notes = [](const ClaimContext &context) {
        const Experiment e = context.experiment("", "", "soft-light", {}, {});
        const Stage stage = stage_of(e);
        const std::vector<Reading> exact = readings(irradiance_by_row(stage, e.scene), stage);
        double sum = 0;
        for (const Directional &light : e.scene.lights) sum += light.irradiance.r;
        return std::vector<std::string>{
            fmt::format(
                "The lights' irradiances sum to {:.4g} on planes that face them ({:.4g} of it the cluster's); on "
                "the upright wall they leave {:.4g}, with the surroundings.",
                sum, key_light_directions * key_light_irradiance, exact[0].value),
            fmt::format("The penumbra is {:.3g} mm wide at {:g} mm from the edge that casts it ({:.2g} of that "
                        "distance), {:.3g} minutes of arc for the eye. Its width is that of an even ramp "
                        "with the same standard deviation.",
                        exact[2].value, stage.board.centre_mm.z - stage.wall.centre_mm.z,
                        exact[2].value / (stage.board.centre_mm.z - stage.wall.centre_mm.z), exact[3].value)};
    };
    claim.flips = [](const ClaimContext &context) {
        std::vector<FlipPoint> flips;
        if (const auto distance = least_visible_distance(context)) {
            const Experiment e = context.experiment("", "", "soft-light", {}, {});
            flips.push_back({"board.distance_mm",
                             "mm",
                             *distance,
                             std::stod(e.record.parameters.at("board.distance_mm")),
                             fmt::format("nearer to the wall than this, a shadow's edge is narrower than {} minutes of "
                                         "arc for the eye, and looks sharp",
                                         e.record.parameters.at("criterion.acuity_arcmin")),
                             {"soft-light-flip-below", "soft-light-flip-above"}});
        }
        return flips;
    };
    claim.scope = soft_light_scope;
    claim.mutant = Fault::light_missing;
    return claim;
}

} // namespace threefold
