// SPDX-License-Identifier: MIT
// Numbers to verdicts. Agreement is equivalence: an interval inside a tolerance that was fixed before, never "no
// difference found" (Schuirmann's two one-sided tests, 1987; Welch's degrees of freedom, 1947).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace threefold {

enum class Verdict { holds, fails, undecided };
std::string_view to_string(Verdict verdict);
/// The verdict of "all of these hold".
Verdict all_of(Verdict a, Verdict b);

/// A number is judged wrongly no more often than this: the level of each one-sided test.
inline constexpr double significance = 0.05;
/// Where a first look leaves a number undecided it is looked at once more, with more replicates. The two looks share
/// the level (Bonferroni), so that a second one buys no error.
inline constexpr double first_look = 0.04, second_look = 0.01;
static_assert(first_look + second_look <= significance);

/// A mean over independent replicates.
struct Estimate {
    double mean = 0;
    double standard_error = 0;
    double degrees_of_freedom = 0; ///< infinite for a number without noise
    int replicates = 0;
};

struct Interval {
    double low = 0, high = 0;
};

Estimate estimate(std::span<const double> replicates);
/// a - b with Welch's degrees of freedom.
Estimate difference(const Estimate &a, const Estimate &b);
/// The 1 - 2 * level interval by Student's t.
Interval interval(const Estimate &e, double level = significance);

/// What is asked of a number. `equal`: it lies within `tolerance` of `value`. `below` and `above`: it lies on that
/// side.
enum class Relation { equal, below, above };
std::string_view to_string(Relation relation);

Verdict judge(const Interval &measured, Relation relation, double value, double tolerance);
/// The same of an estimate, each verdict wrong no more often than `level`: `equal` fails on either side of the
/// tolerance, so that its interval alone would say so of no difference at all twice as often, were the tolerance small.
Verdict judge(const Estimate &measured, Relation relation, double value, double tolerance, double level);

/// How many replicates in all would decide, if mean and spread stay as they are; empty when no number would.
std::optional<int> replicates_to_decide(const Estimate &measured, Relation relation, double value, double tolerance,
                                        double level = significance);

/// p-value of "the true mean is not outside value +- tolerance", on either side; small means that it differs. The worst
/// case counts, a true mean on the edge.
double p_value_of_difference(const Estimate &measured, double value, double tolerance);
/// Do more than `allowed` of these differ? Wrong no more often than `level`, whatever their dependence (Bonferroni over
/// the others; Benjamini and Heller 2008). With 0: does any differ.
bool more_differ_than(int allowed, std::vector<double> p_values, double level);

/// One item of a tolerance, fixed before rendering.
struct BudgetItem {
    std::string name; ///< "quantisation", "tessellation", ...
    double value = 0; ///< in the unit of the quantity
    std::string reason;
};
double total(const std::vector<BudgetItem> &budget);

} // namespace threefold
