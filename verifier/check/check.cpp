// SPDX-License-Identifier: MIT
#include "verifier/check/check.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <set>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "verifier/agreement/tiles.h"
#include "verifier/check/hearing.h"
#include "verifier/check/plan.h"
#include "verifier/check/rows.h"
#include "verifier/measure/radiance.h"

namespace threefold {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

class Run {
public:
    explicit Run(const CheckRequest &request) : request_(request) {
        for (const Witness &w : request.witnesses) {
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
            result_.witnesses.push_back(record);
        }
    }

    CheckOutcome operator()() {
        const auto start = Clock::now();
        result_.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
        result_.preset = request_.presets.size() > 1 ? "both" : to_string(request_.presets.front());
        result_.quick = request_.quick;
        for (const Assignment &a : request_.assignments) result_.assignments[a.name] = a.value;

        const std::vector<PlannedClaim> plan = make_plan();
        make_folder(request_.folder); // not before the scenes are known to be good
        std::vector<ClaimResult> calibrations;
        for (const PlannedClaim &planned : plan) {
            result_.claims.push_back(judge_claim(planned));
            if (planned.claim->name != calibration_name) continue;
            calibrations.push_back(result_.claims.back());
            take_votes_away(calibrations);
        }
        conclude();
        result_.seconds = seconds_since(start);
        return {std::move(result_), exit_};
    }

private:
    std::vector<PlannedClaim> make_plan() {
        std::vector<PlannedClaim> plan = plan_of(request_);
        for (const PlannedClaim &p : plan)
            for (const Experiment &e : p.experiments) work_ += work_of(e);
        return plan;
    }

    /// Seconds or so, for foretelling the rest: to start a program, and the rays of its picture.
    static double work_of(const Experiment &e) {
        if (e.inspect) return 0.1;
        return 2 + 1e-6 * e.scene.camera.image_width_px() * e.scene.camera.image_height_px() * e.samples_per_pixel *
                       e.replicates;
    }

    void finish(const Witness &w, const Experiment &e) {
        const double done = finished_[w.name] += work_of(e);
        if (request_.on_progress) request_.on_progress(w.name, std::min(1.0, done / work_), e.name);
    }

    WitnessRecord &record_of(const Witness &w) {
        return *std::ranges::find(result_.witnesses, w.name, &WitnessRecord::name);
    }

    /// The scene that this renderer is given.
    Scene scene_for(const Witness &w, const Experiment &e) const {
        const auto fault = request_.injected.find(w.name);
        return fault == request_.injected.end() ? e.scene : with_fault(e.scene, fault->second);
    }

    /// Rows of an experiment that needs no picture; false where the renderer takes no part.
    bool inspect(const Witness &w, const Experiment &e, ClaimResult &result) {
        const WitnessRecord &record = record_of(w);
        if (!record.present || broken_.contains(w.name)) return false;
        finish(w, e);
        const std::vector<Reading> readings = e.inspect(scene_for(w, e));
        for (const Expected &expected : e.predict(Accuracy{})) {
            Row row = row_of(e.name, w.name, expected);
            const auto reading = std::ranges::find(readings, expected.quantity, &Reading::quantity);
            row.measured = {reading == readings.end() ? std::numeric_limits<double>::quiet_NaN() : reading->value, 0,
                            std::numeric_limits<double>::infinity(), 0};
            result.rows.push_back(judged(std::move(row)));
        }
        return record.problem.empty();
    }

    std::uint64_t seed_of(const Witness &w) const {
        const auto own = request_.seeds.find(w.name);
        return own != request_.seeds.end() ? own->second : request_.seed;
    }

    Question question_for(const Witness &w, const Experiment &e, const std::string &label) {
        const auto tell = [this, name = w.name, now = e.name, done = finished_[w.name],
                           work = work_of(e)](double share) {
            if (request_.on_progress) request_.on_progress(name, std::min(1.0, (done + share * work) / work_), now);
        };
        tell(0);
        RenderJob job = job_of(e, seed_of(w), request_.threads);
        if (const auto fault = request_.injected.find(w.name); fault != request_.injected.end())
            job = with_fault(std::move(job), fault->second);
        return {&w,
                std::move(job),
                {request_.folder, label, request_.tracer, request_.time_limit, tell},
                noise_wanted(w, e),
                tiles_wanted(w, e)};
    }

