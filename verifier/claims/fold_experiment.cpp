// SPDX-License-Identifier: MIT
#include "verifier/claims/fold_experiment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scenes/error.h"
#include "verifier/claims/fold_numbers.h"
#include "verifier/measure/fold_edges.h"

namespace threefold {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double outside_from = 1.02, outside_to = 1.25; ///< of the radius: where the edges' course outside is read
constexpr double orb_share = 0.6;                        ///< of the film's width: room for the folds beside the orb
constexpr double greatest_window_px = 8;                 ///< to both sides of an edge
constexpr double window_share = 0.45;                    ///< of the way to the next edge
constexpr double edge_error_px = 0.006;                  ///< of a reading after the means over circles and replicates

constexpr double coarsest_surface = 2e-5;  ///< of the radius: how far tessellated spheres may stray
constexpr double wall_error = 4e-3;        ///< of the wall, likewise
constexpr double finest_surface = 2.5e-6;  ///< of the radius: finer spheres are not asked for
constexpr double resolution_arcmin = 0.03; ///< the least difference of a jump that matters here, at the eye

/// Everything fixed before rendering.
struct FoldPicture {
    Scene scene;
    FoldScene folds;
    std::vector<double> inside_mm, outside_mm; ///< impact parameters of the circles
    double bright = 0, dark = 0;               ///< radiance of the robe and of its folds
    double mm_per_px = 0;                      ///< on the robe
    double mm_per_minute = 0;                  ///< on the robe: what a minute of arc at the eye covers
    double radius_px = 0;
};

double flat_radiance(const Surface &surface) {
    if (const auto *emissive = std::get_if<Emissive>(&surface))
        if (const auto *colour = std::get_if<Rgb>(&emissive->radiance)) return (colour->r + colour->g + colour->b) / 3;
    throw Error(Exit::internal, "the folds can only be measured on a flat robe");
}

/// An edge on one circle as the closed form sees it, and how far on either side it may be looked for.
struct Look {
    double azimuth_rad, window_rad;
};

std::vector<const FoldEdge *> edges_of(const FoldScene &scene) {
    std::vector<const FoldEdge *> edges;
    for (const Fold &fold : scene.folds) {
        edges.push_back(&fold.left);
        edges.push_back(&fold.right);
    }
    return edges;
}

std::optional<Look> look_for(const FoldPicture &p, const FoldEdge &edge, double circle_mm) {
    const auto azimuth = edge_azimuth(p.folds, edge, circle_mm);
    if (!azimuth) return std::nullopt;
    double window = greatest_window_px / (p.radius_px * circle_mm / p.folds.orb.optics.outer_mm);
    for (const FoldEdge *other : edges_of(p.folds)) {
        if (other == &edge) continue;
        if (const auto there = edge_azimuth(p.folds, *other, circle_mm))
            window = std::min(window, window_share * std::abs(*there - *azimuth));
    }
    return Look{*azimuth, window};
}

/// Folds are told apart where there is robe between them. Throws where another one lies over a fold that is asked for,
/// or so close that no window is left between their edges.
void require_apart(const FoldPicture &p, const std::vector<std::size_t> &asked) {
    constexpr double least_window_px = 1;
    const auto refuse = [](std::size_t fold, std::size_t other) {
        throw Error(Exit::bad_data,
                    fmt::format("{} and {} overlap, or nearly, where their breaks are read", name_of_fold(fold),
                                name_of_fold(other)),
                    "folds.miss_mm, folds.step_deg and folds.width_deg must leave robe between them");
    };
    for (const std::size_t k : asked)
        for (const auto *circles : {&p.inside_mm, &p.outside_mm})
            for (const double b : {circles->front(), circles->back()}) {
                const auto left = edge_azimuth(p.folds, p.folds.folds[k].left, b),
                           right = edge_azimuth(p.folds, p.folds.folds[k].right, b);
                if (!left || !right) continue;
                const double middle = (*left + *right) / 2, half = std::abs(*left - *right) / 2;
                const double least = least_window_px / window_share / (p.radius_px * b / p.folds.orb.optics.outer_mm);
                for (std::size_t other = 0; other < p.folds.folds.size(); ++other)
                    for (const FoldEdge *edge : {&p.folds.folds[other].left, &p.folds.folds[other].right}) {
                        if (other == k) continue;
                        if (const auto there = edge_azimuth(p.folds, *edge, b))
                            if (std::abs(std::remainder(*there - middle, 2 * std::numbers::pi)) < half + least)
                                refuse(k, other);
                    }
            }
}

/// Where the edge is seen on the circle, followed straight to the robe.
AlongAcross seen_at(const FoldPicture &p, const FoldEdge &edge, bool left, double circle_mm, const Image &image,
                    const Camera &camera) {
    const auto look = look_for(p, edge, circle_mm);
    if (!look) return AlongAcross(nan);
    const auto path = [&](double azimuth) {
        const Ray ray = ray_on_circle(p.folds, circle_mm, azimuth);
        return image_position(camera, ray.origin_mm + ray.direction);
    };
    const int steps = 16 * static_cast<int>(std::ceil(greatest_window_px));
    const double azimuth =
        edge_along(image, path, look->azimuth_rad - look->window_rad, look->azimuth_rad + look->window_rad,
                   left ? p.dark : p.bright, left ? p.bright : p.dark, steps);
    if (std::isnan(azimuth)) return AlongAcross(nan);
    return straight_place(edge, ray_on_circle(p.folds, circle_mm, azimuth));
}

std::vector<AlongAcross> seen_on(const FoldPicture &p, const FoldEdge &edge, bool left,
                                 const std::vector<double> &circles_mm, const Image &image, const Camera &camera) {
    std::vector<AlongAcross> places;
    for (const double b : circles_mm) places.push_back(seen_at(p, edge, left, b, image, camera));
    return places;
}

double measured_jump(const FoldPicture &p, std::size_t fold, const Image &image, const Camera &camera) {
    const Fold &f = p.folds.folds[fold];
    double sum = 0;
    for (const bool left : {true, false}) {
        const FoldEdge &edge = left ? f.left : f.right;
        sum += jump_from_line(seen_on(p, edge, left, p.outside_mm, image, camera),
                              seen_on(p, edge, left, p.inside_mm, image, camera));
    }
    return sum / 2;
}

/// The window of the film that holds all that is looked at, with a margin for the blur.
Crop crop_for(const FoldPicture &p, const std::vector<std::size_t> &folds) {
    Camera whole = p.scene.camera;
    whole.crop.reset();
    Vec2 low(whole.width_px, whole.height_px), high(0);
    for (const std::size_t k : folds)
        for (const FoldEdge *edge : {&p.folds.folds[k].left, &p.folds.folds[k].right})
            for (const auto *circles : {&p.inside_mm, &p.outside_mm})
                for (const double b : {circles->front(), circles->back()})
                    if (const auto look = look_for(p, *edge, b))
                        for (const double side : {-1.0, 1.0}) {
                            const Ray ray = ray_on_circle(p.folds, b, look->azimuth_rad + side * look->window_rad);
                            const Vec2 at = image_position(whole, ray.origin_mm + ray.direction);
                            low = glm::min(low, at);
                            high = glm::max(high, at);
                        }
    constexpr double margin_px = 4, least_px = 16;
    const auto span = [&](double from, double to, int film) {
        const double middle = (from + to) / 2, half = std::max(to - from, least_px) / 2 + margin_px;
        const int first = std::clamp(static_cast<int>(std::floor(middle - half)), 0, film - 1);
        return std::pair(first, std::clamp(static_cast<int>(std::ceil(middle + half)), first + 1, film) - first);
    };
    const auto [x, width] = span(low.x, high.x, whole.width_px);
    const auto [y, height] = span(low.y, high.y, whole.height_px);
    return {x, y, width, height};
}

/// How the jump answers to errors of the two radii.
double jump_per_radius(const FoldPicture &p, const Fold &fold) {
    const double step = 1e-5 * p.folds.orb.optics.outer_mm;
    const auto jump_of = [&](double outer, double wall) {
        FoldScene changed = p.folds;
        changed.orb.optics = optics::shell(outer, wall, p.folds.orb.optics.index);
        return fold_jump(changed, fold, p.inside_mm).value_or(nan);
    };
    const double outer = p.folds.orb.optics.outer_mm, wall = p.folds.orb.optics.wall_mm;
    const double here = jump_of(outer, wall), thinner = jump_of(outer, std::max(wall - step, wall / 2));
    const double by_wall = std::abs(here - thinner) / std::min(step, wall / 2);
    return std::abs(jump_of(outer + step, wall) - here) / step + 2 * by_wall;
}

std::vector<BudgetItem> jump_budget(const FoldPicture &p, std::size_t fold, const Accuracy &a) {
    const Fold &f = p.folds.folds[fold];
    const double answer = jump_per_radius(p, f), robe_per_orb = p.mm_per_px * p.radius_px / p.folds.orb.optics.outer_mm;
    const double reach = (outside_from + outside_to) / 2 - p.inside_mm.front() / p.folds.orb.optics.outer_mm;
    const double lever = 2 + 2 * reach / (outside_to - outside_from);
    return {
        {"edge", edge_error_px * lever * p.mm_per_px,
         fmt::format("an edge that curves through finite pixels: {:g} px at either end of the ring outside and on the "
                     "ring inside, times a lever of {:.3g}",
                     edge_error_px, lever)},
        {"tessellation", (1 + answer) * a.surface_mm,
         fmt::format("distance of the rendered spheres from the true ones, times an answer of {:.3g}", 1 + answer)},
        {"quantisation", a.radiance_step / (p.bright - p.dark) * 2 * greatest_window_px * p.mm_per_px,
         "shares of two known radiances"},
        {"resolution", p.mm_per_minute * resolution_arcmin,
         fmt::format("{:g} minutes of arc at the eye: the least difference that matters here", resolution_arcmin)},
        {"arithmetic", 4 * (1 + answer) * robe_per_orb * a.rounding_mm, "rounding of positions"},
    };
}

void draw_edge(const FoldPicture &p, std::size_t fold, bool left, const Image &image, const Camera &camera,
               std::vector<Mark> &marks) {
    const FoldEdge &edge = left ? p.folds.folds[fold].left : p.folds.folds[fold].right;
    const auto position = [&](const Ray &ray) { return image_position(camera, ray.origin_mm + ray.direction); };
    const std::string label = left ? fmt::format("{}", fold + 1) : "";
    for (const auto *circles : {&p.outside_mm, &p.inside_mm}) {
        const auto from = edge_azimuth(p.folds, edge, circles->front()),
                   to = edge_azimuth(p.folds, edge, circles->back());
        if (!from || !to) continue;
        Mark line{Mark::Kind::line,
                  position(ray_on_circle(p.folds, circles->front(), *from)),
                  position(ray_on_circle(p.folds, circles->back(), *to)),
                  0,
                  Mark::Meaning::expected,
                  ""};
        if (circles == &p.outside_mm) line.label = label;
        marks.push_back(line);
        const double middle = (*circles)[circles->size() / 2];
        const AlongAcross seen = seen_at(p, edge, left, middle, image, camera);
        if (std::isnan(seen.x)) continue;
        const Vec3 along = glm::normalize(edge.end_mm - edge.start_mm), across = glm::cross(Vec3(0, 0, 1), along);
        marks.push_back({Mark::Kind::cross, image_position(camera, edge.start_mm + seen.x * along + seen.y * across),
                         Vec2(0), 0, Mark::Meaning::measured, ""});
    }
}

std::string jump_name(std::size_t fold) { return "jump of " + name_of_fold(fold); }
std::string jump_name_px(std::size_t fold) { return jump_name(fold) + " in the picture"; }

} // namespace

