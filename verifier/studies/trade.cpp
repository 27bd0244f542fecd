// SPDX-License-Identifier: MIT
#include "verifier/studies/trade.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <map>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "exporter/scene_json.h"
#include "scenes/error.h"
#include "scenes/validate.h"
#include "verifier/studies/trade_choice.h"
#include "verifier/tolerance/reference.h"
#include "verifier/tracer/sampler.h"

namespace threefold {

namespace {

constexpr int most_tried = 4;

/// One setting of one renderer, and what its runs gave.
struct Measured {
    const Witness *witness;
    SweepPoint point;
    std::vector<Image> images;
    std::vector<RunCost> costs;
    RenderRecord record{};
};

RunCost mean_of(const std::vector<RunCost> &costs) {
    RunCost sum;
    for (const RunCost &c : costs) {
        sum.own_cpu_s += c.own_cpu_s, sum.process_cpu_s += c.process_cpu_s, sum.wall_s += c.wall_s;
        sum.memory_mb = std::max(sum.memory_mb, c.memory_mb);
    }
    const auto n = static_cast<double>(costs.size());
    return {sum.own_cpu_s / n, sum.process_cpu_s / n, sum.wall_s / n, sum.memory_mb};
}

double spread_of_own(const std::vector<RunCost> &costs) {
    const double mean = mean_of(costs).own_cpu_s;
    double squares = 0;
    for (const RunCost &c : costs) squares += (c.own_cpu_s - mean) * (c.own_cpu_s - mean);
    return costs.size() > 1 ? std::sqrt(squares / static_cast<double>(costs.size() - 1)) : 0;
}

/// A renderer while it is studied.
struct Studied {
    const Witness *witness;
    std::vector<std::size_t> rows; ///< of the sweep
    RendererModel model;
};

/// A tolerance that one renderer is to meet.
struct Quest {
    Studied *studied;
    double tolerance;
    std::vector<Candidate> open; ///< the cheapest first
    TradeChoice choice;
    double best_error = 0;
    bool done = false;
};

class TradeStudy {
public:
    explicit TradeStudy(const TradeRequest &request) : request_(request) {}

    TradeResult run() {
        const auto start = std::chrono::steady_clock::now();
        check_request();
        describe_run();
        const double least = *std::ranges::min_element(request_.tolerances);
        std::vector<Measured> sweep;
        for (const Witness &w : request_.witnesses) {
            studied_.push_back({&w, {}, {}});
            for (const SweepPoint &point : sweep_of(w, request_.scene, request_.quick, least)) {
                studied_.back().rows.push_back(sweep.size());
                sweep.push_back({&w, point, {}, {}});
            }
        }
        say_reference(0);
        reference_ = make_reference(request_.scene, {.error = least / 4,
                                                     .most_cpu_s = request_.quick ? 60.0 : 600.0,
                                                     .seed = tracer::mix(request_.seed ^ 0x5eedu),
                                                     .threads = request_.threads,
                                                     .on_progress = [this](double share) { say_reference(share); }});
        result_.reference = reference_.kind;
        result_.reference_error = reference_.error;
        result_.reference_cpu_s = reference_.cpu_seconds;
        result_.mean_radiance = reference_.mean_radiance;
        if (reference_.error > least / 2)
            result_.notes.push_back(fmt::format(
                "The reference is itself good to {:.1e} only, not well below the tolerance {:g}: a longer one was not "
                "afforded. Its noise is taken off every square, but what is then left is the less sure.",
                reference_.error, least));

        measure_in_turn(sweep, 0, "sweep", 0, 0.7);
        for (const Measured &m : sweep) result_.rows.push_back(row_of(m));
        for (Studied &s : studied_) {
            compare_knobs(s, sweep);
            mark_fronts(s);
            fit(s);
        }
        look_for_choices();
        result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return std::move(result_);
    }

private:
    void check_request() const {
        validate(request_.scene);
        if (request_.runs < 2) throw Error(Exit::usage, "a spread takes two runs at least");
        if (request_.tolerances.empty()) throw Error(Exit::internal, "no tolerance");
        for (const double t : request_.tolerances)
            if (!(t > 0 && t < 1))
                throw Error(Exit::usage, fmt::format("a tolerance lies between 0 and 1, not {:g}", t));
        constexpr double most_bytes = 2e9, settings = 30;
        const Camera &c = request_.scene.camera;
        const double bytes = 24.0 * c.image_width_px() * c.image_height_px() * request_.runs * settings;
        if (bytes > most_bytes)
            throw Error(Exit::bad_data,
                        fmt::format("pictures of {} x {} pixels, {} runs of each setting, would take {:.1f} GB",
                                    c.image_width_px(), c.image_height_px(), request_.runs, bytes / 1e9),
                        "a smaller --size shows the same trade");
    }

