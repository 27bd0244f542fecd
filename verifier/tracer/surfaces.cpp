// SPDX-License-Identifier: MIT
#include "verifier/tracer/surfaces.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scenes/error.h"
#include "scenes/texture.h"

namespace threefold::tracer {

namespace {

struct Device {
    RTCDevice handle = rtcNewDevice(nullptr);
    Device() {
        if (!handle) throw Error(Exit::internal, "Embree could not be started");
    }
    ~Device() { rtcReleaseDevice(handle); }
};

/// A rectangle for Embree is two triangles' worth of corners in order.
std::array<Vec3, 4> corners(const Quad &q) {
    return {q.centre_mm - q.half_u_mm - q.half_v_mm, q.centre_mm + q.half_u_mm - q.half_v_mm,
            q.centre_mm + q.half_u_mm + q.half_v_mm, q.centre_mm - q.half_u_mm + q.half_v_mm};
}

float *new_vertices(RTCGeometry geometry, std::size_t count) {
    return static_cast<float *>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), count));
}

unsigned *new_indices(RTCGeometry geometry, RTCFormat format, std::size_t each, std::size_t count) {
    return static_cast<unsigned *>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, format, each * sizeof(unsigned), count));
}

void put(float *to, Vec3 v) {
    for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(v[k]);
}

} // namespace

/// So few rectangles are met sooner one by one, in double precision, than through a hierarchy.
constexpr std::size_t few_rectangles = 8;

struct Surfaces::State {
    const Scene *scene;
    std::vector<Rectangle> rectangles; ///< those that are not in Embree's world
    bool exact;
    Vec3 origin; ///< of Embree's single-precision world
    Device device;
    RTCScene world;
    std::size_t count = 0;

    void add(std::size_t object, RTCGeometry geometry) {
        // The surface just left is passed over by name, in a filter, so that a ray may start on it at distance 0.
        rtcSetGeometryIntersectFilterFunction(geometry, pass_over_left);
        rtcSetGeometryOccludedFilterFunction(geometry, pass_over_left);
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(world, geometry, static_cast<unsigned>(object));
        rtcReleaseGeometry(geometry);
        ++count;
    }

    void add(std::size_t object, const Quad &quad) {
        RTCGeometry geometry = rtcNewGeometry(device.handle, RTC_GEOMETRY_TYPE_QUAD);
        float *vertices = new_vertices(geometry, 4);
        unsigned *indices = new_indices(geometry, RTC_FORMAT_UINT4, 4, 1);
        const auto c = corners(quad);
        for (unsigned k = 0; k < 4; ++k) {
            put(vertices + 3 * k, c[k] - origin);
            indices[k] = k;
        }
        add(object, geometry);
    }

    void add(std::size_t object, const Mesh &mesh) {
        RTCGeometry geometry = rtcNewGeometry(device.handle, RTC_GEOMETRY_TYPE_TRIANGLE);
        float *vertices = new_vertices(geometry, mesh.vertices_mm.size());
        for (std::size_t k = 0; k < mesh.vertices_mm.size(); ++k) put(vertices + 3 * k, mesh.vertices_mm[k] - origin);
        unsigned *indices = new_indices(geometry, RTC_FORMAT_UINT3, 3, mesh.triangles.size());
        for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
            for (int i = 0; i < 3; ++i) indices[3 * k + static_cast<std::size_t>(i)] = mesh.triangles[k][i];
        add(object, geometry);
    }

#if RTC_VERSION_MAJOR >= 4
    struct Query : RTCRayQueryContext {
        const SurfaceHit *left;
    };
#else
    struct Query : RTCIntersectContext {
        const SurfaceHit *left;
    };
#endif

    static void pass_over_left(const RTCFilterFunctionNArguments *args) {
        const SurfaceHit *left = static_cast<const Query *>(args->context)->left;
        if (left && RTCHitN_geomID(args->hit, 1, 0) == left->object &&
            RTCHitN_primID(args->hit, 1, 0) == left->triangle)
            args->valid[0] = 0;
    }

