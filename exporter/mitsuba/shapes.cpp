// SPDX-License-Identifier: MIT
// Spheres, rectangles and meshes, and how they are put together once eye and glass are known.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "exporter/mitsuba/reader.h"
#include "exporter/text.h"
#include "scenes/access.h"
#include "scenes/error.h"
#include "scenes/texture.h"

namespace threefold::mitsuba {

namespace {

constexpr double equal_enough = 1e-9;

bool close(double a, double b) { return std::abs(a - b) <= equal_enough * std::max(std::abs(a), std::abs(b)); }

Vec3 column(const glm::dmat4 &m, int i) { return Vec3(m[i]); }

bool is_black(const Surface &surface) {
    if (const auto *d = std::get_if<Diffuse>(&surface)) return greatest_value(d->reflectance) == Rgb(0);
    if (const auto *e = std::get_if<Emissive>(&surface)) return greatest_value(e->radiance) == Rgb(0);
    return false;
}

Vec3 normal_of(const Mesh &mesh, const glm::uvec3 &t) {
    const Vec3 a = mesh.vertices_mm[t.x];
    return glm::cross(mesh.vertices_mm[t.y] - a, mesh.vertices_mm[t.z] - a);
}

const std::shared_ptr<const Texture> *texture_of(const Surface &surface) {
    const Paint *paint = nullptr;
    if (const auto *d = std::get_if<Diffuse>(&surface)) paint = &d->reflectance;
    if (const auto *e = std::get_if<Emissive>(&surface)) paint = &e->radiance;
    return paint ? std::get_if<std::shared_ptr<const Texture>>(paint) : nullptr;
}

/// Repeated or ended at its edges, it is the same.
bool edges_meet(const Texture &t) {
    const auto at = [&](int x, int y) { return t.rgb.begin() + 3 * (std::ptrdiff_t{y} * t.width + x); };
    const auto same = [&](int x, int y, int u, int v) { return std::equal(at(x, y), at(x, y) + 3, at(u, v)); };
    for (int y = 0; y < t.height; ++y)
        if (!same(0, y, t.width - 1, y)) return false;
    for (int x = 0; x < t.width; ++x)
        if (!same(x, 0, x, t.height - 1)) return false;
    return true;
}

/// In one plane: then normals of vertices are those of the triangles.
bool is_flat(const Mesh &mesh) {
    Vec3 first(0);
    for (const glm::uvec3 &t : mesh.triangles) {
        const Vec3 n = normal_of(mesh, t);
        if (!(glm::length(n) > 0)) continue;
        if (first == Vec3(0)) first = glm::normalize(n);
        if (glm::dot(first, glm::normalize(n)) < 1 - equal_enough) return false;
    }
    return true;
}

/// Without a border, its front outside: nobody outside sees its back.
bool is_closed(const Mesh &mesh) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    double volume = 0;
    const Vec3 origin = mesh.vertices_mm.empty() ? Vec3(0) : mesh.vertices_mm.front();
    for (const glm::uvec3 &t : mesh.triangles) {
        for (int i = 0; i < 3; ++i)
            if (!edges.emplace(t[i], t[(i + 1) % 3]).second) return false;
        volume += glm::dot(mesh.vertices_mm[t.x] - origin, normal_of(mesh, t));
    }
    for (const auto &[a, b] : edges)
        if (!edges.contains({b, a})) return false;
    return volume > 0;
}

} // namespace

void Reader::sphere(const Node &node) {
    Properties p(node, document_);
    const Vec3 centre = p.point("center").value_or(Vec3(0));
    const double radius = p.number("radius").value_or(1);
    const glm::dmat4 m = p.transform("to_world").matrix;
    const bool flipped = p.boolean("flip_normals", false);
    const std::vector<const Node *> bsdfs = p.children("bsdf");
    p.finish();
    const double scale = glm::length(column(m, 0));
    const glm::dmat3 turned = glm::dmat3(m) / scale;
    const glm::dmat3 off = glm::transpose(turned) * turned - glm::dmat3(1);
    double skew = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) skew = std::max(skew, std::abs(off[i][j]));
    if (!(scale > 0) || !(skew < equal_enough)) return findings_.problem(node, "its transform makes it no sphere");
    if (bsdfs.size() != 1) return findings_.problem(node, "a sphere needs one BSDF, of glass");
    std::optional<GlassSurface> made = glass(*bsdfs.front());
    if (!made) return;
    if (flipped) std::swap(made->inside, made->outside);
    spheres_.push_back(
        {&node, name_of(node), unit_mm_ * Vec3(m * glm::dvec4(centre, 1)), unit_mm_ * radius * scale, *made});
}