    /// Through given points of the pixels only what is drawn at random has noise.
    static bool is_noisy(const Witness &w, const Experiment &e) {
        return !w.pictures && (e.sampling == Sampling::box || (w.adapter && w.adapter->sample_factor > 1));
    }

    std::optional<NoiseWanted> noise_wanted(const Witness &w, const Experiment &e) const {
        if (!request_.tolerance || !is_noisy(w, e)) return std::nullopt;
        const bool box = e.sampling == Sampling::box;
        if (!box && !e.tile_budget) return std::nullopt;
        NoiseWanted wanted{*request_.tolerance};
        if (!box || !e.tile_budget) wanted.least_samples = e.samples_per_pixel;
        if (!e.tile_budget) return wanted;
        // Of independent pixels a tile's mean has 1 / tile_px of their noise; an interval within the tolerance takes
        // four standard errors or so.
        constexpr double standard_errors = 4;
        wanted.absolute = total(e.tile_budget(Accuracy{}, Accuracy{})) * e.tile_px / standard_errors;
        return wanted;
    }

    /// Where a share of the tiles decides, their noise differs too much for a number of samples fixed beforehand.
    std::optional<TilesWanted> tiles_wanted(const Witness &w, const Experiment &e) const {
        if (!e.tile_budget || e.tiles_needed_share == 1 || e.sampling == Sampling::box || !is_noisy(w, e))
            return std::nullopt;
        constexpr int most_times = 16; // as long does it take at most
        return TilesWanted{e.tile_px, total(e.tile_budget(Accuracy{}, Accuracy{})), e.tiles_needed_share,
                           e.samples_per_pixel, most_times * e.samples_per_pixel};
    }

    void keep(RenderRecord record, const Witness &w, const Experiment &e, Preset preset) {
        record.experiment = e.name;
        record.preset = to_string(preset);
        if (!record.from_cache) {
            record_of(w).seconds += record.seconds;
            if (w.is_tracer()) result_.tracer_seconds += record.seconds;
        }
        result_.renders.push_back(std::move(record));
    }

    /// Of those who can speak; a witness that could not give this picture is left out.
    std::vector<Testimony> testimonies_of(const Experiment &e, Preset preset) {
        std::vector<Question> questions;
        for (const Witness &w : request_.witnesses)
            if (record_of(w).present && !broken_.contains(w.name)) {
                questions.push_back(question_for(w, e, e.name));
            }
        std::vector<Testimony> heard;
        const bool at_once = request_.threads != 1;
        double longest = 0, all = 0; // seconds
        for (Answer &answer : hear(std::move(questions), at_once)) {
            finish(*answer.witness, e);
            if (answer.failure) {
                note_failure(*answer.witness, e, answer.failure);
                continue;
            }
            const RenderRecord &record = answer.rendered->record;
            keep(record, *answer.witness, e, preset);
            if (!record.from_cache) {
                longest = std::max(longest, record.seconds);
                all += record.seconds;
            }
            heard.push_back(
                {answer.witness, *std::move(answer.rendered), seed_of(*answer.witness), answer.samples_per_pixel});
        }
        result_.renderer_seconds += at_once ? longest : all;
        return heard;
    }

