// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "verifier/optics/concentric.h"
#include "verifier/optics/quad.h"

namespace threefold::optics {
namespace {

constexpr double glass = 1.51714;
std::optional<double> deflection_at(const Orb<double> &orb, double b) { return deflection(orb, impact_at(orb, b)); }

double uniform(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1'000'001) / 1e6; }

/// Walls from 1e-8 R to 0.9 R, every fourth orb solid; index 1.001 to 3.
Orb<double> any_orb() {
    const double outer = std::pow(10.0, uniform(-3, 5)), index = uniform(1.001, 3);
    if (*rc::gen::inRange(0, 4) == 0) return solid_ball(outer, index);
    return shell(outer, outer * std::pow(10.0, uniform(-8, std::log10(0.9))), index);
}

/// Anywhere on the orb.
Impact<double> any_impact(const Orb<double> &orb) { return impact_at(orb, uniform(0, 0.999999) * orb.outer_mm); }

/// Where a straight path exists.
Impact<double> any_straight_impact(const Orb<double> &orb) {
    return impact_at(orb, uniform(0, 0.9999) * (orb.is_solid() ? orb.outer_mm : orb.inner_mm));
}

double total(const OrderSum &sum) {
    double weight = 0;
    for (const Order &order : sum.orders) weight += order.weight;
    return weight;
}

// ---------------------------------------------------------------------------------------------------------------------
// The study's figures

TEST(optics_study, a_solid_ball_inverts_the_robe_only_above_an_index_of_1_2103) {
    EXPECT_NEAR(*critical_inversion_index(68.0, 900.0, 250.0), 1.2103, 5e-5);
    EXPECT_LT(paraxial_slope(solid_ball(68.0, 1.2104), 900.0, 250.0), 0);
    EXPECT_GT(paraxial_slope(solid_ball(68.0, 1.2103), 900.0, 250.0), 0);
    EXPECT_FALSE(critical_inversion_index(68.0, 900.0, 34.0).has_value());
}

TEST(optics_study, the_magnification_depends_on_the_distance_of_the_robe) {
    EXPECT_NEAR(*image_magnification(solid_ball(68.0, glass), 900.0, 250.0), -1.040, 5e-4);
    EXPECT_NEAR(*image_magnification(solid_ball(67.98, glass), 1200.0, 297.5), -0.719, 5e-4);
    EXPECT_NEAR(*image_magnification(solid_ball(68.0, glass), 900.0, 150.0), -3.46, 5e-3);
    EXPECT_NEAR(*image_magnification(solid_ball(68.0, 1.658), 900.0, 250.0), -0.779, 5e-4);
    EXPECT_NEAR(*image_magnification(solid_ball(67.98, 1.658), 1200.0, 297.5), -0.561, 5e-4);
}

TEST(optics_study, the_central_slope_of_the_hollow_orb_grows_with_the_wall) {
    EXPECT_NEAR(paraxial_slope(shell(68.0, 0.68, glass), 900.0, 250.0), 1.020, 5e-4);
    EXPECT_NEAR(paraxial_slope(shell(68.0, 1.36, glass), 900.0, 250.0), 1.040, 5e-4);
    EXPECT_NEAR(paraxial_slope(shell(68.0, 2.72, glass), 900.0, 250.0), 1.082, 5e-4);
}

TEST(optics_study, the_wall_bends_outwards_ever_more_towards_the_rim) {
    const Orb<double> orb = shell(68.0, 1.36, glass);
    EXPECT_NEAR(*deflection_at(orb, 0.90 * 68), -0.058, 5e-4);
    EXPECT_NEAR(*deflection_at(orb, 0.95 * 68), -0.106, 5e-4);
    EXPECT_NEAR(*deflection_at(orb, 0.97 * 68), -0.171, 5e-4);
}

TEST(optics_study, the_focal_lengths_are_10_cm_for_the_ball_and_minus_488_cm_for_the_shell) {
    EXPECT_NEAR(*focal_length(solid_ball(68.0, glass)), 99.7, 0.05);
    EXPECT_NEAR(*focal_length(shell(68.0, 1.36, glass)), -4880, 10);
    EXPECT_FALSE(focal_length(solid_ball(68.0, 1.0)).has_value());
}

TEST(optics_study, light_that_keeps_its_polarisation_is_8_percent_brighter_60_mm_from_the_axis) {
    const Orb<double> orb = shell(68.0, 1.36, glass);
    const auto light = *path_transmittance(orb, impact_at(orb, 60.0));
    EXPECT_NEAR(light.unpolarised, 0.627, 5e-4);
    EXPECT_NEAR(light.polarised, 0.678, 5e-4);
}

TEST(optics_study, the_ring_of_total_reflection_is_as_wide_as_the_wall) {
    for (double index : {1.2, glass, 2.4}) {
        const Orb<double> orb = shell(68.0, 2.72, index);
        EXPECT_DOUBLE_EQ(rim_width(orb), 2.72);
        EXPECT_TRUE(deflection_at(orb, orb.inner_mm - 1e-9).has_value());
        EXPECT_FALSE(deflection_at(orb, orb.inner_mm + 1e-9).has_value());
        EXPECT_FALSE(deflection_at(orb, orb.outer_mm - 1e-9).has_value());
    }
}

TEST(optics_study, beside_a_small_hollow_the_ring_ends_and_light_passes_through_glass_only) {
    const Orb<double> orb = shell(68.0, 48.0, 1.5), ball = solid_ball(68.0, 1.5);
    EXPECT_LT(orb.inner_mm, critical_radius(orb));
    EXPECT_DOUBLE_EQ(rim_width(orb), 10);
    EXPECT_FALSE(deflection_at(orb, 29.9).has_value());
    EXPECT_EQ(deflection_at(orb, 30.1), deflection_at(ball, 30.1));
}

TEST(optics_study, a_ball_stops_magnifying_where_the_slope_is_minus_one) {
    const Orb<double> ball = solid_ball(68.0, glass);
    const double plane = *plane_where_magnifying_ends(ball, 900.0);
    EXPECT_NEAR(plane, 256.3, 0.05);
    EXPECT_NEAR(paraxial_slope(ball, 900.0, plane), -1, 1e-14);
    EXPECT_FALSE(plane_where_magnifying_ends(ball, 190.0).has_value());
}

// ---------------------------------------------------------------------------------------------------------------------
// Limits and laws

TEST(optics_deflection, equals_the_textbook_sum_of_inverse_sines) {
    const Orb<Quad> orb = shell(Quad(68), Quad("1.36"), Quad("1.51714"));
    const Quad b = 50, R = 68, r = orb.inner_mm, n = orb.index;
    const Quad book = 2 * (asin(b / R) - asin(b / (n * R)) - asin(b / r) + asin(b / (n * r)));
    EXPECT_LT(abs(*deflection(orb, impact_at(orb, b)) / book - 1), Quad("1e-30"));
    const Quad c = 67, rim = 2 * (asin(c / R) - asin(c / (n * R)) + asin(c / (n * r))) - 2 * asin(Quad(1));
    EXPECT_LT(abs(*rim_deflection(orb, impact_at(orb, c)) / rim - 1), Quad("1e-30"));
}

TEST(optics_deflection, vanishes_on_the_axis_without_contrast_and_without_a_wall) {
    for (const Orb<double> &orb : {shell(68.0, 1.36, 1.0), shell(68.0, 0.0, 1.5), solid_ball(68.0, 1.0)})
        EXPECT_EQ(deflection_at(orb, 40.0), 0.0);
    EXPECT_EQ(deflection_at(shell(68.0, 1.36, 1.5), 0.0), 0.0);
    EXPECT_FALSE(std::signbit(*deflection_at(shell(68.0, 1.36, 1.5), 0.0)));
}

TEST(optics_deflection, is_the_power_times_b_near_the_axis) {
    rc::check([] {
        const Orb<double> orb = any_orb();
        const double b = 1e-7 * (orb.is_solid() ? orb.outer_mm : orb.inner_mm);
        RC_ASSERT(std::abs(*deflection_at(orb, b) / (b * power_per_mm(orb)) - 1) < 1e-12);
    });
}

TEST(optics_deflection, does_not_depend_on_the_scale) {
    rc::check([] {
        const Orb<double> orb = any_orb();
        const Impact<double> impact = any_straight_impact(orb);
        const double scale = std::ldexp(1.0, *rc::gen::inRange(-60, 60)); // powers of two are exact
        const Orb<double> large{orb.outer_mm * scale, orb.inner_mm * scale, orb.wall_mm * scale, orb.index};
        const Impact<double> far{impact.b_mm * scale, impact.below_outer_mm * scale, impact.below_inner_mm * scale};
        RC_ASSERT(deflection(orb, impact) == deflection(large, far));
        RC_ASSERT(path_transmittance(orb, impact)->polarised == path_transmittance(large, far)->polarised);
    });
}

TEST(optics_fresnel, reflected_and_transmitted_power_sum_to_one_for_s_and_p) {
    rc::check([] {
        const double sine = uniform(0, 1), n1 = uniform(1, 3), n2 = uniform(1, 3);
        const auto light = fresnel(sine, n1, n2);
        RC_ASSERT(std::abs(light.reflectance_s + light.transmittance_s - 1) < 1e-14);
        RC_ASSERT(std::abs(light.reflectance_p + light.transmittance_p - 1) < 1e-14);
    });
}

TEST(optics_fresnel, is_the_same_from_both_sides) {
    rc::check([] {
        const double n1 = uniform(1, 2), n2 = uniform(2, 3), sine = uniform(0, 0.99);
        const auto in = fresnel(sine, n1, n2), out = fresnel(n1 * sine / n2, n2, n1);
        RC_ASSERT(std::abs(in.transmittance_s - out.transmittance_s) < 1e-13);
        RC_ASSERT(std::abs(in.transmittance_p - out.transmittance_p) < 1e-13);
    });
}

TEST(optics_fresnel, knows_normal_incidence_brewster_and_the_critical_angle) {
    EXPECT_NEAR(fresnel(0.0, 1.0, 1.5).reflectance(), 0.04, 1e-16);
    EXPECT_LT(fresnel(1.5 / std::hypot(1.0, 1.5), 1.0, 1.5).reflectance_p, 1e-31);
    EXPECT_EQ(fresnel(1 / 1.5, 1.5, 1.0).reflectance(), 1);
    EXPECT_EQ(fresnel(1.0, 1.0, 1.0).transmittance(), 1);
}

// ---------------------------------------------------------------------------------------------------------------------
// Orders

TEST(optics_orders, weights_and_rest_sum_to_one) {
    rc::check([] {
        const Orb<double> orb = any_orb();
        const Impact<double> impact = any_impact(orb);
        const OrderSum sum = transmitted_orders(orb, impact, 1e-9);
        RC_ASSERT(std::abs(total(sum) + sum.remaining_weight - 1) < 1e-11);
        RC_ASSERT(sum.remaining_weight < 1e-9 || sum.orders.size() >= 1'000'000);
    });
}

TEST(optics_orders, begin_with_the_outer_reflection_and_hold_the_straight_path) {
    rc::check([] {
        const Orb<double> orb = any_orb();
        const Impact<double> impact = any_straight_impact(orb);
        const OrderSum sum = transmitted_orders(orb, impact, 1e-3);
        RC_ASSERT(sum.orders.front().weight == fresnel_outer(orb, impact).reflectance());
        const auto straight = std::find_if(sum.orders.begin(), sum.orders.end(), [&](const Order &order) {
            return orb.is_solid() ? order.glass_legs == 1 : order.glass_legs == 2 && order.hollow_chords == 1;
        });
        RC_ASSERT(straight != sum.orders.end());
        RC_ASSERT(straight->deflection_rad == *deflection(orb, impact));
        RC_ASSERT(std::abs(straight->weight / path_transmittance(orb, impact)->unpolarised - 1) < 1e-13);
    });
}

TEST(optics_orders, polarised_orders_sum_to_the_polarised_transmittance) {
    const Orb<double> orb = shell(68.0, 1.36, glass);
    const Impact<double> impact = impact_at(orb, 60.0);
    double straight = 0;
    for (Polarisation polarisation : {Polarisation::s, Polarisation::p})
        for (const Order &order : transmitted_orders(orb, impact, 1e-6, polarisation).orders)
            if (order.glass_legs == 2 && order.hollow_chords == 1) straight += order.weight / 2;
    EXPECT_NEAR(straight, path_transmittance(orb, impact)->polarised, 1e-15);
}

TEST(optics_orders, the_rim_sends_its_first_light_where_the_rim_deflection_says) {
    const Orb<double> orb = shell(68.0, 1.36, glass);
    const Impact<double> impact = impact_at(orb, 67.0);
    const OrderSum sum = transmitted_orders(orb, impact);
    EXPECT_EQ(sum.orders[1].deflection_rad, *rim_deflection(orb, impact));
    EXPECT_NEAR(total(sum), 1, 1e-11);
}

TEST(optics_orders, splitting_every_branch_in_a_tree_gives_the_merged_weights) {
    const Orb<double> orb = shell(67.98, 1.36, glass);
    const Impact<double> impact = impact_at(orb, 66.0);
    const double outer = fresnel_outer(orb, impact).reflectance(), inner = fresnel_inner(orb, impact).reflectance();
    struct Branch {
        int place; ///< 0 going in, 1 in the hollow, 2 going out
        int legs, chords;
        double weight;
    };
    std::vector<Branch> branches{{0, 1, 0, 1 - outer}};
    double straight = 0, echo = 0;
    while (!branches.empty()) {
        const Branch now = branches.back();
        branches.pop_back();
        if (now.legs > 4 || now.chords > 3) continue;
        if (now.place == 2) {
            if (now.legs == 2 && now.chords == 1) straight += now.weight * (1 - outer);
            if (now.legs == 4 && now.chords == 2) echo += now.weight * (1 - outer);
            branches.push_back({0, now.legs + 1, now.chords, now.weight * outer});
            continue;
        }
        const int legs = now.legs + 1, chords = now.chords + 1;
        const bool in_hollow = now.place == 1;
        branches.push_back(
            {in_hollow ? 1 : 2, in_hollow ? now.legs : legs, in_hollow ? chords : now.chords, now.weight * inner});
        branches.push_back({in_hollow ? 2 : 1, in_hollow ? legs : now.legs, in_hollow ? now.chords : chords,
                            now.weight * (1 - inner)});
    }
    for (const Order &order : transmitted_orders(orb, impact).orders) {
        const bool is_straight = order.glass_legs == 2 && order.hollow_chords == 1;
        const bool is_echo = order.glass_legs == 4 && order.hollow_chords == 2;
        if (is_straight || is_echo) {
            EXPECT_NEAR(order.weight, is_straight ? straight : echo, 1e-14);
        }
    }
}

TEST(optics_orders, a_tint_darkens_the_straight_path_at_each_of_four_interfaces) {
    const Orb<double> orb = shell(68.0, 1.36, glass);
    const Impact<double> impact = impact_at(orb, 0.0);
    const auto clear = transmitted_orders(orb, impact),
               tinted = transmitted_orders(orb, impact, 1e-12, Polarisation::unpolarised, 0.89);
    EXPECT_NEAR(tinted.orders[2].weight / clear.orders[2].weight, std::pow(0.89, 4), 1e-14);
    EXPECT_LT(total(tinted), 0.8);
}

TEST(optics_missing_weight, gives_the_deficits_measured_in_a_white_furnace) {
    const Orb<double> orb = shell(67.98, 1.36, glass);
    const Impact<double> impact = impact_at(orb, 66.0);
    EXPECT_NEAR(missing_weight(orb, impact, 1e-4), 1.9e-2, 0.05e-2);
    EXPECT_NEAR(missing_weight(orb, impact, 1e-6), 2.5e-3, 0.05e-3);
    EXPECT_NEAR(missing_weight(orb, impact, 1e-7), 8.7e-4, 0.05e-4);
}

/// The tree itself, branch by branch.
double dropped(double outer, double inner, char place, double weight, double cut) {
    if (weight < cut) return weight;
    const auto next = [&](char to, double share) { return dropped(outer, inner, to, weight * share, cut); };
    switch (place) {
    case 'c':
        return next('x', outer) + next('i', 1 - outer); // at the camera
    case 'i':
        return next('o', inner) + next('h', 1 - inner); // going in
    case 'h':
        return next('h', inner) + next('o', 1 - inner); // in the hollow
    case 'o':
        return next('x', 1 - outer) + next('i', outer); // going out
    default:
        return 0; // gone
    }
}

TEST(optics_missing_weight, equals_the_tree_that_is_walked_branch_by_branch) {
    for (double b : {0.0, 40.0, 63.0, 66.0, 66.5, 67.0}) {
        const Orb<double> orb = shell(67.98, 1.36, glass);
        const Impact<double> impact = impact_at(orb, b);
        const double outer = fresnel_outer(orb, impact).reflectance(), inner = fresnel_inner(orb, impact).reflectance();
        EXPECT_NEAR(missing_weight(orb, impact, 1e-4) / dropped(outer, inner, 'c', 1, 1e-4), 1, 1e-9) << b;
    }
}

TEST(optics_missing_weight, never_grows_when_the_cut_shrinks_and_is_part_of_the_light) {
    rc::check([] {
        const Orb<double> orb = any_orb();
        const Impact<double> impact = any_impact(orb);
        double before = 1 + 1e-12;
        for (double cut : {1e-2, 1e-3, 1e-4, 1e-5}) {
            const double missing = missing_weight(orb, impact, cut, 256);
            RC_ASSERT(missing >= 0);
            RC_ASSERT(missing <= before * (1 + 1e-12));
            before = missing;
        }
    });
}

TEST(optics_missing_weight, a_shallow_tree_loses_what_is_left_after_its_last_interface) {
    const Orb<double> orb = shell(67.98, 1.36, glass);
    const Impact<double> impact = impact_at(orb, 66.0);
    EXPECT_NEAR(missing_weight(orb, impact, 1e-12, 1), 1, 1e-12);
    EXPECT_GT(missing_weight(orb, impact, 1e-9, 20), missing_weight(orb, impact, 1e-9, 60));
}

TEST(optics_missing_weight, is_quick_enough_to_be_asked_for_every_pixel_row) {
    const Orb<double> orb = shell(67.98, 1.36, glass);
    double sum = 0;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 660; ++i) sum += missing_weight(orb, impact_at(orb, i / 10.0), 1e-6);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    EXPECT_GT(sum, 0);
    EXPECT_LT(spent.count() / 660, 5e-3); // well under 1e-3 on an idle machine
}

