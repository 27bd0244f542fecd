// SPDX-License-Identifier: MIT
#include "scenes/validate.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scenes/access.h"
#include "scenes/camera.h"
#include "scenes/coincident.h"
#include "scenes/error.h"
#include "scenes/light.h"
#include "scenes/texture.h"

namespace threefold {

namespace {

/// Images are double RGB; a picture exists as replicate, mean, reference and difference at the same time.
constexpr double bytes_per_pixel = 4 * 3 * sizeof(double);

/// Squares of longer distances leave single precision, in which other programs compute.
constexpr double farthest_vertex_mm = 1e9;

[[noreturn]] void refuse(const std::string &what) { throw Error(Exit::bad_data, what); }

bool finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void require_finite(Vec3 v, std::string_view what) {
    if (!finite(v)) refuse(fmt::format("{} must be finite, not ({}, {}, {})", what, v.x, v.y, v.z));
}

void require_positive(double value, std::string_view what) {
    if (!(value > 0) || !std::isfinite(value)) refuse(fmt::format("{} must be a positive number, not {}", what, value));
}

void require_colour(Rgb colour, std::string_view what) {
    require_finite(colour, what);
    if (std::min({colour.r, colour.g, colour.b}) < 0) refuse(fmt::format("{} must not be negative", what));
}

void validate(const Glass &glass) {
    if (!(glass.index >= 1) || !std::isfinite(glass.index))
        refuse(fmt::format("the index of a glass in air must be at least 1, not {}", glass.index));
    if (!(glass.interface_transmittance >= 0 && glass.interface_transmittance <= 1))
        refuse(fmt::format("the interface transmittance must lie in [0, 1], not {}", glass.interface_transmittance));
}

void validate(const Paint &paint, std::string_view what) {
    std::visit(overloaded{
                   [&](const Rgb &colour) { require_colour(colour, what); },
                   [&](const std::shared_ptr<const Texture> &texture) {
                       if (!texture || texture->width <= 0 || texture->height <= 0 ||
                           texture->rgb.size() !=
                               static_cast<std::size_t>(texture->width) * static_cast<std::size_t>(texture->height) * 3)
                           refuse(fmt::format("{}: the image is empty or of the wrong size", what));
                   },
               },
               paint);
}

void validate(const Surface &surface) {
    std::visit(overloaded{
                   [](const Diffuse &diffuse) { validate(diffuse.reflectance, "a reflectance"); },
                   [](const Emissive &emissive) { validate(emissive.radiance, "a radiance"); },
                   [](const CoordinateCard &) {},
               },
               surface);
}

bool needs_uv(const Surface &surface) {
    const auto is_image = [](const Paint &paint) {
        return std::holds_alternative<std::shared_ptr<const Texture>>(paint);
    };
    return std::visit(overloaded{
                          [&](const Diffuse &diffuse) { return is_image(diffuse.reflectance); },
                          [&](const Emissive &emissive) { return is_image(emissive.radiance); },
                          [](const CoordinateCard &) { return true; },
                      },
                      surface);
}

void validate(const Mesh &mesh) {
    if (mesh.vertices_mm.empty() || mesh.triangles.empty()) refuse("a mesh is empty");
    for (const Vec3 &v : mesh.vertices_mm) {
        require_finite(v, "a mesh's vertex");
        if (std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) > farthest_vertex_mm)
            refuse(fmt::format("a mesh's vertex ({:g}, {:g}, {:g}) lies farther away than {:g} mm: is its unit right?",
                               v.x, v.y, v.z, farthest_vertex_mm));
    }
    for (const glm::uvec3 &t : mesh.triangles)
        if (std::max({t.x, t.y, t.z}) >= mesh.vertices_mm.size())
            refuse("a mesh's triangle names a vertex that is not there");
    if (!mesh.uv.empty() && mesh.uv.size() != mesh.vertices_mm.size())
        refuse("a mesh must have no texture coordinates, or one a vertex");
    if (mesh.uv.empty() && needs_uv(mesh.surface))
        refuse("a mesh has no texture coordinates, and its surface needs them: it shows an image or coordinates");
    for (const Vec2 &uv : mesh.uv)
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
            refuse(fmt::format("a mesh's texture coordinates must be finite, not ({}, {})", uv.x, uv.y));
    validate(mesh.surface);
}

void validate(const Shape &shape) {
    std::visit(overloaded{
                   [](const GlassBall &ball) {
                       require_finite(ball.centre_mm, "the orb's centre");
                       require_positive(ball.radius_mm, "the orb's radius (mm)");
                       validate(ball.glass);
                   },
                   [](const GlassShell &shell) {
                       require_finite(shell.centre_mm, "the orb's centre");
                       require_positive(shell.outer_radius_mm, "the orb's radius (mm)");
                       require_positive(shell.wall_mm, "the orb's wall (mm)");
                       if (shell.wall_mm >= shell.outer_radius_mm)
                           refuse(fmt::format("the wall ({} mm) must be thinner than the orb's radius ({} mm); a solid "
                                              "orb is a ball",
                                              shell.wall_mm, shell.outer_radius_mm));
                       if (!(shell.inner_radius_mm() < shell.outer_radius_mm))
                           refuse(fmt::format("a wall of {} mm vanishes beside a radius of {} mm in double precision",
                                              shell.wall_mm, shell.outer_radius_mm));
                       validate(shell.glass);
                   },
                   [](const Quad &quad) {
                       require_finite(quad.centre_mm, "a rectangle's centre");
                       require_finite(quad.half_u_mm, "a rectangle's half side");
                       require_finite(quad.half_v_mm, "a rectangle's half side");
                       const double u = glm::length(quad.half_u_mm), v = glm::length(quad.half_v_mm);
                       require_positive(u, "a rectangle's half width (mm)");
                       require_positive(v, "a rectangle's half height (mm)");
                       if (std::abs(glm::dot(quad.half_u_mm, quad.half_v_mm)) > 1e-9 * u * v)
                           refuse("a rectangle's sides must be perpendicular");
                       validate(quad.surface);
                   },
                   [](const Mesh &mesh) { validate(mesh); },
               },
               shape);
}

/// Distance from a point to the rectangle.
double distance(const Quad &quad, Vec3 point) {
    const Vec3 d = point - quad.centre_mm;
    const double u = std::clamp(glm::dot(d, quad.half_u_mm) / glm::dot(quad.half_u_mm, quad.half_u_mm), -1.0, 1.0);
    const double v = std::clamp(glm::dot(d, quad.half_v_mm) / glm::dot(quad.half_v_mm, quad.half_v_mm), -1.0, 1.0);
    return glm::length(d - u * quad.half_u_mm - v * quad.half_v_mm);
}

/// Where the rays of an orthographic camera begin.
Quad film_of(const Camera &camera) {
    const Film film(camera);
    const Vec2 half_px = Vec2(camera.image_width_px(), camera.image_height_px()) / 2.0;
    const Vec3 half_u_mm = half_px.x * film.pixel() * film.frame().right,
               half_v_mm = half_px.y * film.pixel() * film.frame().up;
    return {film.ray(half_px).origin_mm, half_u_mm, half_v_mm, {}};
}

/// Glass must stand free: a ray inside it meets nothing but its own surfaces. Touching is allowed.
void require_glass_apart(const Scene &scene) {
    constexpr double touching = 1 - 1e-9;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const auto orb = outer_sphere(scene.objects[i].shape);
        if (!orb) continue;
        if (glm::length(scene.camera.eye_mm - orb->centre_mm) <= orb->radius_mm)
            refuse("the eye lies inside the glass orb or on it: it must stand outside");
        if (scene.camera.projection == Projection::orthographic &&
            distance(film_of(scene.camera), orb->centre_mm) <= orb->radius_mm)
            refuse("the orthographic camera's film cuts the glass orb: its rays must begin outside");
        for (std::size_t j = 0; j < scene.objects.size(); ++j) {
            if (const auto other = outer_sphere(scene.objects[j].shape);
                other && j > i &&
                glm::length(other->centre_mm - orb->centre_mm) < (other->radius_mm + orb->radius_mm) * touching)
                refuse("two glass orbs overlap: they may touch, not more");
            if (const Quad *quad = std::get_if<Quad>(&scene.objects[j].shape);
                quad && distance(*quad, orb->centre_mm) < orb->radius_mm * touching)
                refuse("a rectangle cuts the glass orb: it may touch it, not more");
        }
    }
}