    /// More replicates of what is undecided. False where there is nothing more to look at.
    bool hear_more(const Experiment &e, Preset preset, const std::vector<Row> &rows, std::vector<Testimony> &heard) {
        std::vector<Question> questions;
        for (const Testimony &t : heard) {
            if (t.witness->pictures) continue;
            const int wanted = replicates_for_second_look(t.witness->name, e.replicates, rows);
            if (wanted == 0) continue;
            Experiment longer = e;
            longer.replicates = wanted;
            Question question = question_for(*t.witness, longer, e.name + "-more");
            question.noise.reset(); // a pilot has spoken
            question.job.samples_per_pixel = t.samples_per_pixel;
            question.job.replicates.erase(question.job.replicates.begin(),
                                          question.job.replicates.begin() + e.replicates);
            questions.push_back(std::move(question));
        }
        bool more = false;
        const auto start = Clock::now();
        for (Answer &answer : hear(std::move(questions), request_.threads != 1)) {
            if (!answer.rendered) continue; // it spoke once: what that left open stays open
            keep(answer.rendered->record, *answer.witness, e, preset);
            Testimony &t = *std::ranges::find(heard, answer.witness, &Testimony::witness);
            std::ranges::move(answer.rendered->images, std::back_inserter(t.rendered.images));
            more = true;
        }
        result_.renderer_seconds += seconds_since(start);
        return more;
    }

    /// Numbers that the first look leaves open are looked at once more.
    std::vector<Row> rows_of(const Experiment &e, Preset preset, std::vector<Testimony> &testimonies,
                             const std::vector<Testimony> &of_partner) {
        std::vector<Row> rows = judged_rows(e, testimonies, of_partner, first_look);
        // A pair of pictures has as many replicates as either has.
        if (e.measure_pair || !hear_more(e, preset, rows, testimonies)) return rows;
        const std::vector<Row> again = judged_rows(e, testimonies, of_partner, second_look);
        for (std::size_t i = 0; i < rows.size(); ++i)
            if (rows[i].verdict == Verdict::undecided && again[i].measured.replicates > rows[i].measured.replicates)
                rows[i] = again[i];
        return rows;
    }

    void note_failure(const Witness &w, const Experiment &e, const std::exception_ptr &failure) {
        try {
            std::rethrow_exception(failure);
        } catch (const Error &error) {
            // The program itself failed: the others go on, and what they found is not lost.
            const bool of_renderer =
                !w.is_tracer() && (error.code() == Exit::timed_out || error.code() == Exit::input_output ||
                                   error.code() == Exit::bad_data);
            if (!of_renderer) throw;
            const std::string problem = fmt::format("{} gave no picture of {}: {}", w.title, e.name, error.what());
            // What it refuses, or a picture that nobody made, says nothing of other scenes.
            if (error.code() == Exit::bad_data || w.pictures) {
                refusals_.push_back(problem);
                return;
            }
            record_of(w).problem = problem;
            broken_.insert(w.name);
            if (error.code() == Exit::timed_out) exit_ = Exit::timed_out;
        }
    }

