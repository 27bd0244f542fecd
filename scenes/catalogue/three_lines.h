// SPDX-License-Identifier: MIT
// What the three-lines scenes share (figure 4 of the study): a gridded card behind an orb, and just before the card
// three straight dark lines that rise to the right, the middle one through the axis of eye and orb. Millimetres.
// Surfaces show what a diffuse surface shows in unoccluded, uniform surroundings: reflectance times their radiance.
#pragma once

#include "scenes/catalogue/common.h"

namespace threefold {

/// What `text` and `published` say of the orb, the eye and the surroundings of these scenes.
Specs three_lines_orb_parameters(bool hollow);
Specs three_lines_parameters(double half_length_mm);
Specs three_lines_image_parameters();

/// The card, before it the lines. With `lines.paint=probe` the lines alone, soft and each dark in one colour (upper
/// red, middle green, lower blue): their centres can be told apart and read to a small part of a pixel.
std::vector<Object> three_lines_objects(const Parameters &p);
/// The same with the middle line bent: lines.bend_beyond_mm beyond the orb's edge, as far from the axis to the upper
/// right, it goes on to the right. The probe is the bent line alone.
std::vector<Object> bent_lines_objects(const Parameters &p);

/// Of the probe, from 0 to 1: 1 on a line's centre, 1/2 at its half-width, 0 from `soft_reach` half-widths on.
double soft_darkness(double from_centre_mm, double half_width_mm);
inline constexpr double soft_reach = 2;

} // namespace threefold