void Reader::rectangle(const Node &node) {
    Properties p(node, document_);
    const glm::dmat4 m = p.transform("to_world").matrix;
    const bool flipped = p.boolean("flip_normals", false);
    const std::string name = name_of(node);
    const std::optional<TwoSides> sides = painted(p, name);
    p.finish();
    if (!sides) return;
    if (const auto *texture = texture_of(sides->front); texture && wrap_.contains(name) && !edges_meet(**texture))
        findings_.change(node, "its picture is repeated in the file, so that half a texel at each edge mixes with the "
                               "edge across; here pictures end at their edges (wrap_mode clamp)");
    const Vec3 u = column(m, 0), v = column(m, 1);
    if (!(glm::length(u) > 0 && glm::length(v) > 0) ||
        std::abs(glm::dot(u, v)) > equal_enough * glm::length(u) * glm::length(v))
        return findings_.problem(node, "its transform makes it no rectangle");
    // A picture's first row lies at the rectangle's -y; ours lies at the end of half_v.
    const Quad quad{unit_mm_ * column(m, 3), unit_mm_ * u, -unit_mm_ * v, Diffuse{}};
    // Normals go by the inverse transpose, which a mirror turns round.
    const Vec3 normal = glm::cross(u, v) * (glm::determinant(glm::dmat3(m)) < 0 ? -1.0 : 1.0) * (flipped ? -1.0 : 1.0);
    // A flat transform (z scaled by nothing) has no inverse, and its normal is that of its sides.
    flats_.push_back({&node, {name, quad}, normal, *sides});
}

void Reader::mesh(const Node &node) {
    Properties p(node, document_);
    const std::string name = name_of(node), named = p.word("filename", "");
    const glm::dmat4 m = p.transform("to_world").matrix;
    const bool is_obj = p.type() == "obj", flip = p.boolean("flip_tex_coords", is_obj);
    const bool flat = p.boolean("face_normals", false);
    const bool flipped = p.boolean("flip_normals", false);
    p.leave_out({"max_smooth_angle", "collapse", "shape_index"}, "a mesh is flat shaded, and read whole");
    const std::optional<TwoSides> sides = painted(p, name);
    p.finish();
    std::string file;
    if (parameters_.has(name + ".mesh")) file = parameters_.word(name + ".mesh");
    if (file.empty() && parameters_.has("robe.shape") && parameters_.word("robe.shape") == name)
        file = parameters_.word("robe.mesh");
    if (file.empty()) {
        if (named.empty()) return findings_.problem(node, "filename is missing");
        file = resolved(named, node, document_.tree.root).string();
        std::error_code ignored;
        if (!std::filesystem::exists(file, ignored))
            return findings_.problem(node, fmt::format("there is no mesh {} (--set {}.mesh=FILE gives another)",
                                                       one_line(named), one_line(name)));
    }
    if (!sides) return;
    if (sides->grid) return findings_.problem(node, "a grid texture can only lie on a rectangle");
    Mesh mesh;
    try {
        mesh = parameters_.files().mesh(file);
    } catch (const Error &error) {
        if (error.code() != Exit::bad_data && error.code() != Exit::input_output) throw;
        return findings_.problem(node, error.what());
    }
    for (Vec3 &v : mesh.vertices_mm) v = unit_mm_ * Vec3(m * glm::dvec4(v, 1));
    // Our v points up, to a picture's first row; theirs points down.
    if (!flip)
        for (Vec2 &uv : mesh.uv) uv.y = 1 - uv.y;
    if (wrap_.contains(name))
        for (const Vec2 &uv : mesh.uv)
            if (!(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1)) {
                findings_.problem(node, fmt::format("its texture is repeated (texture coordinates reach ({:g}, {:g})), "
                                                    "and here pictures end at their edges",
                                                    uv.x, uv.y));
                break;
            }
    const bool shaded = std::holds_alternative<Diffuse>(sides->front) && !is_black(sides->front);
    if (!flat && shaded && !is_flat(mesh))
        findings_.change(node, "is flat shaded: normals of its vertices are not used");
    // The side that the triangles' winding calls the front.
    flats_.push_back({&node, {name, std::move(mesh)}, Vec3(0, 0, flipped ? -1 : 1), *sides});
}

