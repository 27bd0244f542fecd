// SPDX-License-Identifier: MIT
// The scope study: for every claim and every effect that its model leaves out, a bound on how far it could move the
// claim's numbers, beside their margins (claims/scope.h). Closed forms where there are any; where a bound is a
// picture's, our tracer renders both scenes with the same samples and the tiles are compared.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "verifier/claims/claim.h"

namespace threefold {

struct ScopeRequest {
    std::vector<Claim> claims;
    std::vector<SceneRecipe> scenes;
    std::vector<Preset> presets{Preset::text};
    std::vector<Assignment> assignments;
    ScopeSettings settings;
    double impact_mm = 60; ///< of the one ray
    bool closed_forms_only = false;
    int threads = 0;
    std::function<void(double share, const std::string &now)> on_progress; ///< may be empty
};

/// One ray, straight through a hollow orb: what each effect does to it. The orb is the study's (68 mm, wall 1.36 mm)
/// but for what is set.
struct ScopeRay {
    double outer_mm, wall_mm, index, impact_mm;
    double unpolarised, polarised;                      ///< share of light
    double absorbed;                                    ///< share of what would arrive
    double turn_rad, turn_least_rad, turn_greatest_rad; ///< and over the visible range
};

struct ClaimScope {
    std::string claim, statement, preset;
    bool answered = true; ///< false: a claim of a user's own without a scope
    std::vector<ScopeNumber> numbers;

    /// Effects that could move some number by more than its margin.
    std::vector<Effect> required() const;
};

struct ScopeResult {
    static constexpr int schema_version = 1;
    std::string threefold_version, command, started;
    ScopeSettings settings;
    std::optional<ScopeRay> ray; ///< nothing where it does not go straight through
    std::vector<ClaimScope> claims;
    std::vector<std::string> problems; ///< claims without a scene, and pictures that could not be made
};

/// Throws Error(usage) for an assignment that no scene of the catalogue has, and as the scenes do.
ScopeResult study_scope(const ScopeRequest &request);

/// How far the tile means move, all but the spare ones: of the worst picture, or of the mean picture.
double picture_change(const PictureChange &change, int threads);

} // namespace threefold
