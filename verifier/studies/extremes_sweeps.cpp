// SPDX-License-Identifier: MIT
#include "verifier/studies/extremes_sweeps.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace threefold {

namespace {

constexpr double radius_mm = 68, eye_mm = 900, card_mm = 250, card_half_mm = 544, index = 1.51714, wall = 0.02;
constexpr int side_px = 13;            // odd: the middle pixel looks along the axis, where the impact is 0
constexpr double film_over_orb = 1.16; // of the widths, where a camera is fitted to the orb
constexpr int light_side_px = 5;       // a light probe is the same all over

Glass coated(double n = index) { return {n, 1, Coating::antireflective}; }

GlassShell shell(double wall_share, double n = index) {
    return {Vec3(0), radius_mm, radius_mm * wall_share, coated(n)};
}
GlassBall ball(double n = index) { return {Vec3(0), radius_mm, coated(n)}; }

Scene before_card(Shape orb, double at_mm = card_mm) {
    Scene scene;
    scene.objects = {{"orb", std::move(orb)},
                     {"card", Quad{{0, 0, -at_mm}, {card_half_mm, 0, 0}, {0, card_half_mm, 0}, CoordinateCard{}}}};
    scene.camera.eye_mm = {0, 0, eye_mm};
    scene.camera.width_px = scene.camera.height_px = side_px;
    return scene;
}

/// Parallel rays about the impact (1 - gap) * edge, a quarter of the gap to either side.
void look_along_edge(Scene &scene, double edge_mm, double gap) {
    Camera &c = scene.camera;
    const double b_mm = edge_mm * (1 - gap);
    c.projection = Projection::orthographic;
    c.eye_mm = {b_mm, 0, eye_mm};
    c.target_mm = {b_mm, 0, 0};
    c.orthographic_width_mm = 0.5 * gap * edge_mm;
}

Scene scaled(Scene s, double by) {
    for (Object &object : s.objects)
        std::visit(overloaded{[by](GlassBall &b) {
                                  b.centre_mm *= by;
                                  b.radius_mm *= by;
                              },
                              [by](GlassShell &b) {
                                  b.centre_mm *= by;
                                  b.outer_radius_mm *= by;
                                  b.wall_mm *= by;
                              },
                              [by](Quad &q) {
                                  q.centre_mm *= by;
                                  q.half_u_mm *= by;
                                  q.half_v_mm *= by;
                              },
                              [](Mesh &) {}},
                   object.shape);
    s.camera.eye_mm *= by;
    s.camera.target_mm *= by;
    return s;
}

Scene moved_by(Scene s, Vec3 by_mm) {
    for (Object &object : s.objects)
        std::visit(overloaded{[by_mm](GlassBall &b) { b.centre_mm += by_mm; },
                              [by_mm](GlassShell &b) { b.centre_mm += by_mm; },
                              [by_mm](Quad &q) { q.centre_mm += by_mm; }, [](Mesh &) {}},
                   object.shape);
    s.camera.eye_mm += by_mm;
    s.camera.target_mm += by_mm;
    return s;
}

/// A film so wide, and the orb four fifths of the way to its left edge: the pixels about it alone are asked for. In the
/// middle of a wide film the orb would be less than a pixel, and everything else dark.
void look_past(Scene &scene, double fov_deg) {
    Camera &c = scene.camera;
    const double half_width = std::tan(fov_deg * std::numbers::pi / 360), tangent = 0.8 * half_width;
    const double secant = std::hypot(1, tangent);
    c.horizontal_fov_deg = fov_deg;
    c.target_mm = c.eye_mm + eye_mm * Vec3(tangent / secant, 0, -1 / secant);
    // Upright the orb is as tall as the crop but for a margin; sideways the film stretches it more.
    const double half_orb = secant * radius_mm / std::sqrt(eye_mm * eye_mm - radius_mm * radius_mm);
    const double pixel = 2 * half_orb * film_over_orb / side_px;
    c.width_px = std::max(side_px, 2 * static_cast<int>(std::ceil(half_width / pixel)));
    c.height_px = side_px;
    const int middle = static_cast<int>(0.1 * c.width_px);
    c.crop = Crop{std::clamp(middle - side_px / 2, 0, c.width_px - side_px), 0, side_px, side_px};
}

struct Value {
    double value;
    bool promised;
};

std::vector<Value> decades(int from, int to, const std::function<bool(int)> &promised, double factor = 1) {
    std::vector<Value> values;
    const int step = from <= to ? 1 : -1;
    for (int e = from; e != to + step; e += step)
        values.push_back({factor * std::stod(fmt::format("1e{}", e)), promised(e)});
    return values;
}

ExtremeSweep sweep(std::string name, std::string title, std::string number, const std::vector<Value> &values,
                   const std::function<Scene(double)> &scene) {
    ExtremeSweep s{std::move(name), std::move(title), std::move(number), Probe::landing, {}};
    for (const Value &v : values)
        s.points.push_back({fmt::format("{:g}", v.value), v.value, scene(v.value), v.promised});
    return s;
}

std::vector<Value> join(std::vector<Value> a, const std::vector<Value> &b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

constexpr auto always = [](int) { return true; };

std::vector<ExtremeSweep> shape_sweeps() {
    std::vector<ExtremeSweep> all;
    all.push_back(sweep(
        "wall", "Ever thinner wall of a hollow orb", "wall / R",
        join(join(decades(-1, -4, always), {{1e-3 / radius_mm, true}}), join(decades(-5, -9, always), {{0, false}})),
        [](double w) { return before_card(shell(w)); }));
    all.back().points[4].label = "1 µm";
    all.back().points[4].landmark = true;
    all.push_back(sweep("hollow", "Ever smaller hollow in a thick orb", "hollow / R",
                        {{0.5, true},
                         {0.1, true},
                         {1e-2, true},
                         {1e-3, true},
                         {2e-4, true},
                         {1e-6, true},
                         {1e-9, true},
                         {1e-12, false},
                         {0, false}},
                        [](double h) {
                            Scene scene = before_card(shell(1 - h));
                            // Only rays near the axis meet so small a hollow.
                            scene.camera.horizontal_fov_deg *= h > 0.5 ? 1 : std::max(h, 1e-9) * 1.5;
                            return scene;
                        }));
    const auto indices =
        join(join({{4, true}, {3, true}, {2, true}, {index, true}}, {{1.1, true}, {1.001, true}, {1 + 1e-6, true}}),
             {{1 + 1e-9, true}, {1 + 1e-12, false}, {1, false}});
    for (const bool solid : {true, false}) {
        ExtremeSweep s = sweep(
            solid ? "index-solid" : "index-hollow", solid ? "Index of a solid orb" : "Index of a hollow orb", "index",
            indices, [solid](double n) { return solid ? before_card(ball(n)) : before_card(shell(wall, n)); });
        for (ExtremePoint &p : s.points)
            if (p.value < 1.001 && p.value > 1) p.label = fmt::format("1+{:.0e}", p.value - 1);
        all.push_back(std::move(s));
    }
    const auto nine = [](int e) { return e >= -9; };
    all.push_back(
        sweep("grazing-solid", "Rays that graze a solid orb", "1 - b / R", decades(-1, -12, nine), [](double gap) {
            Scene scene = before_card(ball());
            // They leave by up to 97 degrees to the way they came: the card stands aside.
            std::get<Quad>(scene.objects[1].shape) = {
                {-card_mm, 0, 0}, {0, 0, card_half_mm}, {0, card_half_mm, 0}, CoordinateCard{}};
            look_along_edge(scene, radius_mm, gap);
            return scene;
        }));
    all.push_back(sweep("grazing-hollow", "Rays that graze the hollow from inside", "1 - b / r", decades(-1, -12, nine),
                        [](double gap) {
                            Scene scene = before_card(shell(wall));
                            look_along_edge(scene, radius_mm - radius_mm * wall, gap);
                            return scene;
                        }));
    return all;
}

std::vector<ExtremeSweep> place_sweeps() {
    std::vector<ExtremeSweep> all;
    const auto six = [](int e) { return e >= -6 && e <= 6; };
    all.push_back(sweep("small", "The whole scene ever smaller", "scale", decades(0, -9, six),
                        [](double by) { return scaled(before_card(shell(wall)), by); }));
    all.push_back(sweep("large", "The whole scene ever larger", "scale", decades(0, 9, six),
                        [](double by) { return scaled(before_card(shell(wall)), by); }));
    all.push_back(
        sweep("offset", "The whole scene far from the origin", "offset / R", join({{0, true}}, decades(0, 8, always)),
              [](double by) { return moved_by(before_card(shell(wall)), by * radius_mm * Vec3(0.6, 0.64, -0.48)); }));
    return all;
}

std::vector<ExtremeSweep> view_sweeps() {
    std::vector<ExtremeSweep> all;
    ExtremeSweep near =
        sweep("eye-near", "The eye comes to the orb", "(eye - R) / R",
              join(decades(1, -9, always), {{-0.01, false}, {-0.5, false}, {-1, false}}), [](double gap) {
                  Scene scene = before_card(shell(wall));
                  scene.camera.eye_mm = {0, 0, radius_mm * (1 + gap)};
                  scene.camera.target_mm = {0, 0, -card_mm};
                  scene.camera.horizontal_fov_deg =
                      gap >= 1 ? 2 * std::atan(film_over_orb / (1 + gap)) * 180 / std::numbers::pi : 80;
                  return scene;
              });
    near.points[near.points.size() - 3].label = "in wall";
    near.points[near.points.size() - 2].label = "in hollow";
    near.points.back().label = "centre";
    all.push_back(std::move(near));
    all.push_back(sweep("eye-far", "The eye goes away, its field of view with it", "eye / R", decades(1, 8, always),
                        [](double d) {
                            Scene scene = before_card(shell(wall));
                            scene.camera.eye_mm = {0, 0, radius_mm * d};
                            scene.camera.horizontal_fov_deg = 2 * std::atan(film_over_orb / d) * 180 / std::numbers::pi;
                            return scene;
                        }));
    all.push_back(sweep("view", "Field of view", "degrees",
                        {{10, true},
                         {90, true},
                         {150, true},
                         {175, true},
                         {179, true},
                         {1, true},
                         {0.1, true},
                         {1e-2, true},
                         {1e-3, true},
                         {1e-4, true},
                         {1e-5, true},
                         {1e-6, true}},
                        [](double fov) {
                            Scene scene = before_card(shell(wall));
                            if (fov < 10) scene.camera.target_mm = {0.6 * radius_mm, 0.2 * radius_mm, 0};
                            scene.camera.horizontal_fov_deg = fov;
                            if (fov > 60) look_past(scene, fov);
                            return scene;
                        }));
    all.push_back(sweep(
        "target", "The point that the camera looks at, nearer and farther on one line", "(eye - target) / R",
        {{1e-9, true}, {1e-6, true}, {1e-3, true}, {1, true}, {1e3, true}, {1e6, true}, {1e9, true}}, [](double d) {
            Scene scene = before_card(shell(wall));
            const Vec3 aim(0.05, 0.03, -1);
            scene.camera.target_mm = scene.camera.eye_mm + d * radius_mm * aim;
            return scene;
        }));
    all.push_back(sweep("backdrop", "The backdrop comes to the orb, and touches it", "gap / R",
                        join(decades(0, -9, always), {{0, true}}),
                        [](double gap) { return before_card(shell(wall), radius_mm * (1 + gap)); }));
    return all;
}

/// Light inside is reflected with the share F; so many reflections leave a millionth of it.
std::string reflections(double gap) {
    const double sine = 1 - gap, cosine = std::sqrt(gap * (2 - gap));
    const double inside = std::sqrt((index - sine) * (index + sine)) / index;
    const double s = (cosine - index * inside) / (cosine + index * inside),
                 p = (index * cosine - inside) / (index * cosine + inside);
    const double lost = 1 - (s * s + p * p) / 2;
    return fmt::format("{:.0f}", std::log(1e-6) / std::log1p(-lost));
}

std::vector<ExtremeSweep> light_sweeps() {
    const auto furnace = [](Shape orb, double edge_mm, double gap) {
        Scene scene;
        scene.objects = {{"orb", std::move(orb)}};
        scene.environment = Environment{Rgb(1)};
        scene.camera.width_px = scene.camera.height_px = light_side_px;
        look_along_edge(scene, edge_mm, gap);
        return scene;
    };
    std::vector<ExtremeSweep> all;
    all.push_back(sweep("reflections-solid", "Light trapped at the rim of a solid orb",
                        "reflections until 1e-6 is left", decades(-1, -9, always), [&](double gap) {
                            return furnace(GlassBall{Vec3(0), radius_mm, {}}, radius_mm, gap);
                        }));
    for (ExtremePoint &p : all.back().points) p.label = reflections(p.value);
    all.push_back(sweep("reflections-wall", "Light trapped in a thin wall: b = r (1 - wall / R)", "wall / R",
                        decades(-1, -4, always), [&](double gap) {
                            const GlassShell orb{Vec3(0), radius_mm, radius_mm * gap, {}};
                            return furnace(orb, orb.inner_radius_mm(), gap);
                        }));
    for (ExtremeSweep &s : all) s.probe = Probe::light;
    return all;
}

} // namespace

std::vector<ExtremeSweep> extreme_sweeps(bool quick) {
    std::vector<ExtremeSweep> all;
    for (auto make : {shape_sweeps, place_sweeps, view_sweeps, light_sweeps})
        for (ExtremeSweep &s : make()) all.push_back(std::move(s));
    if (quick)
        for (ExtremeSweep &s : all) {
            std::vector<ExtremePoint> few;
            const std::size_t n = s.points.size();
            for (std::size_t i = 0; i < n; ++i)
                if (i % 3 == 0 || i + 2 >= n || s.points[i].landmark) few.push_back(std::move(s.points[i]));
            s.points = std::move(few);
        }
    return all;
}

} // namespace threefold
