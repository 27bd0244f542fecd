// SPDX-License-Identifier: MIT
// The extremes study: at which walls, indices, distances, scales, angles does each renderer stop telling the truth, and
// does it say so? Every point of every sweep is a real render, tiny, through the same path as any picture; every pixel
// is held against quad precision.
//
// The classes, fixed before any pixel exists. Of each pixel: its error e, and a bound a that was stated beforehand.
//   right       e <= a and e <= visible
//   degraded    e <= a or e <= visible, not both: a visible error that was announced, or an invisible one beyond what
//               was announced
//   wrong       e > a and e > visible, or no number, or light where there is none, or none where there is some
//   unresolved  the pixel lies nearer to an edge of the glass or of the card than the stated accuracy: not judged
// `visible` is 1e-3 of the orb's radius on the card, or 1e-2 of the light. The bound a:
//   tracer      max(1e-11 R in double or 1e-5 R in float, ten roundings times the problem's own condition number)
//   others      what their adapter states before rendering (Accuracy): positions rounded, surfaces tessellated, samples
//               spread, radiances stored; each times what it does to the landing of this very pixel, and ten roundings
//               (single precision) times the condition number where the adapter says that it computes in single
// A point has the worst class of its pixels; of paths that a renderer states to lose now and then, as many are forgiven
// as chance exceeds once in a thousand pictures. A point is unresolved without any judged pixel, and where less than a
// quarter of those show the card and nothing is wrong: dark pixels alone say little. `refused`: by validation,
// or by the adapter; with the reason.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "verifier/studies/extremes_sweeps.h"
#include "verifier/witness/witness.h"

namespace threefold {

enum class Standing { right, degraded, unresolved, refused, wrong };
std::string to_string(Standing standing);

/// Thresholds, as shares of the orb's radius (landing) or of the light.
inline constexpr double visible_landing = 1e-3, visible_light = 1e-2;
inline constexpr double least_lit_share = 0.25; ///< of the judged pixels
inline constexpr double double_floor = 1e-11, float_floor = 1e-5, roundings = 10;

struct ExtremesRequest {
    std::vector<Witness> witnesses;  ///< the tracer stands for itself in double and in float
    std::vector<std::string> sweeps; ///< names; empty: all
    bool quick = false;
    int threads = 0;
    std::chrono::milliseconds time_limit{std::chrono::minutes(10)};
    std::filesystem::path folder;
    std::function<void(double share, const std::string &now)> on_progress; ///< may be empty
};

/// One renderer at one point.
struct ExtremeFinding {
    Standing standing = Standing::unresolved;
    int judged = 0, unresolved = 0, wrong = 0, forgiven = 0; ///< pixels
    int lit = 0;                                             ///< judged pixels that should show the card, or light
    double worst = 0; ///< greatest error of a judged pixel that is a number, in radii or as a share of the light
    double median = 0;
    double bound = 0;   ///< stated, where the error is nearest to it or farthest beyond it
    double times = 0;   ///< that error over that bound
    std::string reason; ///< of a refusal, or of what is wrong
};

struct ExtremeColumn {
    std::string name, title; ///< "tracer-double", "Threefold's tracer, double"
    bool is_own = false;     ///< our tracer in double precision: it has promises to keep
};

struct ExtremeRow {
    std::string label;
    double value = 0;
    bool promised = false;
    double condition = 0;                 ///< greatest condition number of a judged pixel, in radii
    std::vector<ExtremeFinding> findings; ///< one a column
};

struct ExtremeSweepResult {
    std::string name, title, number;
    Probe probe = Probe::landing;
    std::vector<ExtremeRow> rows;
};

struct ExtremesResult {
    static constexpr int schema_version = 1;
    std::string threefold_version, command, started;
    std::vector<std::pair<std::string, std::string>> versions;
    bool quick = false;
    std::vector<ExtremeColumn> columns;
    std::vector<ExtremeSweepResult> sweeps;
    double disagreement = 0; ///< of the two ways to the quad reference, in radii: the greatest anywhere
    double seconds = 0;

    /// What keeps the study from being passed, a line each: a promise of our own not kept, anything wrong.
    std::vector<std::string> faults() const;
};

/// Names of the sweeps in order.
std::vector<std::string> extreme_sweep_names();

/// Throws Error like `check` does.
ExtremesResult study_extremes(const ExtremesRequest &request);

} // namespace threefold
