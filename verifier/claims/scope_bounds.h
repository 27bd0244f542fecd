// SPDX-License-Identifier: MIT
// What the scopes of all claims share: how a closed form answers to the index, to the pupil, to polarisation.
#pragma once

#include <functional>

#include "verifier/claims/claim.h"
#include "verifier/claims/orb_light.h"

namespace threefold {

/// The context with more assignments, after the user's own.
ClaimContext with(ClaimContext context, const std::vector<Assignment> &more);

/// Both move the index of the glass: `number` is asked at indices over the visible range, and at those that strain
/// makes.
struct IndexBounds {
    Bound dispersion, birefringence;
};
IndexBounds by_index(double index, const ScopeSettings &settings, const std::function<double(double index)> &number);

/// Of a number that is a share of light. Strain also turns one polarisation into the other: on each of two crossings of
/// glass at most the exchanged share of `glass_mm`; an exchange can undo no more than twice what `polarisation` adds.
Bound with_exchange(Bound birefringence, const ScopeSettings &settings, double glass_mm, double polarisation);

/// The mean of the number over the pupil, minus that of its middle. `number` is asked for pinholes beside the eye, by
/// millimetres to image right and up; the picture of a pupil is the mean of its pinholes' pictures, so for shares of
/// light and centres of lines this is the effect itself. Seven points, exact for polynomials to the fifth degree
/// (Stroud 1971, S2 5-1).
Bound by_pupil(const ScopeSettings &settings, const std::function<double(Vec2 aside_mm)> &number);
/// The same of any disc that takes the place of a point.
Bound over_disc(double diameter_mm, const std::string &what, const std::function<double(Vec2 aside_mm)> &number);
/// Its seven points, the middle first; weights 1/4, and 1/8 each.
std::vector<Vec2> disc_points(double diameter_mm);

/// The ray from a point of the pupil that meets a ray of the pinhole where the eye is focused, `distance_mm` ahead.
Ray from_pupil(const Ray &ray, const CameraFrame &frame, Vec2 aside_mm, double distance_mm);
/// The scene seen by a pinhole beside the eye, which looks at the same target.
Scene seen_from_beside(Scene scene, Vec2 aside_mm);

/// Unpolarised light whose s and p go their own way: the mean of both models.
double carried(const std::function<double(const LightModel &)> &number);
Bound by_polarisation(const std::function<double(const LightModel &)> &number);
Bound by_absorption(const ScopeSettings &settings, const std::function<double(const LightModel &)> &number);

/// Every light of the scene as seven over its disc (disc_points). A dome's lights stand for all around and have none.
Scene with_discs(Scene scene, double light_deg);

/// Where nothing in the scene is lit: no surface in it is diffuse and no light shines. Error(internal) where that is
/// not so.
struct LitBounds {
    Bound light_size, caustics, interreflection;
};
LitBounds nothing_is_lit(const Scene &scene);

/// Of a claim whose numbers no light makes, or none that could change: the same answer to every effect.
EffectBounds none_of_them(const std::string &why);

/// Numbers about directions and places: refraction knows neither polarisation nor losses.
Bound directions_know_no_polarisation();
Bound directions_know_no_absorption();

/// Of a number about directions and places, in a scene where nothing is lit.
EffectBounds of_directions(const Scene &scene, const IndexBounds &index, const Bound &pupil);
/// Of a share of light, in a scene where nothing is lit: `number` is asked for other orbs in the same place of the
/// film, for other models of light, and for pinholes beside the eye. `glass_mm`: with_exchange.
EffectBounds of_light(const Scene &scene, const OrbInScene &orb, const ScopeSettings &settings, double glass_mm,
                      const std::function<double(const OrbInScene &, const LightModel &, Vec2 aside_mm)> &number);

/// A conclusion that a number lies on one side of a threshold.
struct Threshold {
    double at;
};
double margin_to(double value, Threshold threshold);
std::string margin_words(Threshold threshold, const std::string &unit);
inline const std::string margin_is_tolerance = "its tolerance";

/// The closed form's value and tolerance of a row, as check would tell them to an exact renderer.
Expected expected_row(const Experiment &e, const std::string &quantity);

} // namespace threefold