void require_rectangles_apart(const Scene &scene) {
    std::vector<std::pair<const Object *, const Quad *>> quads;
    for (const Object &object : scene.objects)
        if (const Quad *quad = std::get_if<Quad>(&object.shape)) quads.emplace_back(&object, quad);
    for (std::size_t i = 0; i < quads.size(); ++i)
        for (std::size_t j = i + 1; j < quads.size(); ++j)
            if (coincide(*quads[i].second, *quads[j].second))
                throw Error(Exit::bad_data,
                            fmt::format("{} and {} lie in one plane and overlap: which of them is seen, rounding would "
                                        "decide",
                                        quads[i].first->name, quads[j].first->name),
                            "move one of them, or cut the other so that they share an edge at most");
}

void validate(const Camera &camera) {
    require_finite(camera.eye_mm, "the eye");
    require_finite(camera.target_mm, "the camera's target");
    require_finite(camera.up, "the camera's up");
    if (camera.width_px <= 0 || camera.height_px <= 0)
        refuse(fmt::format("the picture has no size: {} x {} px", camera.width_px, camera.height_px));
    if (camera.crop) {
        const Crop &c = *camera.crop;
        if (c.width_px <= 0 || c.height_px <= 0 || c.x_px < 0 || c.y_px < 0 || c.x_px > camera.width_px - c.width_px ||
            c.y_px > camera.height_px - c.height_px)
            refuse(fmt::format("the crop {}x{}+{}+{} does not lie inside the film of {} x {} px", c.width_px,
                               c.height_px, c.x_px, c.y_px, camera.width_px, camera.height_px));
    }
    const Vec3 view = camera.target_mm - camera.eye_mm;
    if (!(glm::length(view) > 0)) refuse("the eye and the camera's target coincide");
    if (!(glm::length(glm::cross(glm::normalize(view), camera.up)) > 1e-9 * glm::length(camera.up)))
        refuse("the camera's up points along its view");
    if (camera.projection == Projection::perspective &&
        !(camera.horizontal_fov_deg > 0 && camera.horizontal_fov_deg < 180))
        refuse(fmt::format("the field of view must lie between 0 and 180 degrees, not {}", camera.horizontal_fov_deg));
    if (camera.projection == Projection::orthographic)
        require_positive(camera.orthographic_width_mm, "the orthographic width (mm)");

    const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
    const double wanted = picture_memory_bytes(camera);
    if (wanted > memory / 2)
        refuse(fmt::format("a picture of {} x {} px needs about {:.3g} GB, more than half of this machine's {:.3g} GB; "
                           "make it smaller or render crops",
                           camera.image_width_px(), camera.image_height_px(), wanted / 1e9, memory / 1e9));
}

