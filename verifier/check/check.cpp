// SPDX-License-Identifier: MIT
#include "verifier/check/check.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "exporter/files.h"
#include "verifier/check/conclude.h"
#include "verifier/check/look.h"
#include "verifier/check/pictures.h"
#include "verifier/check/plan.h"
#include "verifier/check/render_queue.h"
#include "verifier/check/rows.h"
#include "verifier/check/run_progress.h"

namespace threefold {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

WitnessRecord record_of(const Witness &w, const CheckRequest &request) {
    WitnessRecord record;
    record.name = w.name;
    record.title = w.title;
    record.present = w.present();
    if (w.installed) {
        record.version = w.installed->version;
        record.program = w.installed->program.string();
    }
    if (!w.problem.empty())
        record.problem = w.problem;
    else if (!w.present())
        record.problem = fmt::format("{} is not installed (Debian package {})", w.title, w.package);
    if (const auto fault = request.injected.find(w.name); fault != request.injected.end())
        record.injected_fault = to_string(fault->second);
    return record;
}

/// One experiment while it is rendered and judged.
struct Trial {
    std::size_t claim; ///< number in the plan
    const Experiment *experiment;
    std::vector<Testimony> testimonies{};
    int awaited = 0; ///< renders that have not ended
    bool second = false, judged = false;
    std::set<std::string> rendered_more{}; ///< renderers with a second look
    std::vector<Row> rows{};
    std::vector<TileComparison> tiles{};
    std::vector<ReportPicture> pictures{};
    std::vector<RenderRecord> renders{};
};

/// Every experiment's renders go into one queue, in the order of the claims. What ends is judged at once; what is then
/// undecided goes into the queue again, before later claims. A claim is concluded when all its experiments are judged.
class Run {
public:
    explicit Run(const CheckRequest &request)
        : request_(request), plan_(plan_of(request)), results_(plan_.size()), progress_(request.on_progress) {
        for (const Witness &w : request.witnesses) result_.witnesses.push_back(record_of(w, request));
    }

    CheckOutcome operator()() {
        const auto start = Clock::now();
        result_.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
        result_.preset = request_.presets.size() > 1 ? "both" : to_string(request_.presets.front());
        result_.quick = request_.quick;
        result_.claims_planned = plan_.size();
        for (const Assignment &a : request_.assignments) result_.assignments[a.name] = a.value;
        make_folder(request_.folder); // not before the scenes are known to be good

        render_all();
        for (Trial &trial : trials_) gather_renders(trial);
        conclude_run(result_, refusals_);
        if (exit_ != Exit::timed_out)
            exit_ = result_.verdict == Verdict::holds   ? Exit::holds
                    : result_.verdict == Verdict::fails ? Exit::fails
                                                        : Exit::undecided;
        result_.seconds = seconds_since(start);
        return {std::move(result_), exit_};
    }

private:
    void render_all() {
        for (std::size_t i = 0; i < plan_.size(); ++i)
            for (const Experiment &e : plan_[i].experiments) trials_.push_back({i, &e});
        RenderQueue queue(request_.threads);
        for (std::size_t i = 0; i < trials_.size(); ++i) add_first_look(queue, i);
        judge_what_is_rendered(queue); // without a renderer that is there, nothing ever ends
        conclude_what_is_judged();
        const auto start = Clock::now();
        while (std::optional<RenderAnswer> answer = queue.next()) {
            take(queue, *std::move(answer));
            result_.renderer_seconds = seconds_since(start);
        }
    }

    WitnessRecord &record_of_witness(const Witness &w) {
        return *std::ranges::find(result_.witnesses, w.name, &WitnessRecord::name);
    }

    bool can_render(const Witness &w) { return record_of_witness(w).present && !broken_.contains(w.name); }

    std::uint64_t seed_of(const Witness &w) const {
        const auto own = request_.seeds.find(w.name);
        return own != request_.seeds.end() ? own->second : request_.seed;
    }

