// SPDX-License-Identifier: MIT
// How a line behind an orb crosses the orb's boundary, by the closed forms: places on circles of fixed impact
// parameter, in mm on the line's plane as the eye projects them. World frame, millimetres.
#pragma once

#include <optional>

#include "verifier/claims/claim.h"
#include "verifier/claims/prediction.h"
#include "verifier/measure/dark_line.h"

namespace threefold {

/// Both circles on which a line's centre is read, as impact parameters, and the direction in which it crosses them.
struct CrossingCircles {
    double inside_mm, outside_mm;
    double azimuth_rad; ///< where the middle line crosses, were it straight
};

/// One soft line in a plane before the card.
struct SoftLine {
    double apart_mm = 0; ///< of its centre from the middle one, across
    double half_width_mm = 1;
    std::optional<double> bend_mm; ///< from the axis, along the line; from there it goes on to image right
};

/// The lines' plane with the scale across them, the direction along them and what stands before it.
struct LinesView {
    OrbInScene orb;
    PlaneScale scale;
    Vec3 along;
    CrossingCircles circles;

    double plane_distance_mm(const Camera &camera) const;
};

/// Signed distance (mm, towards the upper side) of a point in the plane from a line's centre.
double distance_from(const LinesView &view, const SoftLine &line, Vec3 point_mm);

/// Azimuth on the circle at which a ray lands this far from the line's centre: on a path through the orb, or past it.
std::optional<double> azimuth_of(const LinesView &view, const Camera &camera, const SoftLine &line, double impact_mm,
                                 double off_centre_mm);

/// By how many millimetres the distance from the line's centre changes over a pixel of the picture, where the line is
/// seen on the circle: steep where the orb squeezes what lies behind it. Nothing where it is not seen.
std::optional<double> mm_over_a_pixel(const LinesView &view, const Camera &camera, const SoftLine &line,
                                      double impact_mm);

/// On which of a bent line's arms does it, with all its soft width, meet the circle? Where on both, what is read there
/// is no place of one.
enum class Arm { none, before_bend, beyond_bend, both };
Arm arm_on(const LinesView &view, const Camera &camera, const SoftLine &line, double impact_mm);

/// Place of the line's centre of darkness on a circle: what a picture of it is measured to be.
std::optional<double> predicted_place(const LinesView &view, const Camera &camera, const SoftLine &line,
                                      double impact_mm);

/// Place on the inner circle minus place on the outer one; NaN where the line is not seen on one of them. For a
/// straight line `apart_mm` beside the axis, with eye, centre and plane in line, it is apart * (m - 1), m = straight
/// landing / landing of a ray on the inner circle: the orb's magnification there.
double predicted_jump(const LinesView &view, const Camera &camera, const SoftLine &line);

} // namespace threefold