// ---------------------------------------------------------------------------------------------------------------------
// Rays in space

Vec3 any_direction() {
    const double z = uniform(-1, 1), phi = uniform(0, 2 * std::numbers::pi), rho = std::sqrt(1 - z * z);
    return glm::normalize(Vec3(rho * std::cos(phi), rho * std::sin(phi), z));
}

TEST(optics_transmitted_ray, lands_where_the_plane_closed_form_says) {
    rc::check([] {
        const Orb<double> orb = *rc::gen::inRange(0, 2) ? shell(68.0, uniform(0.1, 5), glass) : solid_ball(68.0, glass);
        const Impact<double> impact = impact_at(orb, uniform(0, 0.9) * 60);
        const double alpha = eye_angle(impact.b_mm, 900.0);
        const Ray ray{{0, 0, 900}, {0, std::sin(alpha), -std::cos(alpha)}};
        const auto out = transmitted_ray(orb, Vec3(0), ray);
        RC_ASSERT(out.has_value());
        const auto point = landing_on_plane(*out, {0, 0, -250}, {0, 0, 1});
        const auto height = landing(orb, impact, 900.0, 250.0);
        RC_ASSERT(point.has_value() == height.has_value());
        if (height) RC_ASSERT(std::abs(point->y - *height) < 1e-10);
    });
}

