// SPDX-License-Identifier: MIT
#include "verifier/tracer/embree_world.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "scenes/error.h"
#include "verifier/tracer/exact_block.h"

namespace threefold::tracer {

namespace {

/// A rectangle for Embree is two triangles' worth of corners in order.
std::array<Vec3, 4> corners(const Quad &q) {
    return {q.centre_mm - q.half_u_mm - q.half_v_mm, q.centre_mm + q.half_u_mm - q.half_v_mm,
            q.centre_mm + q.half_u_mm + q.half_v_mm, q.centre_mm - q.half_u_mm + q.half_v_mm};
}

void put(float *to, Vec3 v) {
    for (int k = 0; k < 3; ++k) to[k] = static_cast<float>(v[k]);
}

// Embree 4 renamed the context and put it among optional arguments. Rays are never called coherent: Embree 3 then
// follows their common frustum, which took 1.7 times as long even for rays from one pixel or towards one light.
#if RTC_VERSION_MAJOR >= 4
using Context = RTCRayQueryContext;
#else
using Context = RTCIntersectContext;
#endif

/// A shadow ray's start and direction, in double precision, by lane.
class ExactRays {
public:
    explicit ExactRays(const Ray &ray) : ray_(&ray) {}
    explicit ExactRays(const RayPacket &rays) : rays_(&rays) {}
    Vec3 origin_mm(unsigned lane) const { return ray_ ? ray_->origin_mm : rays_->origin.at(static_cast<int>(lane)); }
    Vec3 direction(unsigned lane) const { return ray_ ? ray_->direction : rays_->direction.at(static_cast<int>(lane)); }

private:
    const Ray *ray_ = nullptr;
    const RayPacket *rays_ = nullptr;
};

struct Query : Context {
    const Left *left = nullptr; ///< by lane
    const ExactRays *rays = nullptr;
    const ExactShapes *shapes = nullptr;

    Query() {
#if RTC_VERSION_MAJOR >= 4
        rtcInitRayQueryContext(this);
#else
        rtcInitIntersectContext(this);
#endif
    }
};

/// How far the start of a ray lies from the plane that it meets, by Embree's numbers.
float height_of(const RTCFilterFunctionNArguments *args, unsigned i) {
    const float nx = RTCHitN_Ng_x(args->hit, args->N, i), ny = RTCHitN_Ng_y(args->hit, args->N, i),
                nz = RTCHitN_Ng_z(args->hit, args->N, i);
    const float slope = nx * RTCRayN_dir_x(args->ray, args->N, i) + ny * RTCRayN_dir_y(args->ray, args->N, i) +
                        nz * RTCRayN_dir_z(args->ray, args->N, i);
    return RTCRayN_tfar(args->ray, args->N, i) * std::abs(slope) / std::sqrt(nx * nx + ny * ny + nz * nz);
}

/// Rays start on their surface at distance 0: it does not stand in their way. What begins so near to the start that
/// single precision could not tell is looked at in double.
void pass_over_left(const RTCFilterFunctionNArguments *args) {
    const Query &query = *static_cast<const Query *>(args->context);
    if (!query.left) return;
    const auto near_mm = static_cast<float>(16 * std::numeric_limits<float>::epsilon() * query.shapes->reach_mm());
    for (unsigned i = 0; i < args->N; ++i) {
        if (!args->valid[i]) continue;
        const unsigned lane = RTCRayN_id(args->ray, args->N, i);
        const Left &own = query.left[lane];
        const unsigned object = RTCHitN_geomID(args->hit, args->N, i), triangle = RTCHitN_primID(args->hit, args->N, i);
        const bool is_own = triangle == own.triangle && object == own.object;
        if (is_own ||
            (!(height_of(args, i) > near_mm) &&
             !query.shapes->blocks(object, triangle, query.rays->origin_mm(lane), query.rays->direction(lane))))
            args->valid[i] = 0;
    }
}

#if RTC_VERSION_MAJOR >= 4
RTCIntersectArguments intersecting(Query &query) {
    RTCIntersectArguments a;
    rtcInitIntersectArguments(&a);
    a.context = &query;
    return a;
}
RTCOccludedArguments occluding(Query &query) {
    RTCOccludedArguments a;
    rtcInitOccludedArguments(&a);
    a.context = &query;
    return a;
}
#endif

/// The lanes' rays in single precision, all the way.
void put(const RayPacket &rays, Vec3 origin, RTCRay8 &r) {
    for (int l = 0; l < lanes; ++l) {
        r.org_x[l] = static_cast<float>(rays.origin.x.v[l] - origin.x);
        r.org_y[l] = static_cast<float>(rays.origin.y.v[l] - origin.y);
        r.org_z[l] = static_cast<float>(rays.origin.z.v[l] - origin.z);
        r.dir_x[l] = static_cast<float>(rays.direction.x.v[l]);
        r.dir_y[l] = static_cast<float>(rays.direction.y.v[l]);
        r.dir_z[l] = static_cast<float>(rays.direction.z.v[l]);
    }
    for (unsigned l = 0; l < lanes; ++l) {
        r.tnear[l] = 0;
        r.tfar[l] = std::numeric_limits<float>::infinity();
        r.time[l] = 0;
        r.mask[l] = ~0u;
        r.id[l] = l;
        r.flags[l] = 0;
    }
}

using Geometry = std::unique_ptr<RTCGeometryTy, decltype(&rtcReleaseGeometry)>;

const char *meaning(RTCError code) {
    switch (code) {
    case RTC_ERROR_INVALID_ARGUMENT:
        return "invalid argument";
    case RTC_ERROR_INVALID_OPERATION:
        return "invalid operation";
    case RTC_ERROR_OUT_OF_MEMORY:
        return "out of memory";
    case RTC_ERROR_UNSUPPORTED_CPU:
        return "unsupported processor";
    case RTC_ERROR_CANCELLED:
        return "cancelled";
    default:
        return "unknown error"; // a later Embree has more
    }
}

struct alignas(32) Valid {
    int lane[lanes];
    explicit Valid(std::uint32_t active) {
        for (int l = 0; l < lanes; ++l) lane[l] = (active >> l & 1u) ? -1 : 0;
    }
};

} // namespace

/// What Embree reports, from any of its threads; it throws nothing itself.
class EmbreeErrors {
public:
    void record(RTCError code, const char *text) {
        const std::lock_guard lock(mutex_);
        if (code_ != RTC_ERROR_NONE) return; // others follow from the first
        code_ = code;
        text_ = text ? text : "";
    }
    /// Throws what was reported since the last call.
    void check() {
        const std::lock_guard lock(mutex_);
        if (code_ == RTC_ERROR_NONE) return;
        const RTCError code = std::exchange(code_, RTC_ERROR_NONE);
        if (code == RTC_ERROR_OUT_OF_MEMORY)
            throw Error(Exit::bad_data, "not enough memory for the scene's surfaces in Embree",
                        "a mesh with fewer triangles takes less");
        throw Error(Exit::internal, fmt::format("Embree could not build the scene: {} ({})", meaning(code), text_));
    }

private:
    std::mutex mutex_;
    RTCError code_ = RTC_ERROR_NONE;
    std::string text_;
};

struct EmbreeWorld::State {
    Vec3 origin;
    ExactShapes shapes;
    EmbreeErrors errors; // outlives the device, which writes to it
    std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device{nullptr, &rtcReleaseDevice};
    std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)> scene{nullptr, &rtcReleaseScene};

