// SPDX-License-Identifier: MIT
#include "verifier/claims/palm.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "scenes/error.h"
#include "verifier/optics/transmitted_ray.h"

namespace threefold {
namespace {

const Mesh &mesh_of(const Scene &scene, std::string_view name) {
    for (const Object &object : scene.objects)
        if (const Mesh *mesh = std::get_if<Mesh>(&object.shape); mesh && object.name == name) return *mesh;
    throw Error(Exit::internal, "a claim asked for a mesh of a scene that has none");
}

} // namespace

Palm::Palm(const Scene &scene)
    : orb_(orb_of(scene)), camera_(scene.camera), hand_(mesh_of(scene, "hand")), robe_(mesh_of(scene, "robe")) {}

bool Palm::is_palm(const Ray &ray) const {
    const double b = impact_parameter(ray, orb_.centre_mm), radius = orb_.optics.outer_mm;
    if (!(b < radius)) return false;
    const double entry =
        glm::dot(orb_.centre_mm - ray.origin_mm, ray.direction) - std::sqrt((radius - b) * (radius + b));
    const double hand = hand_.first_hit_mm(ray);
    return entry > 0 && hand > entry && hand < robe_.first_hit_mm(ray); // a finger before the orb is no palm
}

bool Palm::shows_hand(const OrbInScene &orb, const Ray &ray) const {
    const auto out = optics::transmitted_ray(orb.optics, orb.centre_mm, ray);
    return out && hand_.first_hit_mm(*out) < robe_.first_hit_mm(*out);
}

std::vector<Ray> Palm::rays(int side) const {
    std::vector<Ray> all;
    Camera camera = camera_;
    camera.crop.reset();
    camera.film_offset_px = Vec2(0);
    const auto crop = crop_around(orb_, camera);
    if (!crop) return all;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const Vec2 film(crop->x_px + (column + 0.5) / side * crop->width_px,
                            crop->y_px + (row + 0.5) / side * crop->height_px);
            if (const Ray ray = camera_ray(camera, film); is_palm(ray)) all.push_back(ray);
        }
    return all;
}

double Palm::share_in_place(const OrbInScene &orb, const std::vector<Ray> &rays) const {
    const auto shown = std::ranges::count_if(rays, [&](const Ray &ray) { return shows_hand(orb, ray); });
    return static_cast<double>(shown) / static_cast<double>(rays.size());
}

std::optional<Crop> crop_around(const OrbInScene &orb, const Camera &camera) {
    Camera whole = camera;
    whole.crop.reset();
    int left = whole.width_px, right = -1, top = whole.height_px, bottom = -1;
    for (int row = 0; row < whole.height_px; ++row)
        for (int column = 0; column < whole.width_px; ++column) {
            const Ray ray = camera_ray(whole, Vec2(column + 0.5, row + 0.5));
            if (!(impact_parameter(ray, orb.centre_mm) < orb.optics.outer_mm)) continue;
            left = std::min(left, column), right = std::max(right, column);
            top = std::min(top, row), bottom = std::max(bottom, row);
        }
    if (right < left) return std::nullopt;
    left = std::max(left - 1, 0), top = std::max(top - 1, 0);
    right = std::min(right + 1, whole.width_px - 1), bottom = std::min(bottom + 1, whole.height_px - 1);
    return Crop{left, top, right - left + 1, bottom - top + 1};
}

} // namespace threefold