void Reader::put_glass_together() {
    std::ranges::stable_sort(spheres_, std::greater{}, &Sphere::radius_mm);
    std::vector<bool> done(spheres_.size(), false);
    for (std::size_t i = 0; i < spheres_.size(); ++i) {
        if (done[i]) continue;
        const Sphere &outer = spheres_[i];
        const Sphere *inner = nullptr;
        for (std::size_t j = i + 1; j < spheres_.size(); ++j) {
            const Sphere &other = spheres_[j];
            const double apart = glm::distance(outer.centre_mm, other.centre_mm);
            if (done[j] || !(apart + other.radius_mm <= outer.radius_mm * (1 + equal_enough))) continue;
            done[j] = true;
            if (inner || outer.glass.thin || other.glass.thin || apart > equal_enough * outer.radius_mm ||
                !(other.radius_mm < outer.radius_mm) || !close(other.glass.outside, outer.glass.inside) ||
                !close(other.glass.inside, outer.glass.outside) ||
                other.glass.transmittance != outer.glass.transmittance) {
                findings_.problem(
                    *other.node, "lies in another sphere, and is not the one hollow of it: concentric, smaller, of the "
                                 "same glass turned round (flipNormals, or both indices exchanged) and the same tint");
                continue;
            }
            inner = &other;
        }
        const Glass glass{outer.glass.inside / outer.glass.outside, outer.glass.transmittance, Coating::fresnel};
        if (!(glass.index >= 1)) {
            findings_.problem(*outer.node,
                              fmt::format("is less dense than what is round it (index {:g})", glass.index));
            continue;
        }
        if (outer.glass.thin) {
            const double share = parameters_.number("thin.wall_share");
            // In the file the tint is on what passes alone; here what the inner surface reflects passes the outer one.
            const double lost = (1 - glass.interface_transmittance) / 2;
            findings_.change(*outer.node,
                             fmt::format("a sheet without thickness is taken as a hollow orb whose wall is "
                                         "{:g} of its radius (thin.wall_share), its tint as that of two surfaces{}",
                                         share,
                                         lost > 0 ? fmt::format(": it reflects about {:.2g} % less", 100 * lost) : ""));
            Glass sheet = glass;
            sheet.interface_transmittance = std::sqrt(glass.interface_transmittance);
            scene_.objects.push_back(
                {outer.name, GlassShell{outer.centre_mm, outer.radius_mm, share * outer.radius_mm, sheet}});
        } else if (inner)
            scene_.objects.push_back(
                {outer.name, GlassShell{outer.centre_mm, outer.radius_mm, outer.radius_mm - inner->radius_mm, glass}});
        else
            scene_.objects.push_back({outer.name, GlassBall{outer.centre_mm, outer.radius_mm, glass}});
    }
}

/// How far the eye and all glass stand before a plane, at least and at most: light that reaches the eye comes straight
/// from the surface, or from glass.
std::pair<double, double> Reader::depths_of_view(Vec3 point, Vec3 normal) const {
    double least = glm::dot(scene_.camera.eye_mm - point, normal), most = least;
    if (scene_.camera.projection == Projection::orthographic) {
        const Vec3 forward = glm::normalize(scene_.camera.target_mm - scene_.camera.eye_mm);
        least = most = -glm::dot(forward, normal);
    }
    for (const Object &object : scene_.objects)
        if (const auto orb = outer_sphere(object.shape)) {
            const double d = glm::dot(orb->centre_mm - point, normal);
            least = std::min(least, d - orb->radius_mm * (1 - equal_enough));
            most = std::max(most, d + orb->radius_mm * (1 - equal_enough));
        }
    return {least, most};
}

