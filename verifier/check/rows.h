// SPDX-License-Identifier: MIT
// The numbers of one experiment: what every witness's replicates say, beside the closed form and beside each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "verifier/agreement/result.h"
#include "verifier/claims/claim.h"
#include "verifier/witness/witness.h"

namespace threefold {

/// What one witness made of one experiment: the first of its replicates, or more of them.
struct Testimony {
    const Witness *witness;
    Rendered rendered;
    std::uint64_t seed;    ///< of all its replicates
    int samples_per_pixel; ///< in each of them
};

/// Everything but the measurement and the verdict.
Row row_of(const std::string &experiment, const std::string &witness, const Expected &expected);
/// The same with interval and verdict, each one-sided test at `row.level`.
Row judged(Row row);

/// One row a quantity for every witness, then one for every two of them where the renderers are to agree among
/// themselves. `of_partner`: testimonies on `e.partner`.
std::vector<Row> judged_rows(const Experiment &e, const std::vector<Testimony> &testimonies,
                             const std::vector<Testimony> &of_partner, double level);

/// Of a witness's numbers that are undecided: how many replicates the second look should have in all; 0 where none of
/// them is worth it: where even the greatest number would not do, were the true mean a standard error off to the good
/// side.
/// A difference between two renderers is worth it only to one that has a good part of its noise.
int replicates_for_second_look(const std::string &witness, int replicates, const std::vector<Row> &rows);
/// The same of its pictures. `tiles`: judged at `second_look`.
int replicates_for_second_look(const std::string &witness, int replicates, const std::vector<TileComparison> &tiles);

/// The first look's verdicts stay; what it left undecided is as the second look has it, where one of its renderers did
/// render more. `Judged`: Row or TileComparison; both looks have the same ones in the same order.
template <class Judged>
void take_second_look(std::vector<Judged> &first, std::vector<Judged> second,
                      const std::set<std::string> &rendered_more) {
    for (std::size_t i = 0; i < first.size(); ++i)
        if (first[i].verdict == Verdict::undecided &&
            (rendered_more.contains(first[i].witness) || rendered_more.contains(first[i].versus)))
            first[i] = std::move(second[i]);
}

} // namespace threefold
