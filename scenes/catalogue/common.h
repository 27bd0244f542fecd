// SPDX-License-Identifier: MIT
// What the catalogue's scenes share: parameters with both presets, and the view of an orb at the origin.
// The eye is on +z and looks towards -z; image right is +x; the card stands behind the orb, across the axis.
#pragma once

#include "scenes/parameters.h"

namespace threefold {

using Specs = std::vector<ParameterSpec>;

inline constexpr double tiny_mm = 1e-9, huge_mm = 1e9; ///< the least and the greatest length of a parameter

Specs orb_parameters();   ///< orb.radius_mm, orb.shift_mm
Specs wall_parameters();  ///< orb.wall_mm
Specs glass_parameters(); ///< glass.index, glass.interface_transmittance, glass.coating
Specs view_parameters();  ///< eye.distance_mm, image.width_px, image.height_px, image.orb_share
Specs card_parameters();  ///< card.distance_mm, card.half_width_mm, card.surface
Specs environment_parameters(double radiance);

/// A number with its value under each preset and its range; or with one value for both.
ParameterSpec number_parameter(std::string name, std::string description, double text, double published, double least,
                               double greatest);
ParameterSpec number_parameter(std::string name, std::string description, double value, double least, double greatest);

Specs join(std::initializer_list<Specs> parts);

Vec3 orb_centre(const Parameters &p);
Glass make_glass(const Parameters &p);
GlassBall make_ball(const Parameters &p);
GlassShell make_shell(const Parameters &p);
/// The orb's silhouette fills `image.orb_share` of the film's width whatever the eye's distance.
Camera make_camera(const Parameters &p);
/// The emissive card behind the orb: coordinate probe or robe.
Quad make_card(const Parameters &p);
/// None where the card is the coordinate probe: its ratios are read in the dark.
std::optional<Environment> make_environment(const Parameters &p);

} // namespace threefold