Experiment fold_experiment(const ClaimContext &context, const FoldPlan &plan) {
    const std::vector<Assignment> own{
        assign("glass.coating", "antireflective"),
        assign("glass.interface_transmittance", "1"),
        assign("robe.surface", "flat"),
        assign("image.orb_share", orb_share),
        assign("environment.radiance", "0.3"),
    };
    const double film = 2 * std::ceil(plan.radius_px / orb_share);
    Experiment e =
        fold_setup(context, plan.name, plan.title, plan.defaults,
                   joined(joined(own, plan.fixed), {assign("image.width_px", film), assign("image.height_px", film)}));
    const double radius = orb_of(e.scene).optics.outer_mm;

    FoldPicture p;
    p.folds = fold_scene_of(e.scene);
    p.radius_px = plan.radius_px;
    p.inside_mm = fold_circles_mm(e);
    p.outside_mm = even_steps(outside_from * radius, outside_to * radius,
                              std::clamp(static_cast<int>((outside_to - outside_from) * plan.radius_px), 6, 80));
    p.mm_per_px = 2 * film_half_width(e.scene.camera) / e.scene.camera.width_px * eye_to_robe_mm(e);
    p.mm_per_minute = eye_to_robe_mm(e) * std::numbers::pi / (180 * 60);
    p.bright = flat_radiance(card_of(e.scene).surface);
    for (const Object &object : e.scene.objects)
        if (const Mesh *mesh = std::get_if<Mesh>(&object.shape)) p.dark = flat_radiance(mesh->surface);
    p.scene = e.scene;
    require_apart(p, plan.folds);
    e.scene.camera.crop = crop_for(p, plan.folds);
    p.scene = e.scene;

    e.sampling = Sampling::box;
    e.samples_per_pixel = plan.samples_per_pixel;
    e.shift_replicates = true; // the pixels' grid meets the edges elsewhere in every replicate
    e.surface_tolerance_mm =
        std::max(std::min(coarsest_surface * radius, wall_error * p.folds.orb.optics.wall_mm), finest_surface * radius);
    e.predict = [p, plan](const Accuracy &a) {
        std::vector<Expected> expected;
        for (const std::size_t k : plan.folds) {
            if (!plan.rows) break;
            const double jump = fold_jump(p.folds, p.folds.folds[k], p.inside_mm).value_or(nan);
            std::vector<BudgetItem> budget = jump_budget(p, k, a);
            expected.push_back({jump_name(k), "mm", Relation::equal, jump, budget, true});
            if (!plan.pixel_rows) continue;
            for (BudgetItem &item : budget) item.value /= p.mm_per_px;
            expected.push_back({jump_name_px(k), "px", Relation::equal, jump / p.mm_per_px, budget});
        }
        for (const FoldConclusion &c : plan.conclusions)
            expected.push_back({c.quantity, "mm", c.relation, c.value_mm, {}});
        return expected;
    };
    e.measure = [p, plan](const Image &image, const Camera &camera) {
        std::vector<Reading> readings;
        std::map<std::size_t, double> jumps;
        for (const std::size_t k : plan.folds) {
            jumps[k] = measured_jump(p, k, image, camera);
            readings.push_back({jump_name(k), jumps[k]});
            readings.push_back({jump_name_px(k), jumps[k] / p.mm_per_px});
        }
        for (const FoldConclusion &c : plan.conclusions) {
            double greatest = 0;
            for (const std::size_t k : c.folds) {
                const double jump = std::abs(jumps.contains(k) ? jumps[k] : nan);
                if (std::isnan(jump) || jump > greatest) greatest = jump;
                if (std::isnan(jump)) break;
            }
            readings.push_back({c.quantity, greatest});
        }
        return readings;
    };
    e.draw = [p, plan](const Image &image, const Camera &camera) {
        std::vector<Mark> marks;
        for (const std::size_t k : plan.folds)
            for (const bool left : {true, false}) draw_edge(p, k, left, image, camera, marks);
        return marks;
    };
    return e;
}

} // namespace threefold
