// SPDX-License-Identifier: MIT
#include "verifier/studies/power.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <set>
#include <system_error>

#include <boost/math/distributions/beta.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include "exporter/files.h"
#include "verifier/check/check.h"
#include "verifier/studies/power_pictures.h"
#include "verifier/tracer/sampler.h"

namespace threefold {

namespace {

using Clock = std::chrono::steady_clock;

/// Without what is there to be looked at, where nothing is judged; in a quick study also without the renders on both
/// sides of flip points. They are made once: a claim's experiments follow from its context.
Claim as_studied(const Claim &claim, const ClaimContext &context, bool without_flips) {
    std::vector<Experiment> experiments = claim.experiments(context);
    std::erase_if(experiments, [](const Experiment &e) { return !e.predict && !e.tile_budget; });
    if (without_flips && claim.flips)
        for (const FlipPoint &flip : claim.flips(context))
            std::erase_if(experiments,
                          [&](const Experiment &e) { return std::ranges::count(flip.bracket, e.name) > 0; });
    Claim studied = claim;
    studied.experiments = [experiments](const ClaimContext &) { return experiments; };
    studied.summary = nullptr; // read by nobody
    studied.notes = nullptr;
    studied.flips = nullptr;
    studied.scope = nullptr;
    return studied;
}

std::vector<std::string> failing(const RunResult &result) {
    std::vector<std::string> names;
    for (const ClaimResult &c : result.claims)
        if (c.verdict == Verdict::fails) names.push_back(c.name);
    return names;
}

class PowerStudy {
public:
    explicit PowerStudy(const PowerRequest &request)
        : request_(request), faulty_(find_faulty(request)), pictures_(request) {
        // The claims' small pictures, always: a fault must be caught on them.
        const ClaimContext small{request.scenes, Preset::text, {}, true};
        for (const Claim &claim : request.claims) claims_.push_back(as_studied(claim, small, request.quick));
    }

    PowerResult operator()() {
        const auto start = Clock::now();
        result_.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
        result_.faulty = faulty_.title;
        result_.precision = request_.tracer.precision == Precision::single_precision ? "float" : "double";
        result_.quick = request_.quick;
        result_.resolution = request_.quick ? 2 : 1.1;
        for (const Witness &w : request_.witnesses) result_.witnesses.push_back(w.name);
        for (const Claim &c : claims_) result_.claims.push_back(c.name);
        result_.picture_scenes = pictures_.names();
        steps_ = 1 + 3.0 * static_cast<double>(request_.faults.size()) + request_.runs;

        tell("no fault");
        const RunResult honest = checked(claims_, nullptr, request_.seed);
        result_.honest = honest.verdict;
        result_.honest_failures = failing(honest);
        done_ += 1;
        pictures_.make_references();
        for (const Fault fault : request_.faults) result_.rows.push_back(row_of(fault));
        count_false_alarms();
        result_.seconds = std::chrono::duration<double>(Clock::now() - start).count();
        return std::move(result_);
    }

private:
    static const Witness &find_faulty(const PowerRequest &request) {
        const auto found = std::ranges::find(request.witnesses, request.faulty, &Witness::name);
        if (found == request.witnesses.end())
            throw Error(Exit::usage, fmt::format("the renderer with the faults, {}, takes no part", request.faulty));
        return *found;
    }

    void tell(const std::string &now) const {
        if (request_.on_progress) request_.on_progress(std::min(1.0, done_ / steps_), now);
    }

    RunResult checked(const std::vector<Claim> &claims, const InjectedFault *fault, std::uint64_t seed) {
        CheckRequest check_request;
        check_request.claims = claims;
        check_request.witnesses = request_.witnesses;
        check_request.scenes = request_.scenes;
        check_request.quick = true;
        check_request.seed = request_.seed;
        check_request.seeds[faulty_.name] = seed;
        check_request.threads = request_.threads;
        check_request.tracer = request_.tracer;
        check_request.time_limit = request_.time_limit;
        check_request.folder = request_.folder;
        if (fault) check_request.injected[faulty_.name] = *fault;
        RunResult result = check(check_request).result;
        ++result_.evaluations;
        for (const RenderRecord &render : result.renders)
            if (render.witness == faulty_.name) { // hundreds of them would fill the disk
                std::error_code ignored;
                std::filesystem::remove_all(request_.folder / render.folder, ignored);
            }
        return result;
    }