    const InjectedFault *fault_of(const Witness &w) const {
        const auto fault = request_.injected.find(w.name);
        return fault == request_.injected.end() ? nullptr : &fault->second;
    }

    /// What distinguishes an experiment's renders while they are at work.
    std::string key_of(const Trial &trial) const { return fmt::format("{}/{}", trial.claim, trial.experiment->name); }

    void add_first_look(RenderQueue &queue, std::size_t number) {
        Trial &trial = trials_[number];
        const Experiment &e = *trial.experiment;
        if (e.inspect) return;
        for (const Witness &w : request_.witnesses) {
            if (!can_render(w)) continue;
            Look look{&e, 0, first_replicates(w, e, plan_[trial.claim].experiments), seed_of(w), fault_of(w), {}};
            RenderTask task = task_of(number, w, look, e.name);
            task.noise = noise_wanted(w, e, request_.tolerance);
            task.tiles = tiles_wanted(w, e);
            queue.add(std::move(task));
        }
    }

    RenderTask task_of(std::size_t number, const Witness &w, const Look &look, const std::string &label) {
        Trial &trial = trials_[number];
        ++trial.awaited;
        const double work = look.work();
        progress_.expect(w.name, work);
        RenderTask task{.experiment = number,
                        .witness = &w,
                        .job = [look] { return look.job(); },
                        .options = {request_.folder, label, request_.tracer, request_.time_limit,
                                    progress_.of_render(w.name, look.experiment->name, key_of(trial), work)},
                        .group = trial.claim,
                        .is_long = static_cast<bool>(look.experiment->tile_budget)};
        works_[{number, w.name}] = work;
        return task;
    }

    void take(RenderQueue &queue, RenderAnswer answer) {
        Trial &trial = trials_[answer.experiment];
        const Witness &w = *answer.witness;
        progress_.finish(w.name, trial.experiment->name, key_of(trial), works_[{answer.experiment, w.name}]);
        --trial.awaited;
        if (answer.failure)
            note_failure(queue, w, trial, answer.failure);
        else
            add(trial, w, *std::move(answer.rendered), answer.samples_per_pixel);
        judge_what_is_rendered(queue);
        conclude_what_is_judged();
    }

    void add(Trial &trial, const Witness &w, Rendered rendered, int samples_per_pixel) {
        RenderRecord record = rendered.record;
        record.experiment = trial.experiment->name;
        record.preset = to_string(plan_[trial.claim].context.preset);
        trial.renders.push_back(record);
        if (!record.from_cache) {
            record_of_witness(w).seconds += record.seconds;
            if (w.is_tracer()) result_.tracer_seconds += record.seconds;
        }
        const auto before = std::ranges::find(trial.testimonies, &w, &Testimony::witness);
        if (before != trial.testimonies.end()) {
            std::ranges::move(rendered.images, std::back_inserter(before->rendered.images));
            trial.rendered_more.insert(w.name);
        } else
            trial.testimonies.push_back({&w, std::move(rendered), seed_of(w), samples_per_pixel});
        std::ranges::sort(trial.testimonies, {}, &Testimony::witness); // as in the request
    }

    /// In the order of the plan, whatever ended first.
    void gather_renders(Trial &trial) {
        std::ranges::stable_sort(trial.renders, {}, [&](const RenderRecord &r) {
            return std::ranges::find(request_.witnesses, r.witness, &Witness::name) - request_.witnesses.begin();
        });
        std::ranges::move(trial.renders, std::back_inserter(result_.renders));
    }

