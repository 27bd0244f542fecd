// SPDX-License-Identifier: MIT
// What a viewing ray sees in an orb when every order of reflection is counted: the closed form of a whole pixel, for
// Fresnel glass, in a scene of one orb, an environment and emissive rectangles. World frame, millimetres.
#pragma once

#include <vector>

#include "verifier/claims/prediction.h"

namespace threefold {

/// One order of the light, seen backwards: where the viewing ray goes on outside the orb, and with what share.
struct ExitRay {
    Ray ray;
    double weight;
    int glass_legs, hollow_chords; ///< as in optics::Order; 0 and 0: reflected outside, or no orb in the way
};

/// What of light a prediction follows. As it stands: what renderers do.
struct LightModel {
    optics::Polarisation polarisation = optics::Polarisation::unpolarised;
    double absorption_per_mm = 0; ///< natural logarithm
};

/// All of them, up to `remaining_weight` of the light; the tint of the glass and what it absorbs are in the weights.
std::vector<ExitRay> exit_rays(const OrbInScene &orb, const Ray &ray, double remaining_weight = 1e-7,
                               const LightModel &model = {});

/// The ray turned about the orb's centre, from where it leaves the orb. `turn_rad` is positive towards the axis.
Ray turned_about_orb(const OrbInScene &orb, const Ray &ray, double turn_rad);

/// The nearest rectangle's radiance (mean of the channels), or the environment's.
double radiance_outside(const Scene &scene, const Ray &ray);

/// Mean over all orders.
double predicted_radiance(const Scene &scene, const OrbInScene &orb, const Ray &ray, const LightModel &model = {});

} // namespace threefold
