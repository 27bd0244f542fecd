// SPDX-License-Identifier: MIT
#include "verifier/claims/fold_jump.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "scenes/error.h"
#include "verifier/claims/flip.h"

namespace threefold {

namespace {

constexpr double search_rad = 1.2; ///< to both sides of the edge's own direction

struct AxisFrame {
    Vec3 forward, right, up;
    double distance_mm;
};

AxisFrame axis_frame(const FoldScene &scene) {
    const Vec3 to_centre = scene.orb.centre_mm - scene.eye_mm, forward = glm::normalize(to_centre);
    const Vec3 right = glm::normalize(Vec3(1, 0, 0) - forward.x * forward);
    return {forward, right, glm::cross(right, forward), glm::length(to_centre)};
}

/// Towards +z: to the eye.
Vec3 left_of(const FoldEdge &edge) { return glm::normalize(glm::cross(Vec3(0, 0, 1), edge.end_mm - edge.start_mm)); }

std::optional<Vec3> landing_through(const FoldScene &scene, const FoldEdge &edge, const Ray &ray, double impact_mm) {
    if (impact_mm >= scene.orb.optics.outer_mm) return optics::landing_on_plane(ray, edge.start_mm, Vec3(0, 0, 1));
    const std::optional<Ray> out = optics::transmitted_ray(scene.orb.optics, scene.orb.centre_mm, ray);
    if (!out) return std::nullopt;
    return optics::landing_on_plane(*out, edge.start_mm, Vec3(0, 0, 1));
}

} // namespace

FoldScene fold_scene_of(const Scene &scene) {
    for (const Object &object : scene.objects) {
        const Mesh *mesh = std::get_if<Mesh>(&object.shape);
        if (!mesh || object.name != "folds") continue;
        FoldScene found{orb_of(scene), scene.camera.eye_mm, {}};
        const std::vector<Vec3> &v = mesh->vertices_mm;
        for (std::size_t k = 0; k + 3 < v.size(); k += 4)
            found.folds.push_back({{v[k], v[k + 1]}, {v[k + 2], v[k + 3]}});
        return found;
    }
    throw Error(Exit::internal, "a claim asked for the folds of a scene that has none");
}

Ray ray_on_circle(const FoldScene &scene, double impact_mm, double azimuth_rad) {
    const AxisFrame axis = axis_frame(scene);
    const double sine = impact_mm / axis.distance_mm, cosine = std::sqrt((1 - sine) * (1 + sine));
    return {scene.eye_mm,
            cosine * axis.forward + sine * (std::cos(azimuth_rad) * axis.right + std::sin(azimuth_rad) * axis.up)};
}

Vec2 along_across(const FoldEdge &edge, Vec3 point_mm) {
    const Vec3 from = point_mm - edge.start_mm;
    return {glm::dot(from, glm::normalize(edge.end_mm - edge.start_mm)), glm::dot(from, left_of(edge))};
}

Vec2 straight_place(const FoldEdge &edge, const Ray &ray) {
    const auto landed = optics::landing_on_plane(ray, edge.start_mm, Vec3(0, 0, 1));
    return landed ? along_across(edge, *landed) : Vec2(std::numeric_limits<double>::quiet_NaN());
}

std::optional<double> edge_azimuth(const FoldScene &scene, const FoldEdge &edge, double impact_mm) {
    if (!(impact_mm < axis_frame(scene).distance_mm)) return std::nullopt;
    const AxisFrame axis = axis_frame(scene);
    const Vec3 along = edge.end_mm - edge.start_mm;
    const double direction = std::atan2(glm::dot(along, axis.up), glm::dot(along, axis.right));
    const auto across = [&](double azimuth) {
        const auto landed = landing_through(scene, edge, ray_on_circle(scene, impact_mm, azimuth), impact_mm);
        return landed ? along_across(edge, *landed).y : std::numeric_limits<double>::quiet_NaN();
    };
    const auto azimuth = root_between(across, direction - search_rad, direction + search_rad);
    if (!azimuth) return std::nullopt;
    const auto landed = landing_through(scene, edge, ray_on_circle(scene, impact_mm, *azimuth), impact_mm);
    if (!landed) return std::nullopt;
    const double x = along_across(edge, *landed).x;
    return x > 0 && x < glm::length(along) ? azimuth : std::nullopt;
}

std::optional<double> edge_jump(const FoldScene &scene, const FoldEdge &edge, const std::vector<double> &circles_mm) {
    double sum = 0;
    for (const double b : circles_mm) {
        const auto azimuth = edge_azimuth(scene, edge, b);
        if (!azimuth) return std::nullopt;
        sum += straight_place(edge, ray_on_circle(scene, b, *azimuth)).y;
    }
    return sum / static_cast<double>(circles_mm.size());
}

std::optional<double> fold_jump(const FoldScene &scene, const Fold &fold, const std::vector<double> &circles_mm) {
    const auto left = edge_jump(scene, fold.left, circles_mm), right = edge_jump(scene, fold.right, circles_mm);
    if (!left || !right) return std::nullopt;
    return (*left + *right) / 2;
}

} // namespace threefold
