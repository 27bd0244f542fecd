// SPDX-License-Identifier: MIT
#include "verifier/agreement/equivalence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <boost/math/distributions/students_t.hpp>

namespace threefold {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double quantile(double degrees_of_freedom, double upper_tail) {
    return boost::math::quantile(complement(boost::math::students_t(degrees_of_freedom), upper_tail));
}

} // namespace

std::string_view to_string(Verdict verdict) {
    switch (verdict) {
    case Verdict::holds:
        return "holds";
    case Verdict::fails:
        return "fails";
    case Verdict::undecided:
        return "undecided";
    }
    return "";
}

std::string_view to_string(Relation relation) {
    switch (relation) {
    case Relation::equal:
        return "equal";
    case Relation::below:
        return "below";
    case Relation::above:
        return "above";
    }
    return "";
}

Verdict all_of(Verdict a, Verdict b) {
    if (a == Verdict::fails || b == Verdict::fails) return Verdict::fails;
    if (a == Verdict::undecided || b == Verdict::undecided) return Verdict::undecided;
    return Verdict::holds;
}

Estimate estimate(std::span<const double> values) {
    const auto n = static_cast<double>(values.size());
    if (values.empty()) return {std::numeric_limits<double>::quiet_NaN(), infinity, 1, 0};
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double squares = 0;
    for (const double v : values) squares += (v - mean) * (v - mean);
    if (values.size() == 1) return {mean, infinity, 1, 1}; // one number says nothing of its noise
    if (squares == 0) return {mean, 0, infinity, static_cast<int>(values.size())};
    return {mean, std::sqrt(squares / (n - 1) / n), n - 1, static_cast<int>(values.size())};
}

Estimate difference(const Estimate &a, const Estimate &b) {
    const double va = a.standard_error * a.standard_error, vb = b.standard_error * b.standard_error;
    const double inverse = va * va / a.degrees_of_freedom + vb * vb / b.degrees_of_freedom;
    const double freedom = inverse > 0 ? (va + vb) * (va + vb) / inverse : infinity;
    return {a.mean - b.mean, std::sqrt(va + vb), freedom, std::min(a.replicates, b.replicates)};
}

Interval interval(const Estimate &e, double level) {
    if (e.standard_error == 0) return {e.mean, e.mean};
    const double half = quantile(e.degrees_of_freedom, level) * e.standard_error;
    return {e.mean - half, e.mean + half};
}

Verdict judge(const Interval &m, Relation relation, double value, double tolerance) {
    switch (relation) {
    case Relation::equal:
        if (m.low >= value - tolerance && m.high <= value + tolerance) return Verdict::holds;
        if (m.low > value + tolerance || m.high < value - tolerance) return Verdict::fails;
        return Verdict::undecided;
    case Relation::below:
        if (m.high < value) return Verdict::holds;
        return m.low >= value ? Verdict::fails : Verdict::undecided;
    case Relation::above:
        if (m.low > value) return Verdict::holds;
        return m.high <= value ? Verdict::fails : Verdict::undecided;
    }
    return Verdict::undecided;
}

Verdict judge(const Estimate &m, Relation relation, double value, double tolerance, double level) {
    const Verdict verdict = judge(interval(m, level), relation, value, tolerance);
    if (relation == Relation::equal && verdict == Verdict::fails && p_value_of_difference(m, value, tolerance) > level)
        return Verdict::undecided;
    return verdict;
}

std::optional<int> replicates_to_decide(const Estimate &m, Relation relation, double value, double tolerance,
                                        double level) {
    const double from_edge =
        relation == Relation::equal ? std::abs(std::abs(m.mean - value) - tolerance) : std::abs(m.mean - value);
    if (!(from_edge > 0) || !std::isfinite(m.standard_error) || m.replicates < 2) return std::nullopt;
    if (m.standard_error == 0) return m.replicates;
    const double spread = m.standard_error * std::sqrt(static_cast<double>(m.replicates));
    for (double n = m.replicates; n <= 1e6; n = std::ceil(n * 1.1))
        if (judge(Estimate{m.mean, spread / std::sqrt(n), n - 1, static_cast<int>(n)}, relation, value, tolerance,
                  level) != Verdict::undecided)
            return static_cast<int>(n);
    return std::nullopt;
}

double p_value_of_difference(const Estimate &m, double value, double tolerance) {
    const double excess = std::abs(m.mean - value) - tolerance;
    if (std::isnan(excess)) return 1;
    if (m.standard_error == 0) return excess > 0 ? 0 : 1;
    const boost::math::students_t t(m.degrees_of_freedom);
    const auto beyond = [&](double distance) { return boost::math::cdf(complement(t, distance / m.standard_error)); };
    return std::min(1.0, beyond(excess) + beyond(excess + 2 * tolerance));
}

bool more_differ_than(int allowed, std::vector<double> p_values, double level) {
    const auto others = static_cast<std::ptrdiff_t>(p_values.size()) - allowed;
    if (others <= 0) return false;
    const auto last = p_values.begin() + allowed;
    std::ranges::nth_element(p_values, last);
    return *last * static_cast<double>(others) <= level;
}

double total(const std::vector<BudgetItem> &budget) {
    return std::accumulate(budget.begin(), budget.end(), 0.0,
                           [](double sum, const BudgetItem &item) { return sum + item.value; });
}

} // namespace threefold