TEST(optics_transmitted_ray, turns_with_the_scene) {
    rc::check([] {
        const Orb<double> orb = shell(68.0, 1.36, glass);
        const Vec3 axis = any_direction(), centre(uniform(-300, 300), uniform(-300, 300), uniform(-300, 300));
        const Vec3 side = glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
        const double b = uniform(0, 60);
        const Ray flat{{b, 0, 500}, {0, 0, -1}}, turned{centre + b * side + 500.0 * axis, -axis};
        const auto one = transmitted_ray(orb, Vec3(0), flat), other = transmitted_ray(orb, centre, turned);
        RC_ASSERT(one && other);
        const auto to_world = [&](Vec3 v) { return v.x * side + v.y * glm::cross(axis, side) + v.z * axis; };
        RC_ASSERT(glm::length(to_world(one->direction) - other->direction) < 1e-13);
        RC_ASSERT(glm::length(centre + to_world(one->origin_mm) - other->origin_mm) < 1e-12 * 68);
    });
}

TEST(optics_transmitted_ray, goes_back_the_way_it_came) {
    rc::check([] {
        const Orb<double> orb = shell(68.0, uniform(0.01, 20), uniform(1.01, 2.5));
        const Vec3 aim = uniform(0, 0.95) * orb.inner_mm * any_direction();
        const Ray in{Vec3(0, 0, 900), glm::normalize(aim - Vec3(0, 0, 900))};
        const auto out = transmitted_ray(orb, Vec3(0), in);
        RC_PRE(out.has_value());
        const Ray reversed{out->origin_mm + 500.0 * out->direction, -out->direction};
        const auto back = transmitted_ray(orb, Vec3(0), reversed);
        RC_ASSERT(back.has_value());
        RC_ASSERT(glm::length(back->direction + in.direction) < 1e-13);
        const Vec3 offset = in.origin_mm - back->origin_mm;
        RC_ASSERT(glm::length(offset - glm::dot(offset, in.direction) * in.direction) < 1e-10);
    });
}