    std::vector<std::string> newly_failing(const RunResult &result) const {
        std::vector<std::string> names = failing(result);
        std::erase_if(
            names, [this](const std::string &name) { return std::ranges::count(result_.honest_failures, name) > 0; });
        return names;
    }

    PowerRow row_of(Fault fault) {
        const FaultEntry &entry = entry_of(fault);
        PowerRow row;
        row.fault = fault;
        tell(std::string(entry.name));
        const RunResult result = checked(claims_, &row.fault, request_.seed);
        row.verdict = result.verdict;
        row.caught_by = newly_failing(result);
        row.pictures = pictures_.judge(&row.fault, tracer::mix(request_.seed));
        done_ += 1;
        if (row.caught() && kinds_.insert(entry.kind).second) search_smallest(row, entry);
        done_ += 2;
        return row;
    }

    /// Claim by claim until one fails. A claim that missed a larger fault of this kind is not asked about a smaller
    /// one.
    void search_smallest(PowerRow &row, const FaultEntry &entry) {
        struct Asked {
            const Claim *claim;
            double missed = 0; ///< the greatest departure from honest that it did not see
        };
        std::vector<Asked> asked;
        // Where calibration fails the other claims have no vote; below that they may see what it does not.
        const bool all = row.caught_by == std::vector<std::string>{"calibration"};
        for (const Claim &claim : claims_)
            if (all || std::ranges::count(row.caught_by, claim.name) > 0) asked.push_back({&claim});
        const double start = done_;
        const auto is_caught = [&](double size) {
            const InjectedFault smaller(row.fault.fault, size);
            tell(to_string(smaller));
            done_ = std::min(done_ + 0.2, start + 1.9);
            const double departure = std::abs(size - entry.honest);
            return std::ranges::any_of(asked, [&](Asked &a) {
                if (departure <= a.missed) return false;
                const bool caught =
                    !newly_failing(checked(with_calibration(*a.claim), &smaller, request_.seed)).empty();
                if (!caught) a.missed = departure;
                return caught;
            });
        };
        row.smallest = smallest_fault(entry, is_caught, result_.resolution);
        done_ = start;
    }

    std::vector<Claim> with_calibration(const Claim &claim) const {
        std::vector<Claim> both;
        for (const Claim &c : claims_)
            if (c.name == "calibration" || c.name == claim.name) both.push_back(c);
        return both;
    }

    void count_false_alarms() {
        FalseAlarms &alarms = result_.false_alarms;
        for (int run = 1; run <= request_.runs; ++run) {
            tell(fmt::format("no fault, run {} of {}", run, request_.runs));
            const std::uint64_t seed = request_.seed + static_cast<std::uint64_t>(run);
            const RunResult result = checked(claims_, nullptr, seed);
            ++alarms.runs;
            alarms.ours += result.verdict == Verdict::fails;
            alarms.undecided += result.verdict == Verdict::undecided;
            for (const std::string &name : failing(result)) alarms.failing_claims.push_back(name);
            bool idiff = false, rms = false, z_test = false;
            for (const PictureJudgement &p : pictures_.judge(nullptr, tracer::mix(seed))) {
                idiff |= p.idiff.fails;
                rms |= p.rms.fails;
                z_test |= p.z_test.fails;
            }
            alarms.idiff += idiff;
            alarms.rms += rms;
            alarms.z_test += z_test;
            done_ += 1;
        }
    }

    const PowerRequest &request_;
    const Witness &faulty_;
    PowerPictures pictures_;
    std::vector<Claim> claims_;
    std::set<std::string_view> kinds_; ///< whose smallest size is known
    PowerResult result_;
    double done_ = 0, steps_ = 1;
};

} // namespace

double FalseAlarms::upper_bound(int alarms, int runs) {
    if (alarms >= runs) return 1;
    constexpr double confidence = 0.95;
    return boost::math::quantile(boost::math::beta_distribution<>(alarms + 1, runs - alarms), confidence);
}

Verdict PowerResult::verdict() const {
    const bool all_caught = std::ranges::all_of(rows, [](const PowerRow &row) { return row.caught(); });
    return all_caught && false_alarms.ours <= most_false_alarms * false_alarms.runs ? Verdict::holds : Verdict::fails;
}

PowerResult study_power(const PowerRequest &request) { return PowerStudy(request)(); }

} // namespace threefold
