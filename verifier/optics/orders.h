// SPDX-License-Identifier: MIT
// All orders of reflection: where the light that meets an orb at impact b goes, in the limit of the whole ray tree.
// b never changes, so the tree's branches fall into few states (in the glass going in, in the hollow, in the glass
// going out), and branches that crossed the wall and the hollow equally often leave in the same direction. Merging them
// turns a tree of 2^depth rays into a table. In a white furnace the weights say directly what a renderer must see.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "verifier/optics/orb.h"

namespace threefold::optics {

/// `unpolarised` averages Fresnel's s and p at every interface, as renderers do; the truth is the mean of an `s` and a
/// `p` sum.
enum class Polarisation { unpolarised, s, p };

/// All light that leaves after the same number of crossings. Shell: `glass_legs` crossings of the wall, always even,
/// and `hollow_chords` of the hollow. Solid: chords in the glass. 0 and 0: reflected outside; (2, 1) or (1, 0): the
/// straight path.
struct Order {
    double weight;
    double deflection_rad; ///< the whole turn, not reduced by full circles; positive towards the axis
    int glass_legs, hollow_chords;
};

struct OrderSum {
    std::vector<Order> orders;
    double remaining_weight; ///< of what was not followed to its exit
};

/// Follows the light until no more than `remaining_weight` (of 1) is left inside, or until there are `most_orders`
/// orders: grazing light may go round millions of times. Without absorption the weights and the rest sum to 1.
/// `interface_transmittance` is the tint of Glass: a factor on light that crosses an interface.
OrderSum transmitted_orders(const Orb<double> &orb, const Impact<double> &impact, double remaining_weight = 1e-12,
                            Polarisation polarisation = Polarisation::unpolarised, double interface_transmittance = 1,
                            std::size_t most_orders = 1'000'000);

/// What an unmerged binary ray tree loses: every interface splits a ray into a reflected and a refracted one, and a ray
/// (also one that leaves) whose own weight, the product of unpolarised Fresnel shares along its path, is below
/// `cut_weight` is dropped, as is every ray after `most_interfaces` interfaces. The sum of the dropped weights is the
/// deficit in a white furnace. This is what adc_bailout does in POV-Ray 3.7 (most_interfaces 256): from the axis to the
/// rim, for cuts of 1e-4 and 1e-6, its deficit was this one within half a step of its 16-bit output. Weights are
/// products To Ro^p Ti^c Ri^d; branches with equal products are counted together.
double missing_weight(const Orb<double> &orb, const Impact<double> &impact, double cut_weight,
                      int most_interfaces = std::numeric_limits<int>::max());

} // namespace threefold::optics
