// SPDX-License-Identifier: MIT
// By how much a straight line on a plane behind an orb seems to jump where it crosses the orb's boundary: the closed
// form. World frame, millimetres.
//
// A wall bends rays outwards without bound as the impact parameter b nears the inner radius, so a jump "at the boundary
// itself" does not exist: just there every line is seen to run along the radius. The jump is therefore defined at
// stated circles. A circle is the set of rays from the eye with one impact parameter b about the orb's centre. On a
// circle inside the hollow, find the ray that the orb sends onto the line, and follow it *straight* to the plane: there
// the line seems to be. The jump is the distance of this point from the line, positive to the left of one who walks
// along it outwards. The continuation from outside is the line itself, since outside nothing is bent. With eye, centre
// and the plane's foot on one axis, a line that passes the foot by m jumps by m (1 - s/h) towards the foot, where the
// ray would land at s from it without the orb and lands at h: nothing for m = 0, at any wall and glass.
#pragma once

#include <optional>
#include <vector>

#include "scenes/camera.h"
#include "verifier/claims/prediction.h"

namespace threefold {

/// An edge of a fold: a straight line on the robe, from its start outwards.
struct FoldEdge {
    Vec3 start_mm, end_mm;
};

struct Fold {
    FoldEdge left, right;
};

/// What the closed form needs of a scene with folds.
struct FoldScene {
    OrbInScene orb;
    Vec3 eye_mm;
    std::vector<Fold> folds; ///< from left to right; the first is the one that need not be aimed
};

/// Reads the folds from the corners of the mesh named "folds" (scene_folds.cpp); Error(internal) when there is none.
FoldScene fold_scene_of(const Scene &scene);

/// The ray from the eye with this impact parameter about the orb's centre, `azimuth_rad` from image right towards up.
Ray ray_on_circle(const FoldScene &scene, double impact_mm, double azimuth_rad);

/// Where a point lies along the edge (x, from its start) and to the left of it (y).
Vec2 along_across(const FoldEdge &edge, Vec3 point_mm);

/// Where the ray would meet the edge's plane without the orb, in the edge's frame.
Vec2 straight_place(const FoldEdge &edge, const Ray &ray);

/// The azimuth on the circle where the edge is seen, through the orb or beside it. Nothing where it is not seen there:
/// the ray finds no way through, or the edge does not reach so far.
std::optional<double> edge_azimuth(const FoldScene &scene, const FoldEdge &edge, double impact_mm);

/// The jump (mm on the robe) by the closed form: its mean over the circles.
std::optional<double> edge_jump(const FoldScene &scene, const FoldEdge &edge, const std::vector<double> &circles_mm);

/// Of a fold: the mean of its two edges'.
std::optional<double> fold_jump(const FoldScene &scene, const Fold &fold, const std::vector<double> &circles_mm);

} // namespace threefold
