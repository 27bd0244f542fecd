// SPDX-License-Identifier: MIT
#include "verifier/check/rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "verifier/check/plan.h"

namespace threefold {

namespace {

constexpr int most_replicates = 96;             ///< of a second look at numbers
constexpr int most_replicates_of_pictures = 32; ///< whole pictures cost more
/// Less than this share of a difference's variance is another's to reduce.
constexpr double least_share_of_noise = 0.1;
/// How many times the replicates are made that would decide if mean and spread stayed as they are: they do not.
constexpr double second_look_reserve = 2;

Row compared(const Row &a, const Row &b) {
    Row row = a;
    row.versus = b.witness;
    row.measured = difference(a.measured, b.measured);
    row.expected = 0;
    for (const BudgetItem &item : b.budget) {
        const auto mine = std::ranges::find(row.budget, item.name, &BudgetItem::name);
        if (mine != row.budget.end())
            mine->value += item.value;
        else
            row.budget.push_back(item);
    }
    return row;
}

std::map<std::string, std::vector<double>> readings_of(const Experiment &e, const Testimony &t,
                                                       const std::vector<Testimony> &of_partner) {
    std::map<std::string, std::vector<double>> readings;
    const auto add = [&](const std::vector<Reading> &more) {
        for (const Reading &r : more) readings[r.quantity].push_back(r.value);
    };
    const std::vector<Image> &images = t.rendered.images;
    Experiment as_heard = e;
    as_heard.replicates = static_cast<int>(images.size());
    const std::vector<Replicate> replicates = replicates_of(as_heard, t.seed);
    const auto other = std::ranges::find(of_partner, t.witness, &Testimony::witness);
    for (std::size_t k = 0; k < images.size(); ++k) {
        const Camera camera = camera_of(e, replicates[k]);
        if (e.measure) add(e.measure(images[k], camera));
        if (e.measure_pair && other != of_partner.end())
            add(e.measure_pair(images[k], other->rendered.images.at(k), camera));
    }
    return readings;
}

/// Of the variance of a difference between two renderers, by their own numbers.
double share_of_noise(const std::string &witness, const Row &difference, const std::vector<Row> &rows) {
    const auto own = std::ranges::find_if(rows, [&](const Row &row) {
        return row.experiment == difference.experiment && row.quantity == difference.quantity &&
               row.witness == witness && row.versus.empty();
    });
    if (own == rows.end() || !(difference.measured.standard_error > 0)) return 1;
    const double share = own->measured.standard_error / difference.measured.standard_error;
    return share * share;
}

/// Few replicates may have put a number nearer to the edge than it lies: as far from it as one standard error allows.
Estimate luckier(const Row &row) {
    Estimate e = row.measured;
    switch (row.relation) {
    case Relation::equal:
        e.mean -= std::clamp(e.mean - row.expected, -e.standard_error, e.standard_error);
        break;
    case Relation::below:
        e.mean -= e.standard_error;
        break;
    case Relation::above:
        e.mean += e.standard_error;
        break;
    }
    return e;
}

} // namespace

Row row_of(const std::string &experiment, const std::string &witness, const Expected &expected) {
    Row row;
    row.experiment = experiment;
    row.quantity = expected.quantity;
    row.unit = expected.unit;
    row.witness = witness;
    row.relation = expected.relation;
    row.expected = expected.value;
    row.budget = expected.budget;
    return row;
}

Row judged(Row row) {
    row.tolerance = total(row.budget);
    row.interval = interval(row.measured, row.level);
    row.verdict = judge(row.measured, row.relation, row.expected, row.tolerance, row.level);
    if (row.verdict == Verdict::undecided)
        row.replicates_to_decide =
            replicates_to_decide(row.measured, row.relation, row.expected, row.tolerance, row.level);
    return row;
}

std::vector<Row> judged_rows(const Experiment &e, const std::vector<Testimony> &testimonies,
                             const std::vector<Testimony> &of_partner, double level) {
    std::vector<Row> rows;
    if (!e.predict) return rows;
    std::map<std::string, std::vector<Row>> between;
    for (const Testimony &t : testimonies) {
        auto readings = readings_of(e, t, of_partner);
        for (const Expected &expected : e.predict(t.rendered.record.accuracy)) {
            Row row = row_of(e.name, t.witness->name, expected);
            row.measured = estimate(readings[expected.quantity]);
            row.level = level;
            rows.push_back(judged(std::move(row)));
            if (expected.between_renderers) between[expected.quantity].push_back(rows.back());
        }
    }
    for (const auto &[quantity, of_all] : between)
        for (std::size_t i = 0; i < of_all.size(); ++i)
            for (std::size_t j = i + 1; j < of_all.size(); ++j) rows.push_back(judged(compared(of_all[i], of_all[j])));
    return rows;
}

int replicates_for_second_look(const std::string &witness, int replicates, const std::vector<Row> &rows) {
    int wanted = 0;
    for (const Row &row : rows) {
        if (row.verdict != Verdict::undecided || (row.witness != witness && row.versus != witness)) continue;
        if (!row.versus.empty() && share_of_noise(witness, row, rows) < least_share_of_noise) continue;
        const auto enough = [&row](const Estimate &measured) {
            const auto n = replicates_to_decide(measured, row.relation, row.expected, row.tolerance, second_look);
            return n ? *n : std::numeric_limits<double>::infinity();
        };
        if (const double n = enough(row.measured); n <= most_replicates)
            wanted = std::max(wanted, std::min(most_replicates, static_cast<int>(std::ceil(n * second_look_reserve))));
        else if (enough(luckier(row)) <= most_replicates)
            wanted = most_replicates;
    }
    return wanted > replicates ? wanted : 0;
}

int replicates_for_second_look(const std::string &witness, int replicates, const std::vector<TileComparison> &tiles) {
    int wanted = 0;
    for (const TileComparison &t : tiles) {
        if (t.verdict != Verdict::undecided || !t.problem.empty() || (t.witness != witness && t.versus != witness))
            continue;
        const double share = t.witness == witness ? t.noise_of_witness : 1 - t.noise_of_witness;
        if (share < least_share_of_noise) continue;
        if (!t.replicates_to_decide || *t.replicates_to_decide > most_replicates_of_pictures)
            wanted = most_replicates_of_pictures;
        else
            wanted = std::max(wanted, std::min(most_replicates_of_pictures,
                                               static_cast<int>(*t.replicates_to_decide * second_look_reserve)));
    }
    return wanted > replicates ? wanted : 0;
}

} // namespace threefold