    void describe_run() {
        const Camera &c = request_.scene.camera;
        result_.scene = request_.scene.name;
        result_.scene_hash = scene_hash(request_.scene);
        result_.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
        result_.width_px = c.image_width_px(), result_.height_px = c.image_height_px();
        result_.runs = request_.runs, result_.threads = request_.threads, result_.quick = request_.quick;
        result_.whole_processes = static_cast<bool>(request_.tracer_process);
        result_.tolerances = request_.tolerances;
        for (const Witness &w : request_.witnesses) {
            result_.titles.emplace_back(w.name, w.title);
            if (w.installed) result_.versions.emplace_back(w.title, w.installed->version);
        }
    }

    void say_reference(double share) const {
        if (request_.on_progress)
            request_.on_progress(request_.witnesses.front().name, 0, fmt::format("reference {:.0f} %", 100 * share));
    }

    std::uint64_t seed_of(std::uint64_t stage, int run) const {
        return tracer::mix(tracer::mix(request_.seed + 0x1000 * (stage + 1)) + static_cast<std::uint64_t>(run));
    }

    /// A B C A B C ...
    void measure_in_turn(std::vector<Measured> &all, std::uint64_t stage, const std::string &label, double from,
                         double to) const {
        std::map<std::string, double> done, whole;
        for (const Measured &m : all) whole[m.witness->name] += request_.runs;
        for (int run = 0; run < request_.runs; ++run)
            for (Measured &m : all) {
                const Witness &w = *m.witness;
                const Setting &setting = m.point.setting;
                const auto tell = [&](double share) {
                    if (request_.on_progress)
                        request_.on_progress(w.name, from + (to - from) * (done[w.name] + share) / whole[w.name],
                                             fmt::format("{} run {} of {}: {}", label, run + 1, request_.runs,
                                                         describe(setting, w, request_.scene)));
                };
                tell(0);
                RenderOptions options;
                options.folder = request_.folder;
                options.label = "trade";
                options.time_limit = request_.time_limit;
                options.tracer = setting.tracer;
                const std::uint64_t seed = seed_of(stage, run);
                Rendered r = render(w, job_of(setting, request_.scene, {seed}, request_.threads), options);
                RunCost cost{r.record.own_cpu_seconds, r.record.cpu_seconds, r.record.seconds, r.record.peak_memory_mb};
                if (w.is_tracer() && request_.tracer_process) {
                    cost = request_.tracer_process(setting, seed);
                    cost.own_cpu_s = r.record.own_cpu_seconds;
                }
                m.costs.push_back(cost);
                m.images.push_back(std::move(r.images.front()));
                m.record = r.record;
                done[w.name] += 1;
                tell(0);
            }
    }

    TradeRow row_of(const Measured &m) const {
        TradeRow row;
        row.witness = m.witness->name;
        row.setting = describe(m.point.setting, *m.witness, request_.scene);
        row.knob = m.point.knob;
        row.knobs = m.point.setting;
        row.samples_per_pixel = m.record.samples_per_pixel;
        row.cost = mean_of(m.costs);
        row.own_cpu_spread_s = spread_of_own(m.costs);
        row.error = split_error(m.images, reference_);
        // Rounding to the nearest step: uniform within half a step.
        row.quantisation = m.record.accuracy.radiance_step / std::sqrt(3.0) / reference_.mean_radiance;
        return row;
    }

    /// Each row against the same seeds and samples at the finest setting; precision and transport against the middle
    /// one, which differs in that alone.
    void compare_knobs(const Studied &s, const std::vector<Measured> &sweep) {
        const std::size_t finest = s.rows.front();
        for (const std::size_t i : s.rows) {
            TradeRow &row = result_.rows[i];
            std::size_t peer = finest;
            if (row.knob == Knob::precision || row.knob == Knob::transport || row.knobs.bounces)
                for (const std::size_t k : s.rows)
                    if (result_.rows[k].knob == Knob::samples && result_.rows[k].knobs.samples == row.knobs.samples)
                        peer = k;
            if (peer == i || result_.rows[peer].knobs.samples != row.knobs.samples) continue;
            row.difference = paired_bias2(sweep[i].images, sweep[peer].images, reference_.mean_radiance);
            row.difference_from = result_.rows[peer].setting;
        }
    }

    void mark_fronts(const Studied &s) {
        std::vector<double> own, process, errors;
        for (const std::size_t i : s.rows) {
            own.push_back(result_.rows[i].cost.own_cpu_s);
            process.push_back(result_.rows[i].cost.process_cpu_s);
            errors.push_back(result_.rows[i].error.mse.root());
        }
        for (const std::size_t k : pareto_front(own, errors)) result_.rows[s.rows[k]].on_front = true;
        for (const std::size_t k : pareto_front(process, errors)) result_.rows[s.rows[k]].on_process_front = true;
    }