    RTCRay embree_ray(const Ray &ray) const {
        RTCRay r{};
        const Vec3 o = ray.origin_mm - origin;
        r.org_x = static_cast<float>(o.x);
        r.org_y = static_cast<float>(o.y);
        r.org_z = static_cast<float>(o.z);
        r.dir_x = static_cast<float>(ray.direction.x);
        r.dir_y = static_cast<float>(ray.direction.y);
        r.dir_z = static_cast<float>(ray.direction.z);
        r.tfar = std::numeric_limits<float>::infinity();
        r.mask = static_cast<unsigned>(-1);
        return r;
    }

    RTCRayHit shoot(const Ray &ray, const SurfaceHit *left) const {
        RTCRayHit hit{};
        hit.ray = embree_ray(ray);
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        Query query;
        query.left = left;
#if RTC_VERSION_MAJOR >= 4
        rtcInitRayQueryContext(&query);
        RTCIntersectArguments arguments;
        rtcInitIntersectArguments(&arguments);
        arguments.context = &query;
        rtcIntersect1(world, &hit, &arguments);
#else
        rtcInitIntersectContext(&query);
        rtcIntersect1(world, &query, &hit);
#endif
        return hit;
    }

    bool is_blocked(const Ray &ray, const SurfaceHit *left) const {
        RTCRay r = embree_ray(ray);
        Query query;
        query.left = left;
#if RTC_VERSION_MAJOR >= 4
        rtcInitRayQueryContext(&query);
        RTCOccludedArguments arguments;
        rtcInitOccludedArguments(&arguments);
        arguments.context = &query;
        rtcOccluded1(world, &r, &arguments);
#else
        rtcInitIntersectContext(&query);
        rtcOccluded1(world, &query, &r);
#endif
        return r.tfar < 0; // how Embree says so
    }

    /// The hit in double precision: the plane and the coordinates from the scene's own numbers.
    SurfaceHit refine(const Ray &ray, const RTCRayHit &found) const {
        SurfaceHit hit;
        hit.object = found.hit.geomID;
        hit.triangle = found.hit.primID;
        const Shape &shape = scene->objects[hit.object].shape;
        if (const Quad *quad = std::get_if<Quad>(&shape)) {
            hit.normal = glm::normalize(glm::cross(quad->half_u_mm, quad->half_v_mm));
            hit.distance =
                exact ? glm::dot(quad->centre_mm - ray.origin_mm, hit.normal) / glm::dot(ray.direction, hit.normal)
                      : static_cast<double>(found.ray.tfar);
            const Vec3 d = ray.origin_mm + hit.distance * ray.direction - quad->centre_mm;
            hit.uv = {0.5 + 0.5 * glm::dot(d, quad->half_u_mm) / glm::dot(quad->half_u_mm, quad->half_u_mm),
                      0.5 + 0.5 * glm::dot(d, quad->half_v_mm) / glm::dot(quad->half_v_mm, quad->half_v_mm)};
        } else {
            const Mesh &mesh = std::get<Mesh>(shape);
            const glm::uvec3 t = mesh.triangles[hit.triangle];
            const Vec3 a = mesh.vertices_mm[t.x], ab = mesh.vertices_mm[t.y] - a, ac = mesh.vertices_mm[t.z] - a;
            const Vec3 n = glm::cross(ab, ac);
            hit.normal = glm::normalize(n);
            Vec2 barycentric(found.hit.u, found.hit.v);
            hit.distance = found.ray.tfar;
            if (exact) {
                hit.distance = glm::dot(a - ray.origin_mm, n) / glm::dot(ray.direction, n);
                const Vec3 p = ray.origin_mm + hit.distance * ray.direction - a;
                const double area2 = glm::dot(n, n);
                barycentric = {glm::dot(glm::cross(p, ac), n) / area2, glm::dot(glm::cross(ab, p), n) / area2};
            }
            if (!mesh.uv.empty())
                hit.uv = mesh.uv[t.x] * (1 - barycentric.x - barycentric.y) + mesh.uv[t.y] * barycentric.x +
                         mesh.uv[t.z] * barycentric.y;
        }
        hit.position = ray.origin_mm + hit.distance * ray.direction;
        if (glm::dot(hit.normal, ray.direction) > 0) hit.normal = -hit.normal;
        return hit;
    }