TEST(optics_transmitted_ray, agrees_with_quad_precision_to_1e_13_of_the_radius) {
    const Orb<double> orb = shell(64.0, 1.25, 1.5); // b, gaps and index exact in double
    for (double b : {0.125, 7.5, 31.0, 60.0, 62.0}) {
        const auto out = transmitted_ray(orb, Vec3(0), {{b, 0, 512}, {0, 0, -1}});
        const Orb<Quad> fine = shell(Quad(64), Quad("1.25"), Quad("1.5"));
        const Quad turn = *deflection(fine, impact_at(fine, Quad(b)));
        const Quad exit = sqrt(Quad(64) * 64 - Quad(b) * b);
        const Quad x = b * cos(turn) - exit * sin(turn), z = -b * sin(turn) - exit * cos(turn);
        EXPECT_NEAR(static_cast<double>(Quad(out->origin_mm.x) - x), 0, 6.4e-12);
        EXPECT_NEAR(static_cast<double>(Quad(out->origin_mm.z) - z), 0, 6.4e-12);
        EXPECT_NEAR(static_cast<double>(Quad(out->direction.x) + sin(turn)), 0, 1e-14);
    }
}

TEST(optics_transmitted_ray, passes_the_centre_unturned) {
    const auto out = transmitted_ray(shell(68.0, 1.36, glass), {1, 2, 3}, {{1, 2, 903}, {0, 0, -1}});
    ASSERT_TRUE(out.has_value());
    EXPECT_EQ(out->direction, Vec3(0, 0, -1));
    EXPECT_EQ(out->origin_mm, Vec3(1, 2, -65));
}

