// SPDX-License-Identifier: MIT
#include "verifier/claims/prediction.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "scenes/error.h"
#include "scenes/texture.h"
#include "verifier/measure/optical_map.h"

namespace threefold {

OrbInScene orb_of(const Scene &scene) {
    using Result = std::optional<OrbInScene>;
    for (const Object &object : scene.objects) {
        const Result orb = std::visit(
            overloaded{
                [](const GlassBall &b) {
                    return Result({b.centre_mm, optics::solid_ball(b.radius_mm, b.glass.index), b.glass});
                },
                [](const GlassShell &s) {
                    return Result({s.centre_mm, optics::shell(s.outer_radius_mm, s.wall_mm, s.glass.index), s.glass});
                },
                [](const Quad &) { return Result(); },
                [](const Mesh &) { return Result(); },
            },
            object.shape);
        if (orb) return *orb;
    }
    throw Error(Exit::internal, "a claim asked for the orb of a scene that has none");
}

const Quad &card_of(const Scene &scene) {
    for (const Object &object : scene.objects)
        if (const Quad *quad = std::get_if<Quad>(&object.shape)) return *quad;
    throw Error(Exit::internal, "a claim asked for the card of a scene that has none");
}

double impact_parameter(const Ray &ray, Vec3 centre_mm) {
    return glm::length(glm::cross(centre_mm - ray.origin_mm, ray.direction));
}

std::optional<Vec3> predicted_landing(const OrbInScene &orb, const Quad &card, const Ray &ray) {
    const auto out = optics::transmitted_ray(orb.optics, orb.centre_mm, ray);
    if (!out) return std::nullopt;
    return optics::landing_on_plane(*out, card.centre_mm, glm::cross(card.half_u_mm, card.half_v_mm));
}

bool on_card(const Quad &card, Vec3 point_mm, double margin_mm) {
    const Vec2 uv = coordinates_on(card, point_mm);
    const Vec2 margin(margin_mm / (2 * glm::length(card.half_u_mm)), margin_mm / (2 * glm::length(card.half_v_mm)));
    return uv.x > margin.x && uv.x < 1 - margin.x && uv.y > margin.y && uv.y < 1 - margin.y;
}

namespace {

double card_radiance(const Quad &card, Vec3 point_mm, double elsewhere) {
    if (!on_card(card, point_mm)) return elsewhere;
    const Vec2 uv = coordinates_on(card, point_mm);
    return std::visit(overloaded{
                          [](const Diffuse &) { return 0.0; },
                          [uv](const Emissive &e) { return grey(sample(e.radiance, uv)); },
                          [uv](const CoordinateCard &) { return (uv.x + uv.y + 1) / 3; },
                      },
                      card.surface);
}

} // namespace

Scene coarse(Scene scene) {
    constexpr int most_px = 128;
    Camera &camera = scene.camera;
    const int longest = std::max(camera.width_px, camera.height_px);
    if (camera.crop || longest <= most_px) return scene;
    const double factor = static_cast<double>(most_px) / longest;
    camera.width_px = std::max(1, static_cast<int>(camera.width_px * factor));
    camera.height_px = std::max(1, static_cast<int>(camera.height_px * factor));
    return scene;
}

double predicted_mean_radiance(const Scene &full) {
    const Scene scene = coarse(full);
    const OrbInScene orb = orb_of(scene);
    const Quad &card = card_of(scene);
    const Vec3 normal = glm::cross(card.half_u_mm, card.half_v_mm);
    const double surroundings = scene.environment ? grey(scene.environment->radiance) : 0;
    double sum = 0;
    for (int row = 0; row < scene.camera.image_height_px(); ++row)
        for (int column = 0; column < scene.camera.image_width_px(); ++column) {
            const Ray ray = camera_ray(scene.camera, pixel_sample(scene.camera, column, row));
            const double b = impact_parameter(ray, orb.centre_mm);
            if (b >= orb.optics.outer_mm) {
                const auto landing = optics::landing_on_plane(ray, card.centre_mm, normal);
                sum += landing ? card_radiance(card, *landing, surroundings) : surroundings;
                continue;
            }
            const auto landing = predicted_landing(orb, card, ray);
            const auto impact = optics::impact_at(orb.optics, b);
            const double through = landing ? optics::path_transmittance(orb.optics, impact)->unpolarised : 0;
            sum += surroundings * (1 - through);
            if (landing) sum += through * card_radiance(card, *landing, surroundings);
        }
    return sum / (static_cast<double>(scene.camera.image_width_px()) * scene.camera.image_height_px());
}

double landing_leverage(const Scene &full, double clear_share, double q) {
    const Scene scene = coarse(full);
    const OrbInScene orb = orb_of(scene);
    const Quad &card = card_of(scene);
    const double clear = clear_share * orb.clear_radius_mm(), step = 1e-5 * orb.optics.outer_mm;
    std::vector<double> leverage;
    for (int row = 0; row < scene.camera.image_height_px(); ++row)
        for (int column = 0; column < scene.camera.image_width_px(); ++column) {
            const Ray ray = camera_ray(scene.camera, pixel_sample(scene.camera, column, row));
            const double b = impact_parameter(ray, orb.centre_mm);
            if (!(b < clear) || b < step) continue;
            const Vec3 foot = ray.origin_mm + glm::dot(orb.centre_mm - ray.origin_mm, ray.direction) * ray.direction;
            const Ray moved{ray.origin_mm - glm::normalize(foot - orb.centre_mm) * step, ray.direction};
            const auto here = predicted_landing(orb, card, ray), there = predicted_landing(orb, card, moved);
            if (here && there && on_card(card, *here)) leverage.push_back(glm::length(*here - *there) / step);
        }
    return leverage.empty() ? 1 : std::max(1.0, quantile(std::move(leverage), q));
}

double mean_missing_weight(const OrbInScene &orb, double from_mm, double to_mm, double cut_weight) {
    if (!(cut_weight > 0)) return 0;
    constexpr int points = 24;
    double sum = 0, weights = 0;
    for (int k = 0; k < points; ++k) {
        const double b = from_mm + (to_mm - from_mm) * (k + 0.5) / points;
        sum += b * optics::missing_weight(orb.optics, optics::impact_at(orb.optics, b), cut_weight);
        weights += b;
    }
    return sum / weights;
}

} // namespace threefold
