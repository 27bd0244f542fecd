// SPDX-License-Identifier: MIT
// What the closed forms say about a whole scene: the bridge between the vocabulary and verifier/optics/.
#pragma once

#include <optional>

#include "scenes/camera.h"
#include "verifier/optics/concentric.h"

namespace threefold {

/// The first orb of a scene, in the closed forms' terms.
struct OrbInScene {
    Vec3 centre_mm;
    optics::Orb<double> optics;
    Glass glass;

    /// A ray with a smaller impact parameter goes straight through: the inner radius, or the outer one of a ball.
    double clear_radius_mm() const { return optics.is_solid() ? optics.outer_mm : optics.inner_mm; }
};

/// Throws Error(internal) when there is none.
OrbInScene orb_of(const Scene &scene);
/// The first rectangle of a scene; Error(internal) when there is none.
const Quad &card_of(const Scene &scene);

double impact_parameter(const Ray &ray, Vec3 centre_mm);

/// Where the ray lands on the card's plane by the straight-through path of its orb; nothing when it does not.
std::optional<Vec3> predicted_landing(const OrbInScene &orb, const Quad &card, const Ray &ray);
bool on_card(const Quad &card, Vec3 point_mm, double margin_mm = 0);

/// The same view in at most 128 pixels a side: enough for what is computed before rendering.
Scene coarse(Scene scene);

/// Mean radiance of the picture by the straight-through path alone, the rest of the light coming from the environment:
/// good to a few per cent, and known before any pixel exists.
double predicted_mean_radiance(const Scene &scene);

/// How far the landing point moves when a ray is displaced sideways by one unit at the orb: the q-quantile over the
/// pixels whose impact parameter is under `clear_share` of the clear radius.
double landing_leverage(const Scene &scene, double clear_share, double q);

/// Mean over a ring [from, to] of the impact parameter (area-weighted) of the weight that a tree of rays loses when its
/// branches are cut at `cut_weight`.
double mean_missing_weight(const OrbInScene &orb, double from_mm, double to_mm, double cut_weight);

} // namespace threefold