TEST(optics_transmitted_ray, is_nothing_beside_behind_inside_and_in_the_rim) {
    const Orb<double> orb = shell(68.0, 1.36, glass);
    EXPECT_FALSE(transmitted_ray(orb, Vec3(0), {{69, 0, 900}, {0, 0, -1}}));
    EXPECT_FALSE(transmitted_ray(orb, Vec3(0), {{10, 0, 900}, {0, 0, 1}}));
    EXPECT_FALSE(transmitted_ray(orb, Vec3(0), {{10, 0, 10}, {0, 0, -1}}));
    EXPECT_FALSE(transmitted_ray(orb, Vec3(0), {{67, 0, 900}, {0, 0, -1}}));
}

TEST(optics_landing_on_plane, is_nothing_along_the_plane_or_away_from_it) {
    EXPECT_FALSE(landing_on_plane({{0, 0, 0}, {0, 0, 1}}, {0, 0, -5}, {0, 0, 1}));
    EXPECT_FALSE(landing_on_plane({{0, 0, 0}, {1, 0, 0}}, {0, 0, -5}, {0, 0, 1}));
    EXPECT_EQ(landing_on_plane({{1, 2, 0}, {0, 0, -1}}, {0, 0, -5}, {0, 0, 3}), Vec3(1, 2, -5));
}

} // namespace
} // namespace threefold::optics
