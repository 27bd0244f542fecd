// SPDX-License-Identifier: MIT
#include "verifier/optics/orders.h"

#include <algorithm>
#include <cmath>

#include "verifier/optics/deflection.h"
#include "verifier/optics/fresnel.h"

namespace threefold::optics {
namespace {

struct Shares {
    double reflect, transmit;
};

Shares shares(const Fresnel<double> &fresnel, Polarisation polarisation, double interface_transmittance) {
    switch (polarisation) {
    case Polarisation::unpolarised:
        return {fresnel.reflectance(), interface_transmittance * fresnel.transmittance()};
    case Polarisation::s:
        return {fresnel.reflectance_s, interface_transmittance * fresnel.transmittance_s};
    case Polarisation::p:
        return {fresnel.reflectance_p, interface_transmittance * fresnel.transmittance_p};
    }
    return {};
}

/// Light that never enters turns by -(pi - 2 asin(b/R)).
double outside_reflection(const Orb<double> &orb, const Impact<double> &impact) {
    return -2 * std::atan2(outer_chords(orb, impact).air_mm, impact.b_mm);
}

OrderSum orders_in_glass(const Orb<double> &orb, const Impact<double> &impact, Shares outer, double least_rest,
                         std::size_t most_orders) {
    // The angle about the centre of one chord in the glass: pi - 2 asin(b/(n R)).
    const double chord = 2 * std::atan2(outer_chords(orb, impact).glass_mm, impact.b_mm / orb.index);
    const double straight = 2 * turn_at_outer(orb, impact);
    OrderSum sum{{{outer.reflect, outside_reflection(orb, impact), 0, 0}}, outer.transmit};
    for (int legs = 1; sum.remaining_weight > least_rest && sum.orders.size() < most_orders; ++legs) {
        sum.orders.push_back({sum.remaining_weight * outer.transmit, straight + (legs - 1) * chord, legs, 0});
        sum.remaining_weight *= outer.reflect;
    }
    return sum;
}

/// From the weights going inwards, by hollow chords made so far, to the weights going outwards one wall leg later.
/// Adds what it leaves behind in the hollow to `left`, at most `tail` of it.
std::vector<double> cross_hollow(const std::vector<double> &inwards, Shares inner, double tail, std::size_t most,
                                 double &left) {
    std::vector<double> outwards;
    double in_hollow = 0;
    for (std::size_t chords = 0;; ++chords) {
        const bool more = chords < inwards.size();
        const double arriving = more ? inwards[chords] : 0;
        if (!more && (in_hollow <= tail || chords >= most)) break;
        outwards.push_back(inner.reflect * arriving + inner.transmit * in_hollow);
        in_hollow = inner.transmit * arriving + inner.reflect * in_hollow;
    }
    left += in_hollow;
    return outwards;
}

OrderSum orders_in_shell(const Orb<double> &orb, const Impact<double> &impact, Shares outer, Shares inner,
                         double least_rest, std::size_t most_orders) {
    const bool enters = course(orb, impact) == Course::through_hollow;
    const double two_legs = 2 * wall_angle(orb, impact);
    const double hollow_chord = 2 * std::atan2(inner_chords(orb, impact).air_mm, impact.b_mm);
    // Deflections are counted from the straight path, or the rim's, which are known without cancellation.
    const double base = enters ? *deflection(orb, impact) : *rim_deflection(orb, impact);
    const int base_chords = enters ? 1 : 0;

    OrderSum sum{{{outer.reflect, outside_reflection(orb, impact), 0, 0}}, 0};
    std::vector<double> inwards{outer.transmit};
    double inside = outer.transmit;
    for (int turns = 1; inside > least_rest / 2 && sum.orders.size() < most_orders; ++turns) {
        // Over all turns `inside` sums to at most 1, so the tails sum to at most half of the allowed rest.
        const std::size_t room = most_orders - sum.orders.size();
        inwards = cross_hollow(inwards, inner, least_rest / 2 * inside, room, sum.remaining_weight);
        inside = 0;
        for (std::size_t chords = 0; chords < inwards.size(); ++chords) {
            double &weight = inwards[chords];
            if (weight > 0)
                sum.orders.push_back(
                    {weight * outer.transmit,
                     base + (turns - 1) * two_legs + (static_cast<int>(chords) - base_chords) * hollow_chord, 2 * turns,
                     static_cast<int>(chords)});
            weight *= outer.reflect;
            inside += weight;
        }
    }
    sum.remaining_weight += inside;
    return sum;
}

double missing_in_glass(Shares outer, double cut, int most_interfaces) {
    double missing = 0, weight = outer.transmit;
    for (int met = 1;; ++met) {
        if (weight < cut || met >= most_interfaces) return missing + weight;
        const double leaving = weight * outer.transmit;
        if (leaving < cut || met + 1 >= most_interfaces) missing += leaving;
        weight *= outer.reflect;
    }
}

/// Weights of merged branches by [half the number of inner transmissions][reflections inside the hollow].
using Layer = std::vector<std::vector<double>>;

double &at(Layer &layer, std::size_t crossings, std::size_t echoes) {
    if (layer.size() <= crossings) layer.resize(crossings + 1);
    if (layer[crossings].size() <= echoes) layer[crossings].resize(echoes + 1, 0.0);
    return layer[crossings][echoes];
}

class ShellTree {
public:
    ShellTree(Shares outer, Shares inner, double cut, int most_interfaces)
        : outer_(outer), inner_(inner), cut_(cut), most_(most_interfaces) {}

