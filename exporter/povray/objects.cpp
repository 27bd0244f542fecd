// SPDX-License-Identifier: MIT
// Objects. A name stands in a comment only, escaped: a user's text is never code.
#include "exporter/povray/writer.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace threefold::povray {

// A polygon, since POV-Ray computes it in double precision; a mesh would be in single. Defined over the unit square, so
// that the place on it is the pigment's (u, v).
void write_quad(Writer &writer, const Quad &quad) {
    const Vec3 side_u = 2.0 * quad.half_u_mm, side_v = 2.0 * quad.half_v_mm;
    const Vec3 corner = writer.space.point(quad.centre_mm - quad.half_u_mm - quad.half_v_mm);
    const Vec3 u = side_u * writer.space.units_per_mm, v = side_v * writer.space.units_per_mm;
    const Vec3 normal = glm::normalize(glm::cross(u, v)) * glm::length(u);
    writer.text += "polygon {\n  5, <0,0>, <1,0>, <1,1>, <0,1>, <0,0>\n";
    writer.text += surface_texture(writer, quad.surface, false);
    const auto row = [](const Vec3 &r) { return fmt::format("{},{},{}", number(r.x), number(r.y), number(r.z)); };
    writer.text += fmt::format("  matrix <{}, {}, {}, {}>\n}}\n", row(u), row(v), row(normal), row(corner));
}

// POV-Ray keeps a mesh's vertices, normals and distances in single precision: they are written about the mesh's own
// middle and moved from there in double precision.
void write_mesh(Writer &writer, const Mesh &mesh) {
    const bool by_uv = needs_uv(mesh.surface);
    if (by_uv && mesh.uv.size() != mesh.vertices_mm.size())
        refuse("a mesh with a texture or coordinates has no uv for each vertex");
    if (mesh.vertices_mm.empty() || mesh.triangles.empty()) return;

    Vec3 low = mesh.vertices_mm.front(), high = low;
    for (const Vec3 &vertex : mesh.vertices_mm) low = glm::min(low, vertex), high = glm::max(high, vertex);
    const Vec3 middle_mm = 0.5 * (low + high);
    writer.mesh_rounding_mm =
        std::max(writer.mesh_rounding_mm, 0.5 * glm::length(high - low) * 4 * std::numeric_limits<float>::epsilon());

    std::string &text = writer.text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "mesh2 {{\n  vertex_vectors {{ {}", mesh.vertices_mm.size());
    for (const Vec3 &vertex : mesh.vertices_mm)
        fmt::format_to(out, ",\n    {}", vector((vertex - middle_mm) * writer.space.units_per_mm));
    if (by_uv) {
        fmt::format_to(out, "\n  }}\n  uv_vectors {{ {}", mesh.uv.size());
        for (const Vec2 &uv : mesh.uv) {
            // Outside, a texture is clamped by definition but repeated by POV-Ray.
            if (!(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1))
                refuse(fmt::format("a mesh has uv ({}, {}), outside 0 to 1", uv.x, uv.y),
                       "unwrap it into the unit square");
            fmt::format_to(out, ",\n    <{},{}>", number(uv.x), number(uv.y));
        }
    }
    fmt::format_to(out, "\n  }}\n  face_indices {{ {}", mesh.triangles.size());
    for (const glm::uvec3 &t : mesh.triangles) fmt::format_to(out, ",\n    <{},{},{}>", t.x, t.y, t.z);
    text += "\n  }\n";
    text += fmt::format("  translate {}\n", vector(writer.space.point(middle_mm)));
    text += surface_texture(writer, mesh.surface, by_uv);
    text += "}\n";
}

void write_object(Writer &writer, const Object &object) {
    writer.text += fmt::format("// {}\n", in_quotes(object.name));
    std::visit(overloaded{[&](const GlassBall &ball) { write_ball(writer, ball); },
                          [&](const GlassShell &shell) { write_shell(writer, shell); },
                          [&](const Quad &quad) { write_quad(writer, quad); },
                          [&](const Mesh &mesh) { write_mesh(writer, mesh); }},
               object.shape);
}

} // namespace threefold::povray
