// SPDX-License-Identifier: MIT
// A conclusion that can be checked: what to render, what the closed form predicts, how a picture is measured. No claim
// knows which renderer makes a picture. A claim is added by a file claim_NAME.cpp and a line in claims.cpp.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "exporter/image/image.h"
#include "exporter/job.h"
#include "scenes/parameters.h"
#include "verifier/agreement/equivalence.h"
#include "verifier/agreement/result.h"
#include "verifier/claims/fault.h"
#include "verifier/claims/scope.h"

namespace threefold {

/// What the closed form says of one number, and how far a renderer may be from it, before anything is rendered.
struct Expected {
    std::string quantity, unit;
    Relation relation = Relation::equal;
    double value = 0;
    std::vector<BudgetItem> budget; ///< its total is the tolerance; empty for `below` and `above`
    bool between_renderers = false; ///< also compared between each pair, within the sum of both tolerances
};

/// One number read from one picture.
struct Reading {
    std::string quantity;
    double value;
};

/// One scene of a claim, rendered K times by every renderer; or only looked at, as each renderer would be given it.
struct Experiment {
    std::string name;  ///< "solid-map"
    std::string title; ///< for people
    ExperimentRecord record;
    Scene scene;
    Sampling sampling = Sampling::box;
    int samples_per_pixel = 16; ///< a renderer with random branches takes several times as many
    int replicates = 8;
    /// Replicates look through different points of each pixel (for one ray a pixel, so that they are independent).
    bool shift_replicates = false;
    double surface_tolerance_mm = 0; ///< as of RenderJob
    double cut_weight = 1e-6;

    std::function<std::vector<Expected>(const Accuracy &)> predict;
    /// Instead of rendering: numbers that stand in the scene itself, without noise (`predict` is asked about an exact
    /// Accuracy). Nothing is rendered, and none of what follows is used.
    std::function<std::vector<Reading>(const Scene &)> inspect;
    /// `camera` is that of the replicate: film offset included.
    std::function<std::vector<Reading>(const Image &, const Camera &camera)> measure;
    /// A number that takes two pictures: the name of an earlier experiment of this claim with the same camera, sampling
    /// and replicates, whose picture of the same replicate `measure_pair` gets too.
    std::string partner;
    std::function<std::vector<Reading>(const Image &, const Image &of_partner, const Camera &camera)> measure_pair;
    /// Tolerance on the mean of a tile (absolute radiance); empty function: pictures are not compared tile by tile.
    std::function<std::vector<BudgetItem>(const Accuracy &, const Accuracy &)> tile_budget;
    int tile_px = 8;
    double tiles_needed_share = 1; ///< of all tiles must hold
    /// What was measured on the picture, and what was expected, to be drawn on it in the report.
    std::function<std::vector<Mark>(const Image &, const Camera &camera)> draw;
};

/// Under what a claim is checked.
struct ClaimContext {
    const std::vector<SceneRecipe> &scenes;
    Preset preset = Preset::text;
    std::vector<Assignment> assignments; ///< --set, in order
    bool quick = false;

    /// The scene with the preset, then `defaults`, then the user's assignments, then `fixed`: what the measuring needs.
    Experiment experiment(std::string name, std::string title, std::string_view scene,
                          const std::vector<Assignment> &defaults, const std::vector<Assignment> &fixed) const;
};

struct Claim {
    std::string name;
    std::string statement;
    std::function<std::vector<Experiment>(const ClaimContext &)> experiments;
    /// One or two sentences for an art historian, by verdict.
    std::function<std::string(const ClaimContext &, Verdict)> summary;
    std::function<std::vector<std::string>(const ClaimContext &)> notes;
    /// Where the conclusion flips, by the closed form at the scene's own parameters (claims/flip.h). `experiments`
    /// holds the renders on both sides.
    std::function<std::vector<FlipPoint>(const ClaimContext &)> flips;
    /// How far each effect that its model leaves out could move its numbers (claims/scope.h).
    std::function<std::vector<ScopeNumber>(const ClaimContext &, const ScopeSettings &)> scope;
    /// The fault that must make it fail when one renderer's export has it.
    Fault mutant;
};

std::vector<Claim> built_in_claims();
const Claim &find_claim(const std::vector<Claim> &claims, std::string_view name);

Claim claim_calibration();
Claim claim_energy();
Claim claim_solid_vs_hollow();
Claim claim_hand_contact();
Claim claim_palm();
Claim claim_rim_reads_wall();
Claim claim_salvator();
Claim claim_setup();
Claim claim_soft_light();
Claim claim_three_lines();
Claim claim_folds();
Claim claim_wall_limit();
Claim claim_shift();
Claim claim_tint();
Claim claim_calcite();
Claim claim_dark_layer();
Claim claim_white_spots();

/// Any scene, not among the built-in ones: "picture", compared tile by tile. At most 256 px wide and high (quick: 128)
/// unless image.width_px or image.height_px is assigned; the recipe has both parameters.
Claim claim_picture(SceneRecipe recipe);

/// `name=value` for whatever fmt can print, with all digits.
Assignment assign(std::string_view name, double value);
Assignment assign(std::string_view name, std::string_view value);

} // namespace threefold
