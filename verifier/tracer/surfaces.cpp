// SPDX-License-Identifier: MIT
#include "verifier/tracer/surfaces.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scenes/access.h"

namespace threefold::tracer {

namespace {

/// So few rectangles are met sooner one by one, in double precision, than through a hierarchy.
constexpr std::size_t few_rectangles = 8;

/// The nearest of the few rectangles, if it is nearer than `hit`.
void meet_one_by_one(const std::vector<Rectangle> &rectangles, const Ray &ray, std::optional<std::size_t> left,
                     std::optional<SurfaceHit> &hit) {
    for (const Rectangle &r : rectangles) {
        if (left == r.object) continue;
        const double slope = glm::dot(ray.direction, r.normal);
        const double distance = glm::dot(r.centre - ray.origin_mm, r.normal) / slope;
        if (!(distance >= 0) || (hit && distance >= hit->distance)) continue;
        const Vec3 position = ray.origin_mm + distance * ray.direction, d = position - r.centre;
        const Vec2 uv(0.5 + glm::dot(d, r.along_u), 0.5 + glm::dot(d, r.along_v));
        if (!(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1)) continue;
        hit = SurfaceHit{distance, position, r.object, 0, uv, slope > 0 ? -r.normal : r.normal};
    }
}

std::size_t rectangles_in(const Scene &scene) {
    return static_cast<std::size_t>(
        std::ranges::count_if(scene.objects, [](const Object &o) { return std::holds_alternative<Quad>(o.shape); }));
}

} // namespace

Vec3 finest_about(const Scene &scene) {
    if (const auto orb = first_orb(scene)) return orb->centre_mm;
    Vec3 low(std::numeric_limits<double>::infinity()), high = -low;
    const auto hold = [&](Vec3 point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    };
    for (const Object &object : scene.objects) {
        if (const Quad *quad = std::get_if<Quad>(&object.shape)) hold(quad->centre_mm);
        if (const Mesh *mesh = std::get_if<Mesh>(&object.shape))
            for (const Vec3 &v : mesh->vertices_mm) hold(v);
    }
    return low.x <= high.x ? (low + high) / 2.0 : Vec3(0);
}

bool needs_embree(const Scene &scene) {
    return rectangles_in(scene) > few_rectangles ||
           std::ranges::any_of(scene.objects, [](const Object &o) { return std::holds_alternative<Mesh>(o.shape); });
}

Surfaces::Surfaces(const Scene &scene, bool exact) : scene_(&scene), exact_(exact) {
    const std::size_t quads = rectangles_in(scene);
    const auto world = [&]() -> EmbreeWorld & {
        if (!world_) world_ = std::make_unique<EmbreeWorld>(finest_about(scene));
        return *world_;
    };
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        std::visit(overloaded{
                       [](const GlassBall &) {},
                       [](const GlassShell &) {},
                       [&](const Quad &quad) {
                           if (exact && quads <= few_rectangles)
                               rectangles_.emplace_back(i, quad);
                           else
                               world().add(i, quad);
                       },
                       [&](const Mesh &mesh) { world().add(i, mesh); },
                   },
                   scene.objects[i].shape);
    if (world_) world_->commit();
}

/// The hit in double precision: the plane and the coordinates from the scene's own numbers.
SurfaceHit Surfaces::refine(Vec3 origin, Vec3 direction, const Candidate &found) const {
    SurfaceHit hit;
    hit.object = found.object;
    hit.triangle = found.triangle;
    const Shape &shape = scene_->objects[hit.object].shape;
    if (const Quad *quad = std::get_if<Quad>(&shape)) {
        hit.normal = glm::normalize(glm::cross(quad->half_u_mm, quad->half_v_mm));
        hit.distance = exact_ ? glm::dot(quad->centre_mm - origin, hit.normal) / glm::dot(direction, hit.normal)
                              : static_cast<double>(found.distance);
        const Vec3 d = origin + hit.distance * direction - quad->centre_mm;
        hit.uv = {0.5 + 0.5 * glm::dot(d, quad->half_u_mm) / glm::dot(quad->half_u_mm, quad->half_u_mm),
                  0.5 + 0.5 * glm::dot(d, quad->half_v_mm) / glm::dot(quad->half_v_mm, quad->half_v_mm)};
    } else {
        const Mesh &mesh = std::get<Mesh>(shape);
        const glm::uvec3 t = mesh.triangles[hit.triangle];
        const Vec3 a = mesh.vertices_mm[t.x], ab = mesh.vertices_mm[t.y] - a, ac = mesh.vertices_mm[t.z] - a;
        const Vec3 n = glm::cross(ab, ac);
        const double area2 = glm::dot(n, n);
        hit.normal = n / std::sqrt(area2);
        Vec2 barycentric(found.u, found.v);
        hit.distance = found.distance;
        if (exact_) {
            hit.distance = glm::dot(a - origin, n) / glm::dot(direction, n);
            if (!mesh.uv.empty()) {
                const Vec3 p = origin + hit.distance * direction - a;
                barycentric = {glm::dot(glm::cross(p, ac), n) / area2, glm::dot(glm::cross(ab, p), n) / area2};
            }
        }
        if (!mesh.uv.empty())
            hit.uv = mesh.uv[t.x] * (1 - barycentric.x - barycentric.y) + mesh.uv[t.y] * barycentric.x +
                     mesh.uv[t.z] * barycentric.y;
    }
    hit.position = origin + hit.distance * direction;
    if (glm::dot(hit.normal, direction) > 0) hit.normal = -hit.normal;
    return hit;
}

std::optional<SurfaceHit> Surfaces::intersect(const Ray &ray) const {
    std::optional<SurfaceHit> hit;
    if (world_)
        if (const Candidate found = world_->intersect(ray); found.object != Candidate::nothing)
            hit = refine(ray.origin_mm, ray.direction, found);
    meet_one_by_one(rectangles_, ray, std::nullopt, hit);
    return hit;
}

bool Surfaces::blocks(const Ray &ray, const SurfaceHit &left) const {
    if (world_ && world_->blocks(ray, left.left())) return true;
    std::optional<SurfaceHit> hit;
    meet_one_by_one(rectangles_, ray, left.object, hit);
    return hit.has_value();
}

std::uint32_t Surfaces::intersect(const RayPacket &rays, std::uint32_t active, const Lanes &limit,
                                  SurfaceHit (&hits)[lanes]) const {
    RectangleHits met;
    meet_rectangles(rectangles_, rays.origin, rays.direction, met);
    Lanes nearest;
    for (int l = 0; l < lanes; ++l) nearest[l] = std::min(limit[l], met.distance[l]);
    Candidate candidates[lanes];
    if (world_) world_->intersect(rays, active, nearest, candidates);
    std::uint32_t found = 0;
    for (std::uint32_t bits = active; bits; bits &= bits - 1) {
        const int l = std::countr_zero(bits);
        const Vec3 origin = rays.origin.at(l), direction = rays.direction.at(l);
        SurfaceHit &hit = hits[l];
        bool is_hit = false;
        if (candidates[l].object != Candidate::nothing) {
            hit = refine(origin, direction, candidates[l]);
            is_hit = hit.distance <= limit[l];
        }
        if (const double d = met.distance[l]; d <= limit[l] && !(is_hit && hit.distance <= d) && met.which[l] >= 0) {
            const Rectangle &r = rectangles_[static_cast<std::size_t>(met.which[l])];
            hit = {d, origin + d * direction, r.object,
                   0, {met.u[l], met.v[l]},   glm::dot(direction, r.normal) > 0 ? -r.normal : r.normal};
            is_hit = true;
        }
        found |= static_cast<std::uint32_t>(is_hit) << l;
    }
    return found;
}

std::uint32_t Surfaces::blocks(const RayPacket &rays, std::uint32_t active, const Left (&left)[lanes]) const {
    std::uint32_t blocked = 0;
    if (!rectangles_.empty()) {
        Lanes own;
        for (int l = 0; l < lanes; ++l) own[l] = left[l].object;
        blocked = active & rectangles_block(rectangles_, rays, own);
    }
    if (const std::uint32_t open = active & ~blocked; world_ && open) blocked |= world_->blocks(rays, open, left);
    return blocked;
}

} // namespace threefold::tracer