    explicit State(Vec3 origin_mm) : origin(origin_mm) {
        device.reset(rtcNewDevice(nullptr));
        if (!device) errors.record(rtcGetDeviceError(nullptr), "no device");
        errors.check();
        rtcSetDeviceErrorFunction(
            device.get(),
            [](void *errors, RTCError code, const char *text) {
                static_cast<EmbreeErrors *>(errors)->record(code, text);
            },
            &errors);
        scene.reset(rtcNewScene(device.get()));
        errors.check();
        // A ray along an edge shared by two triangles hits one of them.
        rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    }
    State(const State &) = delete;
    State &operator=(const State &) = delete;

    Geometry new_geometry(RTCGeometryType type) {
        Geometry geometry{rtcNewGeometry(device.get(), type), &rtcReleaseGeometry};
        errors.check();
        return geometry;
    }

    /// Null only for nothing.
    template <class Number>
    Number *new_buffer(const Geometry &geometry, RTCBufferType type, RTCFormat format, std::size_t each,
                       std::size_t count) {
        void *buffer = rtcSetNewGeometryBuffer(geometry.get(), type, 0, format, each * sizeof(Number), count);
        if (!buffer && count > 0) errors.record(RTC_ERROR_OUT_OF_MEMORY, "no buffer");
        errors.check();
        return static_cast<Number *>(buffer);
    }
    float *new_vertices(const Geometry &geometry, std::size_t count) {
        return new_buffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, 3, count);
    }
    unsigned *new_indices(const Geometry &geometry, RTCFormat format, std::size_t each, std::size_t count) {
        return new_buffer<unsigned>(geometry, RTC_BUFFER_TYPE_INDEX, format, each, count);
    }

    void add(std::size_t object, const Geometry &geometry) {
        rtcSetGeometryOccludedFilterFunction(geometry.get(), pass_over_left);
        rtcCommitGeometry(geometry.get());
        rtcAttachGeometryByID(scene.get(), geometry.get(), static_cast<unsigned>(object));
        errors.check();
    }

    RTCRay ray_of(const Ray &ray) const {
        RTCRay r{};
        const Vec3 o = ray.origin_mm - origin;
        r.org_x = static_cast<float>(o.x);
        r.org_y = static_cast<float>(o.y);
        r.org_z = static_cast<float>(o.z);
        r.dir_x = static_cast<float>(ray.direction.x);
        r.dir_y = static_cast<float>(ray.direction.y);
        r.dir_z = static_cast<float>(ray.direction.z);
        r.tfar = std::numeric_limits<float>::infinity();
        r.mask = ~0u;
        return r;
    }
};