double greatest(const Rgb &c) { return std::max({c.r, c.g, c.b}); }

/// Upper bounds: of the environment, and of each surface.
std::vector<double> shining_radiances(const Scene &scene) {
    Rgb irradiance(0);
    for (const Directional &light : lights_on_diffuse(scene)) irradiance += light.irradiance;
    const auto of_surface = overloaded{
        [&](const Diffuse &d) { return greatest(greatest_value(d.reflectance) * irradiance) / std::numbers::pi; },
        [](const Emissive &e) { return greatest(greatest_value(e.radiance)); },
        [](const CoordinateCard &) { return 1.0; },
    };
    std::vector<double> all{scene.environment ? greatest(scene.environment->radiance) : 0};
    for (const Object &object : scene.objects)
        if (const Surface *surface = surface_of(object.shape)) all.push_back(std::visit(of_surface, *surface));
    return all;
}

} // namespace

double picture_memory_bytes(const Camera &camera) {
    return static_cast<double>(camera.image_width_px()) * camera.image_height_px() * bytes_per_pixel;
}

Needs needs(const Scene &scene) {
    Needs n;
    bool diffuse = false;
    for (const Object &object : scene.objects) {
        if (const Glass *glass = glass_of(object.shape)) {
            n.glass = true;
            n.ray_tree |= glass->coating == Coating::fresnel;
        }
        const Surface *surface = surface_of(object.shape);
        const Diffuse *d = surface ? std::get_if<Diffuse>(surface) : nullptr;
        diffuse |= d && greatest_value(d->reflectance) != Rgb(0); // what is black needs no light
    }
    if (scene.environment) {
        const Environment &e = *scene.environment;
        n.environment_on_diffuse = diffuse && e.radiance != Rgb(0) && e.dome_directions == 0;
    }
    const std::size_t lights = diffuse ? lights_on_diffuse(scene).size() : 0;
    n.direct_light = lights > 0;
    n.many_lights = lights > 1;
    n.glass_shadow = n.glass && n.direct_light && scene.glass_shadow.rule != GlassShadow::Rule::none;
    n.caustics = n.glass_shadow && scene.glass_shadow.rule == GlassShadow::Rule::caustic;
    return n;
}

double greatest_radiance(const Scene &scene) { return std::ranges::max(shining_radiances(scene)); }

double least_shining_radiance(const Scene &scene) {
    double least = 0;
    for (const double radiance : shining_radiances(scene))
        if (radiance > 0) least = least > 0 ? std::min(least, radiance) : radiance;
    return least;
}

void validate(const Scene &scene) {
    for (const Object &object : scene.objects) {
        try {
            validate(object.shape);
        } catch (const Error &error) {
            throw Error(error.code(), fmt::format("{}: {}", object.name, error.what()), error.hint());
        }
    }
    for (const Directional &light : scene.lights) {
        require_finite(light.travel, "a light's direction");
        require_positive(glm::length(light.travel), "the length of a light's direction");
        require_colour(light.irradiance, "a light's irradiance");
    }
    if (scene.environment) {
        require_colour(scene.environment->radiance, "the environment's radiance");
        constexpr int most_directions = 10'000;
        if (const int n = scene.environment->dome_directions; n < 0 || n > most_directions)
            refuse(fmt::format("the environment's dome may have up to {} directions, not {}", most_directions, n));
    }
    if (!(scene.glass_shadow.transmittance >= 0 && scene.glass_shadow.transmittance <= 1))
        refuse(fmt::format("the glass shadow's transmittance must lie in [0, 1], not {}",
                           scene.glass_shadow.transmittance));
    validate(scene.camera);
    require_glass_apart(scene);
    require_rectangles_apart(scene);
    if (!(greatest_radiance(scene) > 0))
        refuse("the scene is dark: nothing in it gives light (no light, no emitter, no environment)");
}

} // namespace threefold
