// SPDX-License-Identifier: MIT
#include "verifier/claims/scope_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scenes/error.h"

namespace threefold {

namespace {

/// NaN is the greatest: what could not be told may be anything.
double greater(double a, double b) {
    return std::isnan(a) || std::isnan(b) ? std::numeric_limits<double>::infinity() : std::max(a, b);
}

struct Span {
    double greatest_change, least, most;
};

Span span_of(double here, const std::vector<double> &indices, const std::function<double(double)> &number) {
    Span span{0, here, here};
    for (const double index : indices) {
        const double value = number(std::max(1.0, index));
        span.greatest_change = greater(span.greatest_change, std::abs(value - here));
        span.least = std::min(span.least, value);
        span.most = std::max(span.most, value);
    }
    return span;
}

} // namespace

ClaimContext with(ClaimContext context, const std::vector<Assignment> &more) {
    context.assignments.insert(context.assignments.end(), more.begin(), more.end());
    return context;
}

IndexBounds by_index(double index, const ScopeSettings &settings, const std::function<double(double index)> &number) {
    const double here = number(index);
    const auto at = [&](double nm) { return optics::index_at_wavelength(index, settings.abbe_number, nm); };
    const double least = settings.least_wavelength_nm, greatest = settings.greatest_wavelength_nm;
    constexpr int colours = 7;
    std::vector<double> spectrum;
    for (int k = 0; k < colours; ++k) spectrum.push_back(at(least + (greatest - least) * k / (colours - 1)));
    const Span colour = span_of(here, spectrum, number);
    const double strain = optics::strain_index_difference(settings.strain_nm_per_cm);
    const Span strained = span_of(here, {index - strain, index + strain}, number);
    return {{colour.greatest_change,
             fmt::format("the closed form at the indices {:.5f} ({:g} nm) to {:.5f} ({:g} nm), Abbe number {:g} by "
                         "Cauchy's two terms: {:.4g} to {:.4g}",
                         at(least), least, at(greatest), greatest, settings.abbe_number, colour.least, colour.most)},
            {strained.greatest_change,
             fmt::format("strained glass of {:g} nm/cm has two indices {:.1g} apart: the closed form at either",
                         settings.strain_nm_per_cm, strain)}};
}

Bound with_exchange(Bound birefringence, const ScopeSettings &settings, double glass_mm, double polarisation) {
    const double difference_nm = settings.strain_nm_per_cm * glass_mm / 10;
    const double share = optics::exchanged_share(difference_nm, settings.least_wavelength_nm);
    birefringence.value += 4 * share * std::abs(polarisation);
    birefringence.why +=
        fmt::format("; over {:.3g} mm of glass a crossing, strain exchanges at most {:.2g} of s and p, "
                    "which moves it by four times that share of what polarisation does",
                    glass_mm, share);
    return birefringence;
}

std::vector<Vec2> disc_points(double diameter_mm) {
    std::vector<Vec2> points{Vec2(0)};
    const double r = std::sqrt(2.0 / 3) * diameter_mm / 2;
    for (int k = 0; k < 6; ++k) {
        const double angle = k * std::numbers::pi / 3;
        points.push_back(r * Vec2(std::cos(angle), std::sin(angle)));
    }
    return points;
}

Bound by_pupil(const ScopeSettings &settings, const std::function<double(Vec2 aside_mm)> &number) {
    return over_disc(settings.pupil_mm, "pupil", number);
}

Bound over_disc(double diameter_mm, const std::string &what, const std::function<double(Vec2 aside_mm)> &number) {
    double mean = 0, here = 0, farthest = 0;
    bool first = true;
    for (const Vec2 &point : disc_points(diameter_mm)) {
        const double value = number(point);
        if (first) here = value;
        mean += value * (first ? 1.0 / 4 : 1.0 / 8);
        farthest = greater(farthest, std::abs(value - here));
        first = false;
    }
    const double change = std::abs(mean - here);
    return {
        std::isnan(change) ? std::numeric_limits<double>::infinity() : change,
        fmt::format("the closed form, mean over seven points of a {} of {:.3g} mm; at any one of them it differs by "
                    "at most {:.2g}",
                    what, diameter_mm, farthest)};
}

Ray from_pupil(const Ray &ray, const CameraFrame &frame, Vec2 aside_mm, double distance_mm) {
    const double along = distance_mm / glm::dot(ray.direction, frame.forward);
    const Vec3 focus = ray.origin_mm + along * ray.direction;
    const Vec3 from = ray.origin_mm + aside_mm.x * frame.right + aside_mm.y * frame.up;
    return {from, glm::normalize(focus - from)};
}

Scene seen_from_beside(Scene scene, Vec2 aside_mm) {
    const CameraFrame frame = camera_frame(scene.camera);
    scene.camera.eye_mm += aside_mm.x * frame.right + aside_mm.y * frame.up;
    return scene;
}

double carried(const std::function<double(const LightModel &)> &number) {
    return (number({optics::Polarisation::s, 0}) + number({optics::Polarisation::p, 0})) / 2;
}

Bound by_polarisation(const std::function<double(const LightModel &)> &number) {
    const double here = number({}), truth = carried(number);
    return {greater(0, std::abs(truth - here)),
            fmt::format("all surfaces of an orb share a ray's plane of incidence, so s and p keep apart: the mean of "
                        "both, {:.4g}, in place of {:.4g}",
                        truth, here)};
}

Bound by_absorption(const ScopeSettings &settings, const std::function<double(const LightModel &)> &number) {
    const double here = number({});
    const double there = number({optics::Polarisation::unpolarised, settings.absorption_per_mm});
    return {greater(0, std::abs(there - here)),
            fmt::format("each order of light weakened by exp(-{:g} per mm times its way in the glass): {:.4g} in place "
                        "of {:.4g}",
                        settings.absorption_per_mm, there, here)};
}

Scene with_discs(Scene scene, double light_deg) {
    std::vector<Directional> lights;
    for (const Directional &light : scene.lights) {
        const Vec3 d = glm::normalize(light.travel);
        const Vec3 aside = glm::normalize(glm::cross(std::abs(d.y) < 0.9 ? Vec3(0, 1, 0) : Vec3(1, 0, 0), d));
        bool middle = true;
        for (const Vec2 &at : disc_points(2 * std::tan(light_deg / 2 * std::numbers::pi / 180))) {
            lights.push_back(
                {d + at.x * aside + at.y * glm::cross(d, aside), light.irradiance * (middle ? 0.25 : 0.125)});
            middle = false;
        }
    }
    scene.lights = lights;
    return scene;
}

LitBounds nothing_is_lit(const Scene &scene) {
    bool lit = !scene.lights.empty();
    for (const Object &object : scene.objects)
        std::visit(overloaded{
                       [](const GlassBall &) {},
                       [](const GlassShell &) {},
                       [&](const Quad &quad) { lit = lit || std::holds_alternative<Diffuse>(quad.surface); },
                       [&](const Mesh &mesh) { lit = lit || std::holds_alternative<Diffuse>(mesh.surface); },
                   },
                   object.shape);
    if (lit) throw Error(Exit::internal, "a claim said that nothing in its scene is lit, and something is");
    return {Bound::none("no light shines in its scene: what is seen emits by itself, or is the same all around"),
            Bound::none("nothing in its scene can be lit: all surfaces emit and reflect nothing"),
            Bound::none("nothing in its scene can be lit: all surfaces emit and reflect nothing")};
}

EffectBounds none_of_them(const std::string &why) {
    const Bound none = Bound::none(why);
    return {.polarisation = none,
            .dispersion = none,
            .absorption = none,
            .birefringence = none,
            .light_size = none,
            .caustics = none,
            .interreflection = none,
            .pupil = none};
}

Bound directions_know_no_polarisation() {
    return Bound::none("it is read from where rays go; Snell's law and total reflection are the same for s and p");
}

Bound directions_know_no_absorption() {
    return Bound::none("it is read from where rays go, not from how much light they carry");
}

EffectBounds of_directions(const Scene &scene, const IndexBounds &index, const Bound &pupil) {
    const LitBounds lit = nothing_is_lit(scene);
    return {.polarisation = directions_know_no_polarisation(),
            .dispersion = index.dispersion,
            .absorption = directions_know_no_absorption(),
            .birefringence = index.birefringence,
            .light_size = lit.light_size,
            .caustics = lit.caustics,
            .interreflection = lit.interreflection,
            .pupil = pupil};
}

EffectBounds of_light(const Scene &scene, const OrbInScene &orb, const ScopeSettings &settings, double glass_mm,
                      const std::function<double(const OrbInScene &, const LightModel &, Vec2)> &number) {
    const auto by_model = [&](const LightModel &model) { return number(orb, model, Vec2(0)); };
    const IndexBounds index = by_index(orb.optics.index, settings, [&](double n) {
        OrbInScene changed = orb;
        changed.optics.index = n;
        return number(changed, {}, Vec2(0));
    });
    const Bound polarisation = by_polarisation(by_model);
    const LitBounds lit = nothing_is_lit(scene);
    return {.polarisation = polarisation,
            .dispersion = index.dispersion,
            .absorption = by_absorption(settings, by_model),
            .birefringence = with_exchange(index.birefringence, settings, glass_mm, polarisation.value),
            .light_size = lit.light_size,
            .caustics = lit.caustics,
            .interreflection = lit.interreflection,
            .pupil = by_pupil(settings, [&](Vec2 aside) { return number(orb, {}, aside); })};
}

double margin_to(double value, Threshold threshold) { return std::abs(value - threshold.at); }

std::string margin_words(Threshold threshold, const std::string &unit) {
    return fmt::format("to the threshold {:.4g}{}{}", threshold.at, unit.empty() ? "" : " ", unit);
}

Expected expected_row(const Experiment &e, const std::string &quantity) {
    const std::vector<Expected> rows = e.predict(reference_accuracy());
    const auto found = std::ranges::find(rows, quantity, &Expected::quantity);
    if (found == rows.end())
        throw Error(Exit::internal, "a claim's scope asked for a row that it has not: " + quantity);
    return *found;
}

} // namespace threefold