    /// The square of the offset where it is seen; where noise hides it, what the knobs are known to do. Of all rows
    /// with the same knobs but the samples: each does not depend on them.
    double bias2_of(const Studied &s, const Setting &setting) const {
        const Square *surest = nullptr, *difference = nullptr;
        for (const std::size_t i : s.rows) {
            const TradeRow &row = result_.rows[i];
            if (!row.knobs.same_system(setting)) continue;
            const Square &b = row.error.bias2;
            if (!surest || b.standard_error < surest->standard_error) surest = &b;
            if (row.difference) difference = &*row.difference;
        }
        if (surest && surest->seen()) return surest->value;
        return difference ? std::max(0.0, difference->value) : 0;
    }

    void fit(Studied &s) {
        // The law: the samples of the middle setting.
        std::vector<NoisePoint> points;
        const TradeRow *middle = nullptr;
        for (const std::size_t i : s.rows)
            if (result_.rows[i].knob == Knob::samples && !middle) middle = &result_.rows[i];
        if (!middle) middle = &result_.rows[s.rows.front()];
        for (const std::size_t i : s.rows)
            if (result_.rows[i].knobs.same_system(middle->knobs))
                points.push_back({double(result_.rows[i].knobs.samples), result_.rows[i].error.variance.value});
        s.model.noise = fit_noise_law(points);

        for (const std::size_t i : s.rows) {
            const TradeRow &row = result_.rows[i];
            auto known = std::ranges::find_if(s.model.systems,
                                              [&](const SystemModel &m) { return m.setting.same_system(row.knobs); });
            if (known != s.model.systems.end() && known->setting.samples >= row.knobs.samples) continue;
            SystemModel system;
            system.setting = row.knobs;
            system.bias2 = bias2_of(s, row.knobs);
            const double law = s.model.noise.variance(row.knobs.samples);
            system.variance_ratio = law > 0 ? row.error.variance.value / law : 1;
            system.own_s_per_sample = row.cost.own_cpu_s / row.knobs.samples;
            system.start_s = start_s(s, row.knobs.surface_mm);
            if (known != s.model.systems.end())
                *known = system;
            else
                s.model.systems.push_back(system);
        }
        result_.laws.push_back({s.witness->name, s.model.noise, offset_in_words(s)});
    }

    /// What a process takes beside rendering: the mean over all settings with the same meshes, for it does not depend
    /// on the others, and its noise is not to choose between them.
    double start_s(const Studied &s, double surface_mm) const {
        double sum = 0, count = 0;
        for (const std::size_t i : s.rows) {
            const TradeRow &row = result_.rows[i];
            if (row.knobs.surface_mm != surface_mm) continue;
            sum += row.cost.process_cpu_s - row.cost.own_cpu_s;
            count += 1;
        }
        return std::max(0.0, sum / count);
    }

    std::string offset_in_words(const Studied &s) const {
        const TradeRow *most = nullptr;
        for (const std::size_t i : s.rows)
            if (!most || result_.rows[i].error.variance.value < most->error.variance.value) most = &result_.rows[i];
        const Square &b = most->error.bias2;
        if (b.seen())
            return fmt::format("{:.2g} of the mean radiance at {} (relative RMS, against the reference)", b.root(),
                               most->setting);
        return fmt::format("none seen at {}: under {:.2g} of the mean radiance", most->setting,
                           std::sqrt(std::max(0.0, b.value) + 2 * b.standard_error));
    }

    void look_for_choices() {
        std::vector<Quest> quests;
        for (const double tolerance : request_.tolerances)
            for (Studied &s : studied_) {
                Quest q{&s, tolerance, {}, {}};
                const Witness &w = *s.witness;
                q.open = candidates_for(s.model, tolerance, [&w](double n) { return round_up_samples(w, n); });
                q.choice.witness = w.name;
                q.choice.tolerance = tolerance;
                if (q.open.empty()) give_up_without_candidate(q);
                quests.push_back(std::move(q));
            }
        for (std::uint64_t round = 0; round < most_tried; ++round) {
            std::vector<Measured> fresh;
            std::vector<Quest *> asking;
            for (Quest &q : quests) {
                if (q.done) continue;
                const Candidate &c = q.open.front();
                if (c.process_s * request_.runs > request_.most_cpu_s) {
                    leave_to_the_model(q);
                    continue;
                }
                fresh.push_back({q.studied->witness, {c.setting, Knob::samples}, {}, {}});
                asking.push_back(&q);
            }
            if (fresh.empty()) break;
            measure_in_turn(fresh, 100 + round, "fresh seeds,", 0.7 + 0.07 * double(round),
                            0.77 + 0.07 * double(round));
            for (std::size_t k = 0; k < fresh.size(); ++k) judge(*asking[k], fresh[k]);
        }
        for (Quest &q : quests) {
            if (!q.done && !q.choice.met)
                q.choice.note = fmt::format("{} settings that should have met it did not; the nearest reached {:.2g}",
                                            q.choice.tried, q.best_error);
            result_.choices.push_back(q.choice);
        }
    }