    double missing() {
        Layer inwards{{outer_.transmit}};
        for (int turns = 0; !inwards.empty(); ++turns) inwards = leave(cross(inwards, turns), turns);
        return missing_;
    }

private:
    /// All branches of one entry share To; p outer reflections, c inner transmissions and d inner reflections follow.
    double product(int p, int c, int d) const {
        return outer_.transmit * std::pow(outer_.reflect, p) * std::pow(inner_.transmit, c) *
               std::pow(inner_.reflect, d);
    }
    bool kept(double single, int interfaces, double merged) {
        if (single >= cut_ && interfaces < most_) return true;
        missing_ += merged;
        return false;
    }

    /// Branches going inwards after `turns` outer reflections -> the branches going outwards that they become.
    Layer cross(const Layer &inwards, int turns) {
        Layer outwards;
        for (std::size_t k = 0; k < inwards.size(); ++k) {
            const int crossings = static_cast<int>(k), direct = turns - crossings;
            double single = product(turns, 2 * crossings, direct), hollow = 0;
            for (std::size_t e = 0; e < inwards[k].size() || hollow > 0; ++e) {
                const int met = 1 + 2 * turns + crossings + static_cast<int>(e);
                const double arriving = e < inwards[k].size() ? inwards[k][e] : 0;
                if (arriving > 0 && kept(single, met, arriving)) {
                    at(outwards, k, e) += inner_.reflect * arriving;
                    hollow += inner_.transmit * arriving;
                }
                if (hollow > 0 && !kept(single * inner_.transmit, met + 1, hollow)) hollow = 0;
                if (hollow > 0) at(outwards, k + 1, e) += inner_.transmit * hollow;
                hollow *= inner_.reflect;
                single *= inner_.reflect;
            }
        }
        return outwards;
    }

    /// Branches that reach the outer surface from inside -> those reflected back inwards.
    Layer leave(Layer outwards, int turns) {
        bool any = false;
        for (std::size_t k = 0; k < outwards.size(); ++k) {
            const int crossings = static_cast<int>(k);
            double single = product(turns, 2 * crossings, turns + 1 - crossings);
            for (std::size_t e = 0; e < outwards[k].size(); ++e, single *= inner_.reflect) {
                double &merged = outwards[k][e];
                const int met = 2 + 2 * turns + crossings + static_cast<int>(e);
                if (merged > 0 && kept(single, met, merged)) {
                    kept(single * outer_.transmit, met + 1, merged * outer_.transmit);
                    merged *= outer_.reflect;
                } else
                    merged = 0;
                any = any || merged > 0;
            }
        }
        return any ? outwards : Layer{};
    }

    Shares outer_, inner_;
    double cut_;
    int most_;
    double missing_ = 0;
};

bool stays_in_glass(const Orb<double> &orb, const Impact<double> &impact) {
    return course(orb, impact) == Course::through_glass;
}

} // namespace

OrderSum transmitted_orders(const Orb<double> &orb, const Impact<double> &impact, double remaining_weight,
                            Polarisation polarisation, double interface_transmittance, std::size_t most_orders) {
    if (course(orb, impact) == Course::misses) return {{{1, 0, 0, 0}}, 0};
    const Shares outer = shares(fresnel_outer(orb, impact), polarisation, interface_transmittance);
    if (stays_in_glass(orb, impact)) return orders_in_glass(orb, impact, outer, remaining_weight, most_orders);
    const Shares inner = shares(fresnel_inner(orb, impact), polarisation, interface_transmittance);
    return orders_in_shell(orb, impact, outer, inner, remaining_weight, most_orders);
}

double missing_weight(const Orb<double> &orb, const Impact<double> &impact, double cut_weight, int most_interfaces) {
    if (course(orb, impact) == Course::misses) return 0;
    cut_weight = std::max(cut_weight, std::numeric_limits<double>::min()); // a cut of 0 would never end
    const Shares outer = shares(fresnel_outer(orb, impact), Polarisation::unpolarised, 1);
    const bool keeps_outside = outer.reflect >= cut_weight && most_interfaces > 1;
    const double dropped_outside = keeps_outside ? 0 : outer.reflect;
    if (stays_in_glass(orb, impact)) return dropped_outside + missing_in_glass(outer, cut_weight, most_interfaces);
    const Shares inner = shares(fresnel_inner(orb, impact), Polarisation::unpolarised, 1);
    return dropped_outside + ShellTree(outer, inner, cut_weight, most_interfaces).missing();
}

} // namespace threefold::optics
