// SPDX-License-Identifier: MIT
// What a run found: plain values that the report, the JSON and the terminal all print from.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "exporter/job.h"
#include "verifier/agreement/equivalence.h"

namespace threefold {

/// A renderer as it took part. Names of renderers enter results as plain text only here and in rows.
struct WitnessRecord {
    std::string name, title; ///< "povray", "POV-Ray"
    std::string version;     ///< empty when missing
    std::string program;     ///< path; empty for our own tracer
    bool present = false;
    std::optional<bool> calibrated; ///< empty: not tried
    std::string problem;            ///< why it could not vote, in plain words; empty if it could
    double seconds = 0;             ///< all its renders, whole processes; 0 where all came from the cache
    std::string injected_fault;     ///< for mutants: what was done to this renderer's export alone
};

/// One number of one renderer against the closed form, or against another renderer.
struct Row {
    std::string experiment; ///< "solid-map"
    std::string quantity;   ///< "central slope"
    std::string unit;
    std::string witness, versus; ///< names; versus is empty for the closed form
    Relation relation = Relation::equal;
    Estimate measured; ///< versus a renderer: the difference
    Interval interval;
    double expected = 0; ///< closed form; 0 for a difference
    double tolerance = 0;
    std::vector<BudgetItem> budget;
    Verdict verdict = Verdict::undecided;
    std::optional<int> replicates_to_decide;
    double level = first_look; ///< of each one-sided test: `first_look` or `second_look`
};

/// Two renderers' pictures of the same scene, tile by tile.
struct TileComparison {
    std::string experiment, witness, versus;
    int tile_px = 8, columns = 0, rows = 0;
    double mean_radiance = 0; ///< of the picture
    double tolerance = 0;     ///< on a tile's mean, absolute radiance
    std::vector<BudgetItem> budget;
    double worst_difference = 0; ///< of the tile means, signed
    int worst_column = 0, worst_row = 0;
    int holding = 0, failing = 0, open = 0; ///< tiles by their own interval
    double needed_share = 1;                ///< of all tiles must hold
    Verdict verdict = Verdict::undecided;
    std::optional<int> replicates_to_decide;
    int replicates = 0;            ///< the fewer of both renderers'
    double noise_of_witness = 0.5; ///< its share of the variance of the tiles' differences; `versus` has the rest
    double level = first_look;     ///< of the verdict: `first_look` or `second_look`
    int allowed = 0;               ///< so many tiles need not hold
    std::string problem{};         ///< why these pictures cannot be judged; empty where they can
};

/// Something measured or predicted, drawn on a picture. Image positions in pixels, row 0 on top.
struct Mark {
    enum class Kind { line, arrow, circle, cross } kind = Kind::line;
    /// Ends of a line or arrow (its head at `to_px`); the centre of a circle or cross is `from_px`.
    Vec2 from_px{0}, to_px{0};
    double radius_px = 0; ///< of a circle
    enum class Meaning { expected, measured } meaning = Meaning::measured;
    std::string label; ///< may be empty; one label a group of marks is enough
};

/// A picture of the report, as the bytes of an 8-bit PNG.
struct ReportPicture {
    enum class Kind { render, difference, map } kind = Kind::render;
    std::string experiment; ///< pictures of one experiment stand side by side
    std::string title;      ///< "POV-Ray", "POV-Ray minus tracer, x 50"
    std::string png;
    std::vector<Mark> marks{};
};

/// Where a conclusion stops holding, by the closed form: the value of one parameter of its scene.
struct FlipPoint {
    std::string parameter; ///< as --set takes it, "glass.index"
    std::string unit;      ///< of the value; empty: a plain number
    double value = 0;
    double here = 0;                    ///< the parameter's value in this run
    std::string meaning;                ///< "a solid orb inverts this plane only above it"
    std::vector<std::string> bracket{}; ///< names of the experiments rendered just below and just above it
};

/// An effect that the claim's model leaves out and that could move one of its numbers by more than its margin
/// (claims/scope.h): the verdict stands within the model only.
struct ScopeFinding {
    std::string effect;         ///< "polarisation"
    std::string quantity, unit; ///< the number it could move
    double value = 0, bound = 0, margin = 0;
    std::string sentence; ///< in plain words
};

struct RenderRecord {
    std::string experiment, witness, preset;
    std::string folder; ///< relative to the run's folder: inputs, log, pictures
    std::string command;
    int width_px = 0, height_px = 0, replicates = 0, samples_per_pixel = 0;
    double seconds = 0, cpu_seconds = 0, peak_memory_mb = 0;
    double own_cpu_seconds = 0; ///< of rendering alone, without start-up
    bool from_cache = false;
    std::optional<double> missing_weight_mean, missing_weight_greatest; ///< where a tree was cut and the renderer tells
    Accuracy accuracy;
    std::string scene_hash;
};

struct ExperimentRecord {
    std::string name, title;
    std::string scene;                             ///< of the catalogue
    std::map<std::string, std::string> parameters; ///< every parameter as it was
    std::string scene_hash;
};

struct ClaimResult {
    std::string name, statement;
    std::string preset; ///< under which it was judged
    Verdict verdict = Verdict::undecided;
    std::string summary;            ///< one or two sentences for an art historian
    std::vector<std::string> notes; ///< e.g. what exact optics says beyond the statement; what a cut tree left out
    std::vector<FlipPoint> flips;
    std::vector<ScopeFinding> scope; ///< by closed forms alone; empty: no such effect is required
    std::vector<ExperimentRecord> experiments;
    std::vector<Row> rows;
    std::vector<TileComparison> tiles;
    std::vector<ReportPicture> pictures;
    std::vector<std::string> blamed; ///< names of renderers whose rows fail
};

struct RunResult {
    static constexpr int schema_version = 1;
    std::string threefold_version;
    std::string started; ///< UTC, ISO 8601
    std::string command; ///< what repeats this run
    std::string preset;  ///< "text", "published", or "both": then every claim is there twice
    bool quick = false;
    std::map<std::string, std::string> assignments;            ///< --set
    std::vector<std::pair<std::string, std::string>> versions; ///< libraries and renderers
    std::vector<WitnessRecord> witnesses;
    std::vector<ClaimResult> claims; ///< calibration first
    std::size_t claims_planned = 0;  ///< while the run goes on there are more of these than `claims`
    std::vector<RenderRecord> renders;
    Verdict verdict = Verdict::undecided;
    std::string summary;
    double seconds = 0, renderer_seconds = 0; ///< some renderer at work; overhead is the difference
    double tracer_seconds = 0;                ///< of our own tracer, beside the others
};

} // namespace threefold