    void give_up_without_candidate(Quest &q) const {
        q.done = true;
        const auto &systems = q.studied->model.systems;
        const auto best = std::ranges::min_element(systems, {}, &SystemModel::bias2);
        q.choice.predicted = std::sqrt(best->bias2);
        q.choice.note =
            fmt::format("no setting of the sweep can: {} has a systematic error of {:.2g} that no number of "
                        "samples removes; a finer setting than those swept would be needed",
                        describe(best->setting, *q.studied->witness, request_.scene, false), q.choice.predicted);
    }

    void fill(Quest &q, const Candidate &c) const {
        q.choice.setting = describe(c.setting, *q.studied->witness, request_.scene);
        q.choice.predicted = c.predicted;
        const Witness &w = *q.studied->witness;
        q.choice.samples_per_pixel =
            w.adapter ? for_renderer(*w.adapter, job_of(c.setting, request_.scene, {1}, 0)).samples_per_pixel
                      : c.setting.samples;
    }

    void leave_to_the_model(Quest &q) const {
        q.done = true;
        const Candidate &c = q.open.front();
        fill(q, c);
        q.choice.rendered = q.choice.met = false;
        q.choice.measured = {};
        q.choice.cost = {c.own_s, c.process_s, 0, 0};
        const double got = best_of_sweep(q);
        q.choice.note = fmt::format("not rendered: {} runs would take {:.0f} CPU seconds, more than the {:.0f} allowed "
                                    "(--budget); the figures are the law's, and the sweep itself got to {:.2g}",
                                    request_.runs, c.process_s * request_.runs, request_.most_cpu_s, got);
    }

    double best_of_sweep(const Quest &q) const {
        double best = std::numeric_limits<double>::infinity();
        for (const std::size_t i : q.studied->rows) best = std::min(best, result_.rows[i].error.mse.root());
        return best;
    }

    void judge(Quest &q, const Measured &m) const {
        const Candidate c = q.open.front();
        const ErrorSplit split = split_error(m.images, reference_);
        const double error = split.mse.root();
        const bool meets = error <= q.tolerance;
        ++q.choice.tried;
        // What was met once is met; a setting with fewer samples takes its place if it does too.
        q.done = q.choice.met;
        if (q.choice.met ? meets : q.choice.tried == 1 || error < q.best_error) {
            q.best_error = error;
            fill(q, c);
            q.choice.cost = mean_of(m.costs);
            q.choice.rendered = true;
            q.choice.measured = split.mse;
            q.choice.bias = split.bias2.root();
        }
        if (q.done) return;
        const auto round_up = [&w = *q.studied->witness](double n) { return round_up_samples(w, n); };
        const double rate = q.studied->model.noise.rate;
        if (meets) {
            q.choice.met = true;
            if (const auto fewer = with_fewer_samples(c, split, q.tolerance, rate, round_up))
                q.open = {*fewer};
            else
                q.done = true;
            return;
        }
        q.open.erase(q.open.begin());
        // A candidate that was lengthened already foretells by its own runs: the others know of those.
        for (Candidate &other : q.open)
            other = with_noise_beyond_law(other, noise_beyond_law(c, split), rate, round_up);
        if (const auto more = with_more_samples(c, split, q.tolerance, rate, round_up)) q.open.push_back(*more);
        std::ranges::stable_sort(q.open, {}, &Candidate::process_s);
        if (q.open.empty()) {
            q.done = true;
            q.choice.note = fmt::format("its systematic error is too large; the nearest reached {:.2g}", q.best_error);
        }
    }

    const TradeRequest &request_;
    TradeResult result_;
    std::vector<Studied> studied_;
    ReferencePicture reference_;
};

} // namespace

double TradeRow::efficiency() const {
    const double product = error.mse.value * cost.own_cpu_s;
    return product > 0 ? 1 / product : std::numeric_limits<double>::infinity();
}

bool TradeResult::all_met() const { return std::ranges::all_of(choices, &TradeChoice::met); }

const std::string &TradeResult::title(const std::string &witness) const {
    const auto found = std::ranges::find(titles, witness, &std::pair<std::string, std::string>::first);
    return found == titles.end() ? witness : found->second;
}

TradeResult study_trade(const TradeRequest &request) { return TradeStudy(request).run(); }

} // namespace threefold
