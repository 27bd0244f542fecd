// SPDX-License-Identifier: MIT
#include "exporter/blender/objects.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <span>

#include <fmt/format.h>

#include "exporter/blender/icosphere.h"
#include "exporter/image/image_io.h"

namespace threefold {

namespace {

using Json = nlohmann::ordered_json;

template <class Number>
void append(std::string &bytes, Number number) {
    static_assert(std::endian::native == std::endian::little, "the files are little-endian");
    bytes.append(reinterpret_cast<const char *>(&number), sizeof number);
}

std::string mesh_bytes(std::span<const Vec3> points, std::span<const glm::uvec3> triangles, std::span<const Vec2> uv) {
    std::string bytes;
    bytes.reserve(points.size_bytes() + triangles.size_bytes() + uv.size_bytes());
    for (const Vec3 &p : points)
        for (const double x : {p.x, p.y, p.z}) append(bytes, x);
    for (const glm::uvec3 &t : triangles)
        for (const std::uint32_t corner : {t.x, t.y, t.z}) append(bytes, corner);
    for (const Vec2 &t : uv)
        for (const double x : {t.x, t.y}) append(bytes, x);
    return bytes;
}

/// Objects as JSON; files are made on the way, each once.
class ObjectWriter {
public:
    ObjectWriter(const RenderJob &job, const ToBlender &to_blender, TextureEncoding encoding, CyclesObjects &made)
        : job_(job), to_blender_(to_blender), encoding_(encoding), made_(made) {}

    Json write(const Object &object) {
        return std::visit(
            overloaded{
                [&](const GlassBall &ball) { return glass(object.name, ball.centre_mm, {ball.radius_mm}, ball.glass); },
                [&](const GlassShell &shell) {
                    return glass(object.name, shell.centre_mm, {shell.outer_radius_mm, shell.inner_radius_mm()},
                                 shell.glass);
                },
                [&](const Quad &q) { return quad(object.name, q); },
                [&](const Mesh &m) { return mesh(object.name, m); },
            },
            object.shape);
    }

private:
    Json glass(const std::string &name, Vec3 centre_mm, const std::vector<double> &radii_mm, const Glass &glass) {
        // The outer surface is the largest, so its triangles stray farthest.
        const double radius_mm = radii_mm.front();
        const double tolerance_mm =
            job_.surface_tolerance_mm > 0 ? job_.surface_tolerance_mm : usual_surface_share * radius_mm;
        const auto fit = coarsest_icosphere(tolerance_mm / radius_mm);
        if (!fit)
            refuse_for_cycles(
                fmt::format("a sphere of radius {} mm cannot be meshed to {} mm: its finest mesh strays by {:.3g} mm",
                            radius_mm, tolerance_mm, fit_icosphere(finest_icosphere).distance * radius_mm),
                "allow a larger surface tolerance");
        made_.surface_mm = std::max(made_.surface_mm, fit->distance * radius_mm);
        Json radii = Json::array();
        for (const double r : radii_mm) radii.push_back(to_blender_.length(r));
        return {{"kind", "glass"},
                {"name", name},
                {"centre", to_json(to_blender_.point(centre_mm))},
                {"radii", radii},
                {"sphere", sphere(fit->level)},
                {"scale", fit->scale},
                {"index", glass.index},
                {"transmittance", glass.interface_transmittance},
                {"antireflective", glass.coating == Coating::antireflective},
                {"shadow", {{"rule", shadow_rule()}, {"transmittance", job_.scene.glass_shadow.transmittance}}}};
    }

    std::string shadow_rule() const {
        switch (job_.scene.glass_shadow.rule) {
        case GlassShadow::Rule::none:
            return "none";
        case GlassShadow::Rule::opaque:
            return "opaque";
        case GlassShadow::Rule::constant:
            return "constant";
        case GlassShadow::Rule::caustic:
            return "none"; // refused where it matters
        }
        return {};
    }

    Json sphere(int level) {
        if (const auto known = spheres_.find(level); known != spheres_.end()) return known->second;
        const Icosphere ico = make_icosphere(level);
        return spheres_[level] = mesh_file(fmt::format("icosphere_{}.bin", level), ico.vertices, ico.triangles, {});
    }

