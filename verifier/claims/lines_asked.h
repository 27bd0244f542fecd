// SPDX-License-Identifier: MIT
// What the claim three-lines asks of its lines: everything that prediction, measuring, drawing and scope share.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "verifier/claims/line_crossing.h"

namespace threefold {

inline constexpr double inside_share = 0.9; ///< of the clear radius: the inner circle
/// Nearer to the boundary for the bent line: only there it is seen beyond its bend, the first of these at which it is.
inline constexpr std::array inside_shares_bent{0.95, 0.96, 0.97, 0.98, 0.985, 0.99, 0.9925, 0.995};
inline constexpr double outside_share = 1.05; ///< of the outer radius: the outer circle

struct NamedLine {
    std::string name;
    int channel;
    SoftLine line;
};

struct LinesAsked {
    LinesView view;
    std::vector<NamedLine> lines;
    double acuity_arcmin = 1;
    double picture_px_mm = 1; ///< a pixel of the scene's own picture, on the lines' plane

    /// What a jump is for the eye; never negative.
    double arcmin(const Camera &camera, double jump_mm) const;
};

LinesAsked asked_of(const Experiment &e);
double number_of(const Experiment &e, const std::string &name);

/// A scene of lines in the colours that are measured.
Experiment lines_probe(const ClaimContext &context, std::string name, std::string title, std::string_view scene,
                       std::vector<Assignment> fixed);

} // namespace threefold