    ClaimResult judge_claim(const PlannedClaim &planned) {
        ClaimResult result;
        result.name = planned.claim->name;
        result.statement = planned.claim->statement;
        result.preset = to_string(planned.context.preset);
        if (!planned.problem.empty()) {
            refusals_.push_back(planned.problem);
            result.summary = "It could not be asked: these values leave it no scene.";
            result.notes = {planned.problem};
            return result;
        }
        bool complete = true;
        std::map<std::string, std::vector<Testimony>> heard;
        for (const Experiment &e : planned.experiments) {
            result.experiments.push_back(e.record);
            if (e.inspect) {
                for (const Witness &w : request_.witnesses) complete = inspect(w, e, result) && complete;
                continue;
            }
            std::vector<Testimony> testimonies = testimonies_of(e, planned.context.preset);
            for (const Witness &w : request_.witnesses)
                complete = complete && record_of(w).problem.empty() &&
                           std::ranges::count(testimonies, &w, &Testimony::witness) == 1;
            judge_pictures(e, testimonies, result);
            std::ranges::move(rows_of(e, planned.context.preset, testimonies, heard[e.partner]),
                              std::back_inserter(result.rows));
            if (std::ranges::any_of(planned.experiments, [&](const Experiment &o) { return o.partner == e.name; }))
                heard[e.name] = std::move(testimonies);
        }
        const bool compared = !result.rows.empty() || !result.tiles.empty(); // one picture alone agrees with nothing
        result.verdict = complete && compared ? Verdict::holds : Verdict::undecided;
        const bool calibrating = result.name == calibration_name;
        const auto counts = [&](const std::string &witness, const std::string &versus) {
            for (const WitnessRecord &w : result_.witnesses)
                if ((w.name == witness || w.name == versus) && !w.problem.empty() && !calibrating) return false;
            return true;
        };
        for (const Row &row : result.rows)
            if (counts(row.witness, row.versus)) {
                result.verdict = all_of(result.verdict, row.verdict);
                // A difference names neither side alone, and a conclusion that optics itself denies is nobody's fault.
                if (row.verdict == Verdict::fails && row.versus.empty() && row.relation == Relation::equal)
                    blame(result, row.witness);
            }
        for (const TileComparison &tiles : result.tiles)
            if (counts(tiles.witness, tiles.versus)) result.verdict = all_of(result.verdict, tiles.verdict);
        if (std::ranges::all_of(result_.witnesses, [](const WitnessRecord &w) { return w.problem.empty(); }))
            blame_the_odd_one_out(result);
        if (planned.claim->summary) result.summary = planned.claim->summary(planned.context, result.verdict);
        if (planned.claim->notes) result.notes = planned.claim->notes(planned.context);
        for (const Experiment &e : planned.experiments)
            if (std::ranges::any_of(result.rows, [&](const Row &row) {
                    return row.experiment == e.name && std::isnan(row.measured.mean);
                }))
                result.notes.push_back(fmt::format(
                    "With these values \"{}\" cannot be read: what is looked for is hidden, too narrow, or not "
                    "in the picture. Of that nothing is said.",
                    e.title));
        for (const std::string &name : unused_values(planned))
            result.notes.push_back(fmt::format("This claim sets {} itself: your value is not used.", name));
        if (planned.claim->flips) result.flips = planned.claim->flips(planned.context);
        if (planned.claim->scope) result.scope = scope_findings(planned.claim->scope(planned.context, {}));
        return result;
    }

    /// Each effect once, by the number that it could move farthest beyond its margin.
    static std::vector<ScopeFinding> scope_findings(const std::vector<ScopeNumber> &numbers) {
        std::vector<ScopeFinding> findings;
        for (const EffectEntry &entry : effects())
            if (const ScopeNumber *n = most_moved(numbers, entry.effect); n && n->requires_effect(entry.effect))
                findings.push_back({std::string(entry.name), n->quantity, n->unit, n->value,
                                    n->bounds.of(entry.effect).value, n->margin, scope_sentence(*n, entry.effect)});
        return findings;
    }

    static void blame(ClaimResult &result, const std::string &witness) {
        if (std::ranges::count(result.blamed, witness) == 0) result.blamed.push_back(witness);
    }

    /// Of three pictures of one scene, two that agree with each other and not with the third.
    void blame_the_odd_one_out(ClaimResult &result) const {
        for (const ExperimentRecord &e : result.experiments)
            for (const Witness &w : request_.witnesses) {
                int with = 0, failing_with = 0, without = 0, holding_without = 0;
                for (const TileComparison &t : result.tiles) {
                    if (t.experiment != e.name) continue;
                    const bool takes_part = t.witness == w.name || t.versus == w.name;
                    (takes_part ? with : without) += 1;
                    failing_with += takes_part && t.verdict == Verdict::fails;
                    holding_without += !takes_part && t.verdict == Verdict::holds;
                }
                if (with > 1 && failing_with == with && without > 0 && holding_without == without)
                    blame(result, w.name);
            }
    }

