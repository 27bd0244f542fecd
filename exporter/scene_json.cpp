// SPDX-License-Identifier: MIT
#include "exporter/scene_json.h"

#include <nlohmann/json.hpp>

#include "exporter/files.h"

namespace threefold {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(Vec3 v) { return {v.x, v.y, v.z}; }
Json to_json(Vec2 v) { return {v.x, v.y}; }

Json to_json(const Glass &glass) {
    return {{"index", glass.index},
            {"interface_transmittance", glass.interface_transmittance},
            {"coating", glass.coating == Coating::fresnel ? "fresnel" : "antireflective"}};
}

Json to_json(const Paint &paint) {
    return std::visit(overloaded{
                          [](const Rgb &colour) { return to_json(colour); },
                          [](const std::shared_ptr<const Texture> &t) {
                              const std::string_view bytes(reinterpret_cast<const char *>(t->rgb.data()),
                                                           t->rgb.size() * sizeof(t->rgb[0]));
                              return Json{{"width", t->width}, {"height", t->height}, {"hash", content_hash(bytes)}};
                          },
                      },
                      paint);
}

Json to_json(const Surface &surface) {
    return std::visit(overloaded{
                          [](const Diffuse &d) {
                              return Json{{"diffuse", to_json(d.reflectance)}};
                          },
                          [](const Emissive &e) {
                              return Json{{"emissive", to_json(e.radiance)}};
                          },
                          [](const CoordinateCard &) { return Json("coordinate card"); },
                      },
                      surface);
}

Json to_json(const Mesh &mesh) {
    // Bytes, not JSON: a mesh may have millions of triangles. The lists cannot run into one another, their sizes stand
    // beside the hash.
    std::string bytes;
    const auto add = [&bytes](const void *first, std::size_t size) {
        bytes.append(static_cast<const char *>(first), size);
    };
    add(mesh.vertices_mm.data(), mesh.vertices_mm.size() * sizeof(Vec3));
    add(mesh.triangles.data(), mesh.triangles.size() * sizeof(glm::uvec3));
    add(mesh.uv.data(), mesh.uv.size() * sizeof(Vec2));
    return {{"vertices", mesh.vertices_mm.size()},
            {"triangles", mesh.triangles.size()},
            {"hash", content_hash(bytes)},
            {"surface", to_json(mesh.surface)}};
}

Json to_json(const Shape &shape) {
    return std::visit(
        overloaded{
            [](const GlassBall &b) {
                return Json{
                    {"ball",
                     {{"centre_mm", to_json(b.centre_mm)}, {"radius_mm", b.radius_mm}, {"glass", to_json(b.glass)}}}};
            },
            [](const GlassShell &s) {
                return Json{{"shell",
                             {{"centre_mm", to_json(s.centre_mm)},
                              {"outer_radius_mm", s.outer_radius_mm},
                              {"wall_mm", s.wall_mm},
                              {"glass", to_json(s.glass)}}}};
            },
            [](const Quad &q) {
                return Json{{"rectangle",
                             {{"centre_mm", to_json(q.centre_mm)},
                              {"half_u_mm", to_json(q.half_u_mm)},
                              {"half_v_mm", to_json(q.half_v_mm)},
                              {"surface", to_json(q.surface)}}}};
            },
            [](const Mesh &m) {
                return Json{{"mesh", to_json(m)}};
            },
        },
        shape);
}

Json to_json(const GlassShadow &shadow) {
    switch (shadow.rule) {
    case GlassShadow::Rule::none:
        return "none";
    case GlassShadow::Rule::opaque:
        return "opaque";
    case GlassShadow::Rule::constant:
        return {{"constant", shadow.transmittance}};
    case GlassShadow::Rule::caustic:
        return "caustic";
    }
    return nullptr;
}

Json to_json(const Camera &camera) {
    Json json{{"eye_mm", to_json(camera.eye_mm)}, {"target_mm", to_json(camera.target_mm)}, {"up", to_json(camera.up)}};
    switch (camera.projection) {
    case Projection::perspective:
        json["horizontal_fov_deg"] = camera.horizontal_fov_deg;
        break;
    case Projection::orthographic:
        json["orthographic_width_mm"] = camera.orthographic_width_mm;
        break;
    }
    json["width_px"] = camera.width_px;
    json["height_px"] = camera.height_px;
    if (camera.crop)
        json["crop_px"] = {camera.crop->x_px, camera.crop->y_px, camera.crop->width_px, camera.crop->height_px};
    json["film_offset_px"] = to_json(camera.film_offset_px);
    return json;
}

} // namespace

Json to_json(const Scene &scene) {
    Json json{{"name", scene.name}};
    json["objects"] = Json::array();
    for (const Object &object : scene.objects)
        json["objects"].push_back({{"name", object.name}, {"shape", to_json(object.shape)}});
    json["lights"] = Json::array();
    for (const Directional &light : scene.lights)
        json["lights"].push_back({{"travel", to_json(light.travel)}, {"irradiance", to_json(light.irradiance)}});
    json["environment"] = scene.environment ? to_json(scene.environment->radiance) : Json(nullptr);
    if (scene.environment && scene.environment->dome_directions > 0)
        json["dome_directions"] = scene.environment->dome_directions;
    json["glass_shadow"] = to_json(scene.glass_shadow);
    json["camera"] = to_json(scene.camera);
    return json;
}

std::string scene_hash(const Scene &scene) {
    return content_hash(to_json(scene).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
}

} // namespace threefold
