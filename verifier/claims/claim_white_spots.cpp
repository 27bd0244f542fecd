// SPDX-License-Identifier: MIT
// Three white specks, taken as mirror images of small bright sources. For each: where the highlight of the front
// surface and the weaker one of the inner surface behind it fall, and how much light they carry, by Fresnel and all
// orders. The rear surfaces make two more, far away on the other side, whose places are in the notes.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scenes/catalogue/white_spots.h"
#include "scenes/error.h"
#include "verifier/claims/claim.h"
#include "verifier/claims/flip.h"
#include "verifier/claims/orb_light.h"
#include "verifier/claims/orb_marks.h"
#include "verifier/claims/scope_bounds.h"
#include "verifier/measure/highlight.h"

namespace threefold {

namespace {

constexpr double least_separation_px = 10; ///< between the two highlights on the film
constexpr double size_share = 0.12;        ///< a highlight's half width, of that separation
constexpr double light_tolerance = 0.08;   ///< of a highlight's light: by Fresnel the two differ by far more
constexpr int spot_margin_px = 6;

struct Spot {
    Experiment plan; ///< its scene, and its parameters
    Parameters parameters;
    OrbInScene orb;
    int number; ///< 1 to 3
};

std::vector<Assignment> dark(int number, const std::vector<Assignment> &more) {
    std::vector<Assignment> all{assign("source.which", std::to_string(number)),
                                assign("source.radiance", "1"),
                                assign("environment.radiance", "0"),
                                assign("orb.shift_mm", "0"),
                                assign("glass.coating", "fresnel"),
                                assign("glass.interface_transmittance", "1")};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

Spot spot_of(const ClaimContext &context, int number, const std::vector<Assignment> &more) {
    Experiment plan = context.experiment("", "", "white-spots", {}, dark(number, more));
    Parameters values(find_scene(context.scenes, "white-spots").parameters, context.preset);
    for (const auto &[name, value] : plan.record.parameters) values.set(name, value);
    const OrbInScene orb = orb_of(plan.scene);
    return {std::move(plan), std::move(values), orb, number};
}

/// The ray from the eye at impact parameter b (negative: on the side away from the source) in the source's plane of
/// incidence that goes to the source by an order of the given crossings; nothing where there is none.
std::optional<Ray> ray_to_source(const Spot &s, int glass_legs, int hollow_chords) {
    const Vec3 eye = s.plan.scene.camera.eye_mm - s.orb.centre_mm, source = card_of(s.plan.scene).centre_mm;
    const double distance = glm::length(eye);
    const Vec3 inwards = -eye / distance;
    const Vec3 aside = glm::normalize(source - glm::dot(source, inwards) * inwards);
    const auto ray_at = [&](double b) {
        const double angle = optics::eye_angle(b, distance);
        return Ray{s.plan.scene.camera.eye_mm, std::cos(angle) * inwards + std::sin(angle) * aside};
    };
    /// By how much the order's exit passes the source, sideways in the plane of incidence.
    const auto passes = [&](double b) {
        for (const ExitRay &exit : exit_rays(s.orb, ray_at(b), 1e-3)) {
            if (exit.glass_legs != glass_legs || exit.hollow_chords != hollow_chords) continue;
            const Vec3 to_source = glm::normalize(source - exit.ray.origin_mm);
            if (glm::dot(exit.ray.direction, to_source) < 0) return std::numeric_limits<double>::quiet_NaN();
            return glm::dot(glm::cross(exit.ray.direction, to_source), glm::cross(inwards, aside));
        }
        return std::numeric_limits<double>::quiet_NaN();
    };
    constexpr int steps = 400;
    const double most = 0.9999 * s.orb.clear_radius_mm();
    double b = -most, before = passes(b);
    for (int k = 1; k <= steps; ++k) {
        const double next = -most + 2 * most * (k + 0.0173) / (steps + 0.0346), here = passes(next);
        if (before * here < 0)
            if (const auto root = root_between(passes, b, next)) return ray_at(*root);
        b = next;
        before = here;
    }
    return std::nullopt;
}

Vec3 on_surface(const OrbInScene &orb, const Ray &ray) {
    const double along = glm::dot(orb.centre_mm - ray.origin_mm, ray.direction);
    const double b = impact_parameter(ray, orb.centre_mm);
    const double half = std::sqrt(std::max(0.0, orb.optics.outer_mm * orb.optics.outer_mm - b * b));
    return ray.origin_mm + (along - half) * ray.direction;
}

Vec2 film_of(const Camera &camera, const Ray &ray) { return image_of(camera, ray.origin_mm + ray.direction); }

struct SpotView {
    Experiment experiment;
    Spot spot;
    Vec2 front_px, inner_px; ///< in the crop
    Vec3 painted_mm;
    double pixel_mm;
};

/// Both highlights on a film so fine that they stand apart; the source so small that they do not run together.
SpotView look_at(const ClaimContext &context, const std::string &name, const std::string &title, int number,
                 std::vector<Assignment> more) {
    const Spot plan = spot_of(context, number, more);
    const auto front = ray_to_source(plan, 0, 0), inner = ray_to_source(plan, 2, 0);
    if (!front || !inner) throw Error(Exit::bad_data, "a white spot's source is not mirrored towards the eye");
    const double apart = glm::length(film_of(plan.plan.scene.camera, *front) - film_of(plan.plan.scene.camera, *inner));
    const double scale = least_separation_px / apart;
    Camera camera = plan.plan.scene.camera;
    const double wide = std::clamp(std::ceil(camera.width_px * scale), 16.0, 1e6);
    const double pixel_mm = 2 * film_half_width(camera) / wide * camera.eye_mm.z;
    // A convex mirror of focal length R/2 shows a far source at this size.
    const double half_width = size_share * least_separation_px * pixel_mm / (plan.orb.optics.outer_mm / 2) *
                              plan.parameters.number("source.distance_mm");
    more.push_back(assign("source.half_width_mm", half_width));
    Experiment e = context.experiment(name, title, "white-spots", {}, dark(number, more));
    Camera &film = e.scene.camera;
    film.width_px = film.height_px = static_cast<int>(wide);
    const Vec2 a = film_of(film, *front), b = film_of(film, *inner);
    const Vec2 low = glm::min(a, b) - Vec2(spot_margin_px), high = glm::max(a, b) + Vec2(spot_margin_px);
    film.crop = Crop{static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(high.x - low.x) + 1,
                     static_cast<int>(high.y - low.y) + 1};
    const Vec2 corner(film.crop->x_px, film.crop->y_px);
    e.sampling = Sampling::box;
    e.samples_per_pixel = context.quick ? 128 : 256;
    e.cut_weight = 1e-5;
    e.surface_tolerance_mm = 2e-5 * plan.orb.optics.outer_mm;
    return {e,          spot_of(context, number, more),          a - corner,
            b - corner, white_spot(plan.parameters, number - 1), pixel_mm};
}

/// The picture as the closed form makes it: means over pixels by a grid of rays.
Image exact_picture(const SpotView &v) {
    constexpr int grid = 8;
    const Camera &camera = v.experiment.scene.camera;
    Image image(camera.image_width_px(), camera.image_height_px());
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            double sum = 0;
            for (int k = 0; k < grid * grid; ++k) {
                const Vec2 at(column + (k % grid + 0.5) / grid, row + (k / grid + 0.5) / grid);
                for (const ExitRay &exit : exit_rays(v.spot.orb, camera_ray(camera, at), 1e-3))
                    sum += exit.weight * radiance_outside(v.experiment.scene, exit.ray);
            }
            image.at(column, row) = Rgb(sum / (grid * grid));
        }
    return image;
}

struct Names {
    std::string front_x, front_y, front_light, inner_x, inner_y, inner_light;
};

Names names_of(int number) {
    const auto name = [number](std::string_view what) { return fmt::format("spot {}: {}", number, what); };
    return {name("front highlight, x"), name("front highlight, y"), name("light of the front highlight"),
            name("inner highlight, x"), name("inner highlight, y"), name("light of the inner highlight")};
}

std::vector<Reading> read(const SpotView &v, const Names &names, const Image &image) {
    const Highlight front = highlight(image, v.front_px, v.inner_px), inner = highlight(image, v.inner_px, v.front_px);
    return {{names.front_x, front.centre_px.x * v.pixel_mm},
            {names.front_y, front.centre_px.y * v.pixel_mm},
            {names.front_light, front.light},
            {names.inner_x, inner.centre_px.x * v.pixel_mm},
            {names.inner_y, inner.centre_px.y * v.pixel_mm},
            {names.inner_light, inner.light}};
}

void draw_highlights(SpotView &v) {
    const Highlight expected = highlight(exact_picture(v), v.front_px, v.inner_px);
    v.experiment.draw = [v, expected](const Image &image, const Camera &camera) {
        const auto cross = [](Vec2 at, Mark::Meaning meaning, std::string label) {
            return Mark{Mark::Kind::cross, at, {}, 0, meaning, std::move(label)};
        };
        return std::vector{
            cross(highlight(image, v.front_px, v.inner_px).centre_px, Mark::Meaning::measured, "front"),
            cross(highlight(image, v.inner_px, v.front_px).centre_px, Mark::Meaning::measured, "inner surface"),
            cross(image_of(camera, v.painted_mm), Mark::Meaning::expected, "the study's point")};
    };
}

/// On the orb, from the painted point to the centroid of the front highlight.
double distance_from_spot_mm(const SpotView &v, const Image &image, const Camera &camera) {
    const Vec2 at = highlight(image, v.front_px, v.inner_px).centre_px;
    return glm::length(on_surface(v.spot.orb, camera_ray(camera, at)) - v.painted_mm);
}

Experiment spot_experiment(const ClaimContext &context, int number) {
    SpotView v =
        look_at(context, fmt::format("spot-{}", number),
                fmt::format("highlights of the front and of the inner surface at spot {}", number), number, {});
    // The conclusion itself: a source out of its mirror direction makes it fail.
    const std::string on_spot = fmt::format("spot {}: distance of the front highlight from the painted spot", number);
    const double least = v.spot.parameters.number("criterion.spot_mm");
    const Names names = names_of(number);
    const std::vector<Reading> exact = read(v, names, exact_picture(v));
    v.experiment.predict = [=](const Accuracy &a) {
        std::vector<Expected> rows;
        for (const Reading &r : exact) {
            const bool light = r.quantity == names.front_light || r.quantity == names.inner_light;
            std::vector<BudgetItem> budget{
                {"tessellation", light ? 0 : 4 * a.surface_mm, "of the mirroring spheres"},
                {"quantisation", light ? 400 * a.radiance_step : 0.02 * v.pixel_mm, "of the stored picture"}};
            budget.push_back(light ? BudgetItem{"resolution", light_tolerance * r.value,
                                                "8 % of its light: by Fresnel the highlights differ by far more"}
                                   : BudgetItem{"resolution", 0.25 * v.pixel_mm, "a quarter of a pixel"});
            rows.push_back({r.quantity, light ? "px" : "mm", Relation::equal, r.value, budget});
        }
        rows.push_back({on_spot, "mm", Relation::below, least, {}});
        return rows;
    };
    v.experiment.measure = [=](const Image &image, const Camera &camera) {
        std::vector<Reading> readings = read(v, names, image);
        readings.push_back({on_spot, distance_from_spot_mm(v, image, camera)});
        return readings;
    };
    draw_highlights(v);
    return v.experiment;
}

/// On the orb, from the painted point to where the front mirrors the source.
double displacement_mm(const ClaimContext &context, int number, double offset_deg) {
    const Spot s = spot_of(context, number, {assign("source.offset_deg", offset_deg)});
    const auto front = ray_to_source(s, 0, 0);
    return front ? glm::length(on_surface(s.orb, *front) - white_spot(s.parameters, number - 1))
                 : std::numeric_limits<double>::quiet_NaN();
}

std::optional<FlipPoint> spot_flip_of(const ClaimContext &context) {
    const Spot s = spot_of(context, 1, {});
    const double least = s.parameters.number("criterion.spot_mm");
    const auto value = root_between([&](double offset) { return displacement_mm(context, 1, offset) - least; }, 0, 30);
    if (!value || *value <= 0) return std::nullopt;
    return FlipPoint{"source.offset_deg",
                     "deg",
                     *value,
                     s.parameters.number("source.offset_deg"),
                     fmt::format("a source farther from its mirror direction shows its highlight more than {:g} mm "
                                 "from spot 1",
                                 least),
                     {"spot-flip-below", "spot-flip-above"}};
}

Experiment flip_experiment(const ClaimContext &context, const BracketSide &side, double least) {
    SpotView v = look_at(context, fmt::format("spot-flip-{}", side.label),
                         fmt::format("source 1 turned just {} the flip point", side.label), 1,
                         {assign("source.offset_deg", side.value)});
    v.experiment.predict = [=](const Accuracy &) {
        return std::vector<Expected>{{"distance of the front highlight from the painted spot",
                                      "mm",
                                      side.label == "below" ? Relation::below : Relation::above,
                                      least,
                                      {}}};
    };
    v.experiment.measure = [v](const Image &image, const Camera &camera) {
        const double distance = distance_from_spot_mm(v, image, camera);
        return std::vector<Reading>{{"distance of the front highlight from the painted spot", distance}};
    };
    draw_highlights(v);
    return v.experiment;
}

/// A highlight by the closed form: where it is seen on the orb, and its share of the source's radiance.
struct Mirrored {
    Vec3 at_mm;
    double weight;
};

/// `legs`: glass legs of its order, 0 for the front surface, 2 for the inner one.
Mirrored mirrored(const Spot &spot, int legs, const LightModel &model = {}) {
    const auto ray = ray_to_source(spot, legs, 0);
    if (ray)
        for (const ExitRay &exit : exit_rays(spot.orb, *ray, 1e-4, model))
            if (exit.glass_legs == legs && exit.hollow_chords == 0) return {on_surface(spot.orb, *ray), exit.weight};
    return {Vec3(std::numeric_limits<double>::quiet_NaN()), std::numeric_limits<double>::quiet_NaN()};
}

Spot with_index(Spot spot, double index) {
    spot.orb.optics.index = index;
    return spot;
}

Spot from_beside(Spot spot, Vec2 aside_mm) {
    spot.plan.scene = seen_from_beside(spot.plan.scene, aside_mm);
    return spot;
}

/// The source moved on its own card.
Spot source_moved(Spot spot, Vec2 by_mm) {
    for (Object &object : spot.plan.scene.objects)
        if (Quad *card = std::get_if<Quad>(&object.shape))
            card->centre_mm += by_mm.x * glm::normalize(card->half_u_mm) + by_mm.y * glm::normalize(card->half_v_mm);
    return spot;
}

/// How each effect moves one number of a spot. The same plane of incidence holds all of a highlight's way.
EffectBounds highlight_bounds(const Spot &spot, const ScopeSettings &settings, double source_mm, bool of_light,
                              const std::function<double(const Spot &, const LightModel &)> &number) {
    const auto by_model = [&](const LightModel &model) { return number(spot, model); };
    const IndexBounds index =
        by_index(spot.orb.optics.index, settings, [&](double n) { return number(with_index(spot, n), {}); });
    const Bound polarisation = of_light ? by_polarisation(by_model) : directions_know_no_polarisation();
    const Bound birefringence =
        of_light ? with_exchange(index.birefringence, settings, 2 * spot.orb.optics.wall_mm, polarisation.value)
                 : index.birefringence;
    const LitBounds lit = nothing_is_lit(spot.plan.scene);
    return {.polarisation = polarisation,
            .dispersion = index.dispersion,
            .absorption = of_light ? by_absorption(settings, by_model) : directions_know_no_absorption(),
            .birefringence = birefringence,
            .light_size = over_disc(source_mm, fmt::format("source of {:g} degrees,", settings.light_deg),
                                    [&](Vec2 by) { return number(source_moved(spot, by), {}); }),
            .caustics = lit.caustics,
            .interreflection = lit.interreflection,
            .pupil = by_pupil(settings, [&](Vec2 aside) { return number(from_beside(spot, aside), {}); })};
}

std::vector<ScopeNumber> spot_scope(const ClaimContext &context, const ScopeSettings &settings) {
    std::vector<ScopeNumber> numbers;
    for (int number = 1; number <= spot_count; ++number) {
        const SpotView v = look_at(context, "", "", number, {});
        const Spot &spot = v.spot;
        const double least = spot.parameters.number("criterion.spot_mm");
        const double source_mm = 2 * spot.parameters.number("source.distance_mm") *
                                 std::tan(settings.light_deg / 2 * std::numbers::pi / 180);
        const auto distance = [&](const Spot &s, const LightModel &) {
            return glm::length(mirrored(s, 0).at_mm - v.painted_mm);
        };
        const auto apart = [](const Spot &s, const LightModel &) {
            return glm::length(mirrored(s, 2).at_mm - mirrored(s, 0).at_mm);
        };
        const auto light = [](int legs) {
            return [legs](const Spot &s, const LightModel &model) { return mirrored(s, legs, model).weight; };
        };
        const double off = distance(spot, {}), between = apart(spot, {});
        const auto add = [&](const std::string &what, const std::string &unit, double value, double margin,
                             const std::string &margin_is, bool of_light, const auto &f) {
            numbers.push_back({fmt::format("spot {}: {}", number, what), unit, value, margin, margin_is,
                               highlight_bounds(spot, settings, source_mm, of_light, f)});
        };
        add("distance of the front highlight from the painted spot", "mm", off, margin_to(off, {least}),
            margin_words({least}, "mm"), false, distance);
        add("distance between both highlights", "mm", between, 0.5 * v.pixel_mm, margin_is_tolerance, false, apart);
        for (const int legs : {0, 2}) {
            const double weight = mirrored(spot, legs).weight;
            add(fmt::format("light of the {} highlight over its source's", legs == 0 ? "front" : "inner"), "", weight,
                light_tolerance * weight, margin_is_tolerance, true, light(legs));
        }
    }
    return numbers;
}

} // namespace

Claim claim_white_spots() {
    Claim claim;
    claim.name = "white-spots";
    claim.statement =
        "The three white specks fall where the front of the orb mirrors sources in the stated directions, "
        "each with a weaker highlight of the inner surface beside it.";
    claim.experiments = [](const ClaimContext &context) {
        std::vector<Experiment> all;
        for (int number = 1; number <= spot_count; ++number) all.push_back(spot_experiment(context, number));
        if (const auto flip = spot_flip_of(context)) {
            const double least = spot_of(context, 1, {}).parameters.number("criterion.spot_mm");
            for (const BracketSide &side : bracket_of(flip->value))
                all.push_back(flip_experiment(context, side, least));
        }
        return all;
    };
    claim.summary = [](const ClaimContext &, Verdict verdict) -> std::string {
        switch (verdict) {
        case Verdict::holds:
            return "Small sources in the mirror directions show their highlights at the three specks, and a hollow "
                   "glass orb doubles each of them: its inner surface shows a second one just beside it.";
        case Verdict::fails:
            return "Some renderer, or exact optics, puts a highlight elsewhere or gives it another brightness.";
        case Verdict::undecided:
            return "It is not settled where the highlights fall.";
        }
        return "";
    };
    claim.notes = [](const ClaimContext &context) {
        std::vector<std::string> notes;
        for (int number = 1; number <= spot_count; ++number) {
            const Spot s = spot_of(context, number, {});
            const Vec3 painted = white_spot(s.parameters, number - 1);
            std::string text = fmt::format("Spot {} at ({:.2f}, {:.2f}) mm:", number, painted.x, painted.y);
            struct Surface {
                int legs, chords;
                std::string_view name;
            };
            for (const Surface &surface : {Surface{0, 0, "front"}, Surface{2, 0, "inner front"},
                                           Surface{2, 2, "inner rear"}, Surface{4, 2, "rear"}})
                if (const auto ray = ray_to_source(s, surface.legs, surface.chords))
                    for (const ExitRay &exit : exit_rays(s.orb, *ray, 1e-4))
                        if (exit.glass_legs == surface.legs && exit.hollow_chords == surface.chords) {
                            const Vec3 at = on_surface(s.orb, *ray);
                            text += fmt::format(" {} surface ({:.2f}, {:.2f}) mm, {:.2f} % of the source's radiance;",
                                                surface.name, at.x, at.y, 100 * exit.weight);
                        }
            text.back() = '.';
            notes.push_back(text);
        }
        return notes;
    };
    claim.flips = [](const ClaimContext &context) {
        const auto flip = spot_flip_of(context);
        return flip ? std::vector{*flip} : std::vector<FlipPoint>{};
    };
    claim.scope = spot_scope;
    claim.mutant = Fault::camera_one_pixel;
    return claim;
}

} // namespace threefold
