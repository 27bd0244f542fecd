// SPDX-License-Identifier: MIT
// The generated half figure: at each place of the picture a height and a colour. It is no copy of the painting that the
// study rendered, only of its kind: a blessing figure in a blue robe with crossed golden bands, and five folds above
// the orb.
// Units: half the picture's width (places and heights alike); x right, y up, the picture's middle is (0, 0); heights
// are measured from the robe's plane towards the eye. Colours are linear reflectances.
#pragma once

#include <array>

#include "scenes/figure/drawing.h"

namespace threefold::figure {

/// The picture's composition (the study's film: 21.271 degrees over 1408 x 2072 pixels).
inline constexpr double picture_height = 2072.0 / 1408;
/// What the relief covers of it; the rest is the black ground behind.
inline constexpr Vec2 relief_low{-0.965, -1.44}, relief_high{0.965, 1.36};
/// Where the orb appears, and its radius at the orb's distance.
inline constexpr Vec2 orb_place{0.6363, -1.0389};
inline constexpr double orb_size = 0.3016;

/// A place read off a sketch of 896 x 1319 points, row 0 on top.
inline constexpr Vec2 sketch(double column, double row) { return {(column - 448) / 448, (659.5 - row) / 448}; }

/// The crest of a fold: a straight line from `inner` to `outer`, seen from the eye.
struct Fold {
    Vec2 inner, outer;
    bool aimed; ///< at the orb's centre
};

/// From left to right where they cross the orb's boundary. The leftmost is not aimed at the centre.
std::array<Fold, 5> five_folds();

struct Spot {
    double height = 0;
    Rgb colour{0.003, 0.003, 0.003};

    /// Lays something over it.
    void cover(double share, double over_height, Rgb over_colour) {
        height = mix(height, over_height, share);
        colour = mix(colour, over_colour, share);
    }
};

class Painting {
public:
    Painting();
    Spot at(Vec2 p) const;

private:
    void paint_chest(Vec2 p, Spot &spot) const;
    void paint_robe(Vec2 p, Spot &spot) const;
    void paint_bands(Vec2 p, Spot &spot) const;
    void paint_hair(Vec2 p, Spot &spot) const;
    void paint_face(Vec2 p, Spot &spot) const;
    void paint_sleeve(Vec2 p, Spot &spot) const;
    void paint_blessing_hand(Vec2 p, Spot &spot) const;

    Outline body_, chest_, hair_, face_, cuff_;
    std::vector<Vec2> left_band_, right_band_, neck_band_;
    std::vector<Vec2> parting_left_, parting_right_;
};

/// Height that the five folds add.
double fold_height(Vec2 p);

} // namespace threefold::figure