    void note_failure(RenderQueue &queue, const Witness &w, const Trial &trial, const std::exception_ptr &failure) {
        try {
            std::rethrow_exception(failure);
        } catch (const Error &error) {
            // The program itself failed: the others go on, and what they found is not lost.
            const bool refused = error.code() == Exit::bad_data;
            const bool of_renderer =
                refused || (!w.is_tracer() && (error.code() == Exit::timed_out || error.code() == Exit::input_output));
            if (!of_renderer) throw;
            const std::string problem =
                fmt::format("{} gave no picture of {}: {}", w.title, trial.experiment->name, error.what());
            if (trial.second) return; // the first look's pictures are judged: what that left open stays open
            // What it refuses, or a picture that nobody made, says nothing of other scenes.
            if (refused || w.pictures) {
                refusals_.push_back(problem);
                return;
            }
            if (broken_.contains(w.name)) return; // said already
            record_of_witness(w).problem = problem;
            broken_.insert(w.name);
            for (const std::size_t number : queue.remove(w)) --trials_[number].awaited;
            if (error.code() == Exit::timed_out) exit_ = Exit::timed_out;
        }
    }

    const Trial *partner_of(const Trial &trial) const {
        const std::string &name = trial.experiment->partner;
        if (name.empty()) return nullptr;
        const auto found = std::ranges::find_if(
            trials_, [&](const Trial &t) { return t.claim == trial.claim && t.experiment->name == name; });
        return found == trials_.end() ? nullptr : &*found;
    }

    void judge_what_is_rendered(RenderQueue &queue) {
        for (std::size_t i = 0; i < trials_.size(); ++i) {
            Trial &trial = trials_[i];
            if (trial.judged || trial.awaited > 0 || trial.experiment->inspect) continue;
            const Trial *partner = partner_of(trial);
            if (partner && partner->awaited > 0) continue;
            judge(queue, i, partner ? partner->testimonies : std::vector<Testimony>{});
        }
    }

    void judge(RenderQueue &queue, std::size_t number, const std::vector<Testimony> &of_partner) {
        Trial &trial = trials_[number];
        const Experiment &e = *trial.experiment;
        const double level = trial.second ? second_look : first_look;
        std::vector<Row> rows = judged_rows(e, trial.testimonies, of_partner, level);
        std::vector<TileComparison> tiles = compared_pictures(e, trial.testimonies, level);
        if (!trial.second) {
            trial.rows = std::move(rows);
            trial.tiles = std::move(tiles);
            if (add_second_look(queue, number)) return;
        } else {
            take_second_look(trial.rows, std::move(rows), trial.rendered_more);
            take_second_look(trial.tiles, std::move(tiles), trial.rendered_more);
        }
        trial.judged = true;
        trial.pictures = report_pictures(e, trial.testimonies, trial.tiles);
        if (!is_partner(trial))
            for (Testimony &t : trial.testimonies) t.rendered.images.clear();
    }

    bool is_partner(const Trial &trial) const {
        return std::ranges::any_of(plan_[trial.claim].experiments,
                                   [&](const Experiment &e) { return e.partner == trial.experiment->name; });
    }

    /// More replicates of what is undecided. False where there is nothing more to look at.
    bool add_second_look(RenderQueue &queue, std::size_t number) {
        Trial &trial = trials_[number];
        const Experiment &e = *trial.experiment;
        if (e.measure_pair) return false; // a pair of pictures has as many replicates as either has
        const std::vector<TileComparison> tiles = compared_pictures(e, trial.testimonies, second_look);
        std::vector<RenderTask> tasks;
        for (const Testimony &t : trial.testimonies) {
            if (t.witness->pictures || broken_.contains(t.witness->name)) continue;
            const auto have = static_cast<int>(t.rendered.images.size());
            const int wanted = std::max(replicates_for_second_look(t.witness->name, have, trial.rows),
                                        replicates_for_second_look(t.witness->name, have, open_in(trial.tiles, tiles)));
            if (wanted == 0) continue;
            const Look look{
                &e, have, std::max(wanted, e.replicates), t.seed, fault_of(*t.witness), t.samples_per_pixel};
            tasks.push_back(task_of(number, *t.witness, look, e.name + "-more"));
        }
        trial.second = !tasks.empty();
        for (RenderTask &task : tasks) queue.add(std::move(task));
        return trial.second;
    }