    void judge_pictures(const Experiment &e, const std::vector<Testimony> &testimonies, ClaimResult &result) {
        std::vector<Image> means;
        for (const Testimony &t : testimonies) {
            means.push_back(mean(t.rendered.images));
            result.pictures.push_back(
                {ReportPicture::Kind::render, e.name, t.witness->title, encode_png_preview(means.back())});
            if (e.draw) result.pictures.back().marks = e.draw(means.back(), e.scene.camera);
        }
        if (!e.tile_budget) return;
        for (std::size_t i = 0; i < testimonies.size(); ++i)
            for (std::size_t j = i + 1; j < testimonies.size(); ++j) {
                const Testimony &a = testimonies[i], &b = testimonies[j];
                const std::vector<BudgetItem> budget =
                    e.tile_budget(a.rendered.record.accuracy, b.rendered.record.accuracy);
                TileComparison tiles = compare_tiles(a.rendered.images, b.rendered.images, e.tile_px, total(budget),
                                                     e.tiles_needed_share, e.shift_replicates);
                tiles.experiment = e.name;
                tiles.witness = a.witness->name;
                tiles.versus = b.witness->name;
                tiles.budget = budget;
                const double scale = 0.1 * tiles.mean_radiance;
                result.pictures.push_back(
                    {ReportPicture::Kind::difference, e.name,
                     fmt::format("{} minus {}: red brighter, blue darker, full colour at 10 % of the mean",
                                 a.witness->title, b.witness->title),
                     encode_png_preview(difference_picture(means[i], means[j], scale))});
                result.tiles.push_back(std::move(tiles));
            }
    }

    void take_votes_away(const std::vector<ClaimResult> &calibrations) {
        for (WitnessRecord &w : result_.witnesses) {
            if (!w.present || broken_.contains(w.name)) continue;
            std::optional<Verdict> verdict;
            for (const ClaimResult &calibration : calibrations)
                for (const Row &row : calibration.rows)
                    if (row.witness == w.name) verdict = all_of(verdict.value_or(Verdict::holds), row.verdict);
            if (verdict) w.calibrated = *verdict == Verdict::holds;
            if (verdict != Verdict::holds)
                w.problem =
                    fmt::format("{} {}: it has no vote", w.title,
                                verdict == Verdict::fails ? "failed its calibration" : "could not be calibrated");
        }
    }

    void conclude() {
        result_.verdict = Verdict::holds;
        std::vector<std::string> failing, open, blamed, problems;
        const auto named = [this](const ClaimResult &c) {
            return request_.presets.size() > 1 ? fmt::format("{} ({})", c.name, c.preset) : c.name;
        };
        for (const ClaimResult &c : result_.claims) {
            result_.verdict = all_of(result_.verdict, c.verdict);
            if (c.verdict == Verdict::fails) failing.push_back(named(c));
            if (c.verdict == Verdict::undecided) open.push_back(named(c));
            for (const std::string &b : c.blamed)
                if (std::ranges::count(blamed, b) == 0) blamed.push_back(b);
        }
        for (const WitnessRecord &w : result_.witnesses)
            if (!w.problem.empty()) problems.push_back(w.problem);
        problems.insert(problems.end(), refusals_.begin(), refusals_.end());
        switch (result_.verdict) {
        case Verdict::holds:
            result_.summary =
                fmt::format("Every conclusion checked holds in {}, within tolerances that were fixed before "
                            "rendering.",
                            voters());
            break;
        case Verdict::fails:
            result_.summary =
                fmt::format("Fails: {}{}.", fmt::join(failing, ", "),
                            blamed.empty() ? "" : fmt::format(" (the numbers of {} are off)", fmt::join(blamed, ", ")));
            break;
        case Verdict::undecided:
            result_.summary = fmt::format("Undecided: {}.", fmt::join(open, ", "));
            break;
        }
        for (const std::string &p : problems) result_.summary += " " + p + ".";
        if (exit_ != Exit::timed_out)
            exit_ = result_.verdict == Verdict::holds   ? Exit::holds
                    : result_.verdict == Verdict::fails ? Exit::fails
                                                        : Exit::undecided;
    }

    std::string voters() {
        std::vector<std::string> titles;
        for (const WitnessRecord &w : result_.witnesses)
            if (w.problem.empty()) titles.push_back(w.title);
        return fmt::format("{}", fmt::join(titles, ", "));
    }

    const CheckRequest &request_;
    RunResult result_;
    Exit exit_ = Exit::holds;
    double work_ = 0;
    std::map<std::string, double> finished_;
    std::set<std::string> broken_;
    std::vector<std::string> refusals_;
};

} // namespace

CheckOutcome check(const CheckRequest &request) { return Run(request)(); }

} // namespace threefold