    Json mesh_file(const std::string &name, std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                   std::span<const Vec2> uv) {
        made_.files.push_back({name, mesh_bytes(points, triangles, uv)});
        return {{"file", name}, {"vertices", points.size()}, {"triangles", triangles.size()}, {"uv", !uv.empty()}};
    }

    Json quad(const std::string &name, const Quad &quad) {
        Json corners = Json::array();
        for (const Vec2 &c : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)})
            corners.push_back(to_json(to_blender_.point(quad.centre_mm + c.x * quad.half_u_mm + c.y * quad.half_v_mm)));
        return {{"kind", "quad"}, {"name", name}, {"corners", corners}, {"surface", surface(name, quad.surface, true)}};
    }

    Json mesh(const std::string &name, const Mesh &mesh) {
        std::vector<Vec3> points;
        for (const Vec3 &v : mesh.vertices_mm) points.push_back(to_blender_.point(v));
        Json what = surface(name, mesh.surface, !mesh.uv.empty());
        return {{"kind", "mesh"},
                {"name", name},
                {"mesh", mesh_file(fmt::format("mesh_{}.bin", ++meshes_), points, mesh.triangles, mesh.uv)},
                {"surface", what}};
    }

    Json surface(const std::string &name, const Surface &surface, bool has_uv) {
        return std::visit(
            overloaded{
                [&](const Diffuse &diffuse) -> Json {
                    return {{"kind", "diffuse"}, {"reflectance", paint(name, diffuse.reflectance, has_uv)}};
                },
                [&](const Emissive &emissive) { return emission(name, emissive.radiance, has_uv); },
                [&](const CoordinateCard &) -> Json {
                    if (!has_uv) refuse_without_uv(name);
                    return {{"kind", "coordinates"}};
                },
            },
            surface);
    }

    /// Colours of Blender are meant for 0 to 1; what is brighter goes into the strength.
    Json emission(const std::string &name, const Paint &radiance, bool has_uv) {
        double strength = 1;
        Paint scaled = radiance;
        if (Rgb *colour = std::get_if<Rgb>(&scaled)) {
            strength = std::max({1.0, colour->r, colour->g, colour->b});
            *colour /= strength;
        }
        return {{"kind", "emissive"}, {"radiance", paint(name, scaled, has_uv)}, {"strength", strength}};
    }

    Json paint(const std::string &name, const Paint &paint, bool has_uv) {
        return std::visit(overloaded{
                              [](const Rgb &colour) { return to_json(colour); },
                              [&](const std::shared_ptr<const Texture> &texture) -> Json {
                                  if (!has_uv) refuse_without_uv(name);
                                  return texture_file(texture);
                              },
                          },
                          paint);
    }

    [[noreturn]] static void refuse_without_uv(const std::string &name) {
        refuse_for_cycles(fmt::format("the surface of the mesh {} needs texture coordinates, and the mesh has none",
                                      Json(name).dump(-1, ' ', true, Json::error_handler_t::replace)));
    }

    Json texture_file(const std::shared_ptr<const Texture> &texture) {
        auto &name = textures_[texture.get()];
        if (name.empty()) {
            name = fmt::format("texture_{}.png", textures_.size());
            made_.files.push_back({name, encode(*texture)});
        }
        return name;
    }

    std::string encode(const Texture &texture) const {
        switch (encoding_) {
        case TextureEncoding::linear16:
            return encode_png16(texture, 0);
        case TextureEncoding::srgb8:
            return encode_png_srgb(texture);
        }
        return {};
    }

    const RenderJob &job_;
    const ToBlender &to_blender_;
    TextureEncoding encoding_;
    CyclesObjects &made_;
    std::map<int, Json> spheres_;
    std::map<const Texture *, std::string> textures_;
    int meshes_ = 0;
};

} // namespace

CyclesObjects describe_objects(const RenderJob &job, const ToBlender &to_blender, TextureEncoding encoding) {
    CyclesObjects made;
    ObjectWriter writer(job, to_blender, encoding, made);
    for (const Object &object : job.scene.objects) made.list.push_back(writer.write(object));
    return made;
}

} // namespace threefold