int Reader::side_of_view(const Flat &flat) const {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    const auto take = [&](Vec3 point, Vec3 normal) {
        const auto [l, m] = depths_of_view(point, normal);
        least = std::min(least, l);
        most = std::max(most, m);
    };
    if (const Quad *quad = std::get_if<Quad>(&flat.object.shape)) {
        take(quad->centre_mm, glm::normalize(flat.normal));
    } else {
        const Mesh &mesh = std::get<Mesh>(flat.object.shape);
        if (flat.normal.z > 0 && is_closed(mesh)) return 1;
        for (const glm::uvec3 &t : mesh.triangles) {
            const Vec3 n = normal_of(mesh, t);
            if (glm::length(n) > 0) take(mesh.vertices_mm[t.x], flat.normal.z * glm::normalize(n));
        }
    }
    return least >= 0 ? 1 : most <= 0 ? -1 : 0;
}

void Reader::put_surfaces_together() {
    bool reflects = false, emits = false;
    const Node *emitting = nullptr;
    for (Flat &flat : flats_) {
        const bool is_quad = std::holds_alternative<Quad>(flat.object.shape);
        int side = 1;
        const bool black = is_black(flat.sides.front) && is_black(flat.sides.back) && !flat.sides.grid;
        if (!flat.sides.alike && !black) {
            side = side_of_view(flat);
            if (side == 0 && !is_quad)
                findings_.change(*flat.node, "has one side in the file, and may be seen from both; here both are as "
                                             "its front");
            else if (side == 0)
                findings_.problem(*flat.node, "its two sides differ, and both can be seen: make it twosided");
        }
        Surface shown = side < 0 ? flat.sides.back : flat.sides.front;
        if (flat.sides.grid && side > 0) {
            add_grid(flat);
            reflects = true;
            continue;
        }
        if (const auto *d = std::get_if<Diffuse>(&shown)) reflects |= greatest_value(d->reflectance) != Rgb(0);
        if (!is_black(shown) && !std::holds_alternative<Diffuse>(shown)) {
            emits = true;
            emitting = flat.node;
        }
        *surface_of(flat.object.shape) = std::move(shown);
        scene_.objects.push_back(std::move(flat.object));
    }
    if (emits && reflects)
        findings_.problem(*emitting, "an area light that would light diffuse surfaces: here emitters are only seen");
}

void Reader::add_grid(const Flat &flat) {
    const Grid &grid = *flat.sides.grid;
    const Quad &quad = std::get<Quad>(flat.object.shape);
    // Where a coordinate, in cells, enters and leaves a line.
    const auto borders = [&](double cells) {
        std::vector<double> all{0};
        for (int k = 0; k <= static_cast<int>(cells) + 1; ++k)
            for (const double at : {k - grid.line_width, k + grid.line_width})
                if (at > 0 && at < cells) all.push_back(at);
        all.push_back(cells);
        std::ranges::sort(all);
        all.erase(std::unique(all.begin(), all.end()), all.end()); // not the ranges form: clang 14 cannot read it
        return all;
    };
    const std::vector<double> us = borders(grid.scale.x), vs = borders(grid.scale.y);
    const auto in_line = [&](double from, double to) {
        const double middle = (from + to) / 2;
        return std::abs(middle - std::round(middle)) < grid.line_width;
    };
    Mesh field, lines;
    for (Mesh *mesh : {&field, &lines})
        for (const double v : vs)
            for (const double u : us) {
                // Their v runs down: against half_v.
                mesh->vertices_mm.push_back(quad.centre_mm + (2 * u / grid.scale.x - 1) * quad.half_u_mm -
                                            (2 * v / grid.scale.y - 1) * quad.half_v_mm);
            }
    const auto columns = static_cast<std::uint32_t>(us.size());
    for (std::uint32_t j = 0; j + 1 < vs.size(); ++j)
        for (std::uint32_t i = 0; i + 1 < columns; ++i) {
            Mesh &mesh = in_line(us[i], us[i + 1]) || in_line(vs[j], vs[j + 1]) ? lines : field;
            const std::uint32_t a = j * columns + i;
            mesh.triangles.push_back({a, a + 1, a + 1 + columns});
            mesh.triangles.push_back({a, a + 1 + columns, a + columns});
        }
    field.surface = Diffuse{grid.field};
    lines.surface = Diffuse{grid.line};
    if (!field.triangles.empty()) scene_.objects.push_back({flat.object.name, std::move(field)});
    if (!lines.triangles.empty()) scene_.objects.push_back({flat.object.name + ", grid", std::move(lines)});
}

} // namespace threefold::mitsuba
