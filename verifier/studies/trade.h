// SPDX-License-Identifier: MIT
// The trade study: what does accuracy cost, in each renderer, on one scene? Every knob is swept (verifier/tolerance/
// setting.h), each setting runs several times with other seeds, all settings of all renderers in turn (A B C A B C ...)
// so that a busy minute falls on all of them; the error is split against a closed form or a converged reference
// (agreement/error_split.h). Then the cheapest setting that should meet a tolerance is chosen by a model of the sweep,
//   error2(system, n) = bias2(system) + factor n^-rate,   seconds(system, n) = start-up + n * seconds a sample,
// and is not believed: it is rendered with fresh seeds; where its error turns out too large the next one is, and where
// it is far within the tolerance the same one with fewer samples. Seconds are CPU seconds of all threads: they mean the
// same on a busy machine.
#pragma once

#include <functional>

#include "verifier/agreement/error_split.h"
#include "verifier/tolerance/setting.h"

namespace threefold {

struct RunCost {
    double own_cpu_s = 0;     ///< rendering alone
    double process_cpu_s = 0; ///< the whole process
    double wall_s = 0;        ///< the whole process, by the clock
    double memory_mb = 0;     ///< peak
};

struct TradeRequest {
    Scene scene;
    std::vector<Witness> witnesses; ///< all present
    std::vector<double> tolerances{1e-2};
    int runs = 5; ///< of each setting
    bool quick = false;
    double most_cpu_s = 300; ///< to see one setting of one renderer meet one tolerance; beyond, the model alone speaks
    std::uint64_t seed = 1;
    int threads = 0;
    std::chrono::milliseconds time_limit{std::chrono::minutes(10)};
    std::filesystem::path folder;
    /// What our tracer costs as a process of its own; empty: as much as inside this one.
    std::function<RunCost(const Setting &setting, std::uint64_t seed)> tracer_process;
    std::function<void(const std::string &witness, double share, const std::string &now)> on_progress; ///< may be empty
};

struct TradeRow {
    std::string witness, setting; ///< name; in words
    Knob knob = Knob::samples;
    Setting knobs;
    int samples_per_pixel = 0; ///< as the renderer counts them
    RunCost cost;              ///< mean over the runs
    double own_cpu_spread_s = 0;
    ErrorSplit error;
    double quantisation = 0;          ///< relative RMS through the picture's number format, by computation
    std::optional<Square> difference; ///< from the same seeds at `difference_from`: what the knob does
    std::string difference_from;
    bool on_front = false;         ///< of error over own seconds
    bool on_process_front = false; ///< and over whole processes

    double efficiency() const; ///< 1 / (mse * own seconds)
};

/// The cheapest setting of one renderer for one tolerance.
struct TradeChoice {
    std::string witness;
    double tolerance = 0;
    std::string setting; ///< in words; empty: none
    int samples_per_pixel = 0;
    RunCost cost;          ///< measured on fresh seeds, or predicted
    double predicted = 0;  ///< relative RMS error
    bool rendered = false; ///< with fresh seeds
    bool met = false;      ///< measured within the tolerance
    Square measured;       ///< square of the error on fresh seeds
    double bias = 0;       ///< relative RMS, of those runs
    int tried = 0;         ///< settings rendered for it
    std::string note;      ///< why not, how far it got, what would be needed
};

struct TradeLaw {
    std::string witness;
    NoiseLaw noise;   ///< by RenderJob's samples
    std::string bias; ///< the systematic offset in words
};

struct TradeResult {
    static constexpr int schema_version = 1;
    std::string threefold_version, command, started, scene, scene_hash;
    std::vector<std::pair<std::string, std::string>> parameters, versions, titles; ///< titles by name of the renderer
    int width_px = 0, height_px = 0, runs = 0, threads = 0;
    bool quick = false, whole_processes = false; ///< the tracer too was measured as a process
    std::string reference;
    double reference_error = 0, reference_cpu_s = 0, mean_radiance = 0;
    std::vector<TradeRow> rows;
    std::vector<TradeLaw> laws;
    std::vector<double> tolerances;
    std::vector<TradeChoice> choices;
    std::vector<std::string> notes;
    double seconds = 0;

    /// Every renderer has a setting that was seen to meet every tolerance.
    bool all_met() const;
    const std::string &title(const std::string &witness) const;
};

TradeResult study_trade(const TradeRequest &request);

} // namespace threefold