EmbreeWorld::EmbreeWorld(Vec3 origin_mm) : state_(std::make_unique<State>(origin_mm)) {}
EmbreeWorld::~EmbreeWorld() = default;

void EmbreeWorld::add(std::size_t object, const Quad &quad) {
    const Geometry geometry = state_->new_geometry(RTC_GEOMETRY_TYPE_QUAD);
    float *vertices = state_->new_vertices(geometry, 4);
    unsigned *indices = state_->new_indices(geometry, RTC_FORMAT_UINT4, 4, 1);
    const auto c = corners(quad);
    for (unsigned k = 0; k < 4; ++k) {
        put(vertices + 3 * k, c[k] - state_->origin);
        indices[k] = k;
        state_->shapes.reach_to(glm::length(c[k] - state_->origin));
    }
    state_->shapes.add(object, quad);
    state_->add(object, geometry);
}

void EmbreeWorld::add(std::size_t object, const Mesh &mesh) {
    const Geometry geometry = state_->new_geometry(RTC_GEOMETRY_TYPE_TRIANGLE);
    float *vertices = state_->new_vertices(geometry, mesh.vertices_mm.size());
    for (std::size_t k = 0; k < mesh.vertices_mm.size(); ++k) {
        const Vec3 vertex = mesh.vertices_mm[k] - state_->origin;
        put(vertices + 3 * k, vertex);
        state_->shapes.reach_to(glm::length(vertex));
    }
    state_->shapes.add(object, mesh);
    unsigned *indices = state_->new_indices(geometry, RTC_FORMAT_UINT3, 3, mesh.triangles.size());
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
        for (int i = 0; i < 3; ++i) indices[3 * k + static_cast<std::size_t>(i)] = mesh.triangles[k][i];
    state_->add(object, geometry);
}

void EmbreeWorld::commit() {
    rtcCommitScene(state_->scene.get());
    state_->errors.check();
}

Candidate EmbreeWorld::intersect(const Ray &ray) const {
    RTCRayHit r{};
    r.ray = state_->ray_of(ray);
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    Query query;
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments arguments = intersecting(query);
    rtcIntersect1(state_->scene.get(), &r, &arguments);
#else
    rtcIntersect1(state_->scene.get(), &query, &r);
#endif
    if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {r.hit.geomID, r.hit.primID, r.ray.tfar, r.hit.u, r.hit.v};
}

bool EmbreeWorld::blocks(const Ray &ray, Left left) const {
    RTCRay r = state_->ray_of(ray);
    const ExactRays exact(ray);
    Query query;
    query.left = &left;
    query.rays = &exact;
    query.shapes = &state_->shapes;
#if RTC_VERSION_MAJOR >= 4
    RTCOccludedArguments arguments = occluding(query);
    rtcOccluded1(state_->scene.get(), &r, &arguments);
#else
    rtcOccluded1(state_->scene.get(), &query, &r);
#endif
    return r.tfar < 0; // how Embree says so
}

void EmbreeWorld::intersect(const RayPacket &rays, std::uint32_t active, const Lanes &limit,
                            Candidate (&candidates)[lanes]) const {
    RTCRayHit8 r;
    put(rays, state_->origin, r.ray);
    // What lies about as far as the limit is compared in double precision.
    for (int l = 0; l < lanes; ++l)
        r.ray.tfar[l] = static_cast<float>(limit.v[l]) * 1.0001f +
                        1e-5f * (std::abs(r.ray.org_x[l]) + std::abs(r.ray.org_y[l]) + std::abs(r.ray.org_z[l]));
    for (unsigned &id : r.hit.geomID) id = RTC_INVALID_GEOMETRY_ID;
    for (unsigned &id : r.hit.instID[0]) id = RTC_INVALID_GEOMETRY_ID;
    const Valid valid(active);
    Query query;
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments arguments = intersecting(query);
    rtcIntersect8(valid.lane, state_->scene.get(), &r, &arguments);
#else
    rtcIntersect8(valid.lane, state_->scene.get(), &query, &r);
#endif
    for (int l = 0; l < lanes; ++l)
        candidates[l] = {r.hit.geomID[l], r.hit.primID[l], r.ray.tfar[l], r.hit.u[l], r.hit.v[l]};
}

std::uint32_t EmbreeWorld::blocks(const RayPacket &rays, std::uint32_t active, const Left (&left)[lanes]) const {
    RTCRay8 r;
    put(rays, state_->origin, r);
    const Valid valid(active);
    const ExactRays exact(rays);
    Query query;
    query.left = left;
    query.rays = &exact;
    query.shapes = &state_->shapes;
#if RTC_VERSION_MAJOR >= 4
    RTCOccludedArguments arguments = occluding(query);
    rtcOccluded8(valid.lane, state_->scene.get(), &r, &arguments);
#else
    rtcOccluded8(valid.lane, state_->scene.get(), &query, &r);
#endif
    std::uint32_t blocked = 0;
    for (int l = 0; l < lanes; ++l) blocked |= static_cast<std::uint32_t>(r.tfar[l] < 0) << l;
    return blocked & active;
}

std::string embree_version() { return RTC_VERSION_STRING; }

} // namespace threefold::tracer