    /// The nearest of the few rectangles, if it is nearer than `hit`.
    void meet_rectangles(const Ray &ray, const SurfaceHit *left, std::optional<SurfaceHit> &hit) const {
        for (const Rectangle &r : rectangles) {
            if (left && left->object == r.object) continue;
            const double slope = glm::dot(ray.direction, r.normal);
            const double distance = glm::dot(r.centre - ray.origin_mm, r.normal) / slope;
            if (!(distance >= 0) || (hit && distance >= hit->distance)) continue;
            const Vec3 position = ray.origin_mm + distance * ray.direction, d = position - r.centre;
            const Vec2 uv(0.5 + glm::dot(d, r.along_u), 0.5 + glm::dot(d, r.along_v));
            if (!(uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1)) continue;
            hit = SurfaceHit{distance, position, r.object, 0, uv, slope > 0 ? -r.normal : r.normal};
        }
    }

    const Surface &surface(const SurfaceHit &hit) const {
        const Shape &shape = scene->objects[hit.object].shape;
        if (const Quad *quad = std::get_if<Quad>(&shape)) return quad->surface;
        return std::get<Mesh>(shape).surface;
    }
};

Surfaces::Surfaces(const Scene &scene, bool exact) : state_(std::make_unique<State>()) {
    State &s = *state_;
    s.scene = &scene;
    s.exact = exact;
    s.origin = scene.camera.target_mm;
    s.world = rtcNewScene(s.device.handle);
    rtcSetSceneFlags(s.world, RTC_SCENE_FLAG_ROBUST); // a ray along an edge shared by two triangles hits one of them
    const auto quads = static_cast<std::size_t>(
        std::ranges::count_if(scene.objects, [](const Object &o) { return std::holds_alternative<Quad>(o.shape); }));
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
        std::visit(overloaded{
                       [](const GlassBall &) {},
                       [](const GlassShell &) {},
                       [&](const Quad &quad) {
                           if (exact && quads <= few_rectangles)
                               s.rectangles.emplace_back(i, quad);
                           else
                               s.add(i, quad);
                       },
                       [&](const Mesh &mesh) { s.add(i, mesh); },
                   },
                   scene.objects[i].shape);
    rtcCommitScene(s.world);
    if (const RTCError error = rtcGetDeviceError(s.device.handle); error != RTC_ERROR_NONE)
        throw Error(Exit::internal,
                    fmt::format("Embree could not build the scene (error {})", static_cast<int>(error)));
}

Surfaces::~Surfaces() { rtcReleaseScene(state_->world); }

std::optional<SurfaceHit> Surfaces::intersect(const Ray &ray, const SurfaceHit *left) const {
    std::optional<SurfaceHit> hit;
    if (state_->count > 0)
        if (const RTCRayHit found = state_->shoot(ray, left); found.hit.geomID != RTC_INVALID_GEOMETRY_ID)
            hit = state_->refine(ray, found);
    state_->meet_rectangles(ray, left, hit);
    return hit;
}

bool Surfaces::blocks(const Ray &ray, const SurfaceHit &left) const {
    if (state_->count > 0 && state_->is_blocked(ray, &left)) return true;
    std::optional<SurfaceHit> hit;
    state_->meet_rectangles(ray, &left, hit);
    return hit.has_value();
}

const std::vector<Rectangle> &Surfaces::rectangles() const { return state_->rectangles; }
bool Surfaces::only_rectangles() const { return state_->count == 0; }

Rgb Surfaces::emitted(const SurfaceHit &hit) const {
    return std::visit(overloaded{
                          [](const Diffuse &) { return Rgb(0); },
                          [&](const Emissive &e) { return sample(e.radiance, hit.uv); },
                          [&](const CoordinateCard &) { return Rgb(hit.uv.x, hit.uv.y, 1); },
                      },
                      state_->surface(hit));
}

std::optional<Rgb> Surfaces::reflectance(const SurfaceHit &hit) const {
    using Result = std::optional<Rgb>;
    return std::visit(overloaded{
                          [&](const Diffuse &d) { return Result(sample(d.reflectance, hit.uv)); },
                          [](const Emissive &) { return Result(); },
                          [](const CoordinateCard &) { return Result(); },
                      },
                      state_->surface(hit));
}

std::string embree_version() { return RTC_VERSION_STRING; }

} // namespace threefold::tracer