    /// Of `at_second`, what the first look left undecided.
    static std::vector<TileComparison> open_in(const std::vector<TileComparison> &first,
                                               const std::vector<TileComparison> &at_second) {
        std::vector<TileComparison> open;
        for (std::size_t i = 0; i < first.size(); ++i)
            if (first[i].verdict == Verdict::undecided) open.push_back(at_second[i]);
        return open;
    }

    /// In the order of the plan where that is possible; calibrations before all others.
    void conclude_what_is_judged() {
        bool calibrated = true;
        for (std::size_t i = 0; i < plan_.size(); ++i) {
            const bool calibrating = plan_[i].claim->name == calibration_name;
            if (!calibrating && !calibrated) return;
            if (results_[i]) continue;
            const bool ready = std::ranges::all_of(
                trials_, [&](const Trial &t) { return t.claim != i || t.judged || t.experiment->inspect != nullptr; });
            if (!ready) {
                calibrated = calibrated && !calibrating;
                continue;
            }
            conclude(i);
            if (calibrating) {
                calibrations_.push_back(*results_[i]);
                apply_calibrations(calibrations_, broken_, result_.witnesses);
            }
            tell_so_far(i);
        }
    }

    void conclude(std::size_t number) {
        const PlannedClaim &planned = plan_[number];
        if (!planned.problem.empty()) {
            refusals_.push_back(planned.problem);
            results_[number] = claim_without_scene(planned);
            return;
        }
        ClaimResult result = result_of(planned);
        bool complete = true;
        for (Trial &trial : trials_) {
            if (trial.claim != number) continue;
            result.experiments.push_back(trial.experiment->record);
            for (const Witness &w : request_.witnesses)
                if (trial.experiment->inspect)
                    complete = inspect(w, *trial.experiment, result) && complete;
                else
                    complete = complete && record_of_witness(w).problem.empty() &&
                               std::ranges::count(trial.testimonies, &w, &Testimony::witness) == 1;
            std::ranges::move(trial.pictures, std::back_inserter(result.pictures));
            std::ranges::move(trial.rows, std::back_inserter(result.rows));
            std::ranges::move(trial.tiles, std::back_inserter(result.tiles));
            trial.testimonies.clear();
        }
        conclude_claim(planned, result_.witnesses, complete, result);
        results_[number] = std::move(result);
    }

    /// Rows of an experiment that needs no picture; false where the renderer takes no part.
    bool inspect(const Witness &w, const Experiment &e, ClaimResult &result) {
        if (!can_render(w)) return false;
        const InjectedFault *fault = fault_of(w);
        const std::vector<Reading> readings = e.inspect(fault ? with_fault(e.scene, *fault) : e.scene);
        for (const Expected &expected : e.predict(Accuracy{})) {
            Row row = row_of(e.name, w.name, expected);
            const auto reading = std::ranges::find(readings, expected.quantity, &Reading::quantity);
            row.measured = {reading == readings.end() ? std::numeric_limits<double>::quiet_NaN() : reading->value, 0,
                            std::numeric_limits<double>::infinity(), 0};
            result.rows.push_back(judged(std::move(row)));
        }
        return record_of_witness(w).problem.empty();
    }

    void tell_so_far(std::size_t concluded) {
        result_.claims.clear();
        for (const auto &result : results_)
            if (result) result_.claims.push_back(*result);
        if (request_.on_claim) request_.on_claim(*results_[concluded], result_);
    }

    const CheckRequest &request_;
    const std::vector<PlannedClaim> plan_;
    std::vector<std::optional<ClaimResult>> results_; ///< of the plan's claims
    std::vector<Trial> trials_;                       ///< in the order of the plan; not resized while rendering
    std::map<std::pair<std::size_t, std::string>, double> works_; ///< of the render at work, by trial and renderer
    RunResult result_;
    Exit exit_ = Exit::holds;
    RunProgress progress_;
    std::vector<ClaimResult> calibrations_;
    std::set<std::string> broken_;
    std::vector<std::string> refusals_;
};

} // namespace

CheckOutcome check(const CheckRequest &request) { return Run(request)(); }

} // namespace threefold
