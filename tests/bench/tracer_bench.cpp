// SPDX-License-Identifier: MIT
// Speed of the tracer's parts; docs/PERFORMANCE.md says what they came to. Ratios are what counts: the same machine,
// one run. Needs Google Benchmark.
#include <benchmark/benchmark.h>

#include <bit>

#if __has_include(<embree3/rtcore.h>)
#include <embree3/rtcore.h>
#define THREEFOLD_BENCH_EMBREE
#endif

#include "scenes/camera.h"
#include "verifier/tracer/packet.h"
#include "verifier/tracer/tracer.h"

namespace threefold {
namespace {

using namespace tracer;

/// Squares and thin lines, as hard on the sampling as the picture that the figures were taken with.
std::shared_ptr<const Texture> backdrop() {
    constexpr int side = 1024;
    auto t = std::make_shared<Texture>(Texture{side, side, {}});
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const bool line = x % 192 > 186 || y % 192 > 186, light = (x / 64 + y / 64) % 2;
            for (int c = 0; c < 3; ++c)
                t->rgb.push_back(static_cast<std::uint16_t>(line ? 4000 : light ? 45000 - 8 * x + 4000 * c : 16400));
        }
    return t;
}

/// A shell of 2 % wall before a bright backdrop, filling 80 % of the picture's width.
Scene scene_of(double wall_mm, int side_px) {
    Scene s;
    s.objects = {{"orb", GlassShell{{0, 0, 0}, 67.98, wall_mm, {}}},
                 {"backdrop", Quad{{0, 0, -250}, {200, 0, 0}, {0, 200, 0}, Emissive{backdrop()}}}};
    s.environment = Environment{Rgb(0.02)};
    s.camera.eye_mm = {0, 0, 900};
    s.camera.horizontal_fov_deg = 10.818096;
    s.camera.width_px = s.camera.height_px = side_px;
    return s;
}

/// Rays of one pixel row after another, those that meet the orb.
std::vector<RayPacket> packets(const Scene &scene) {
    std::vector<RayPacket> all;
    const Film film(scene.camera);
    for (int row = 0; row < scene.camera.height_px; ++row)
        for (int column = 0; column < scene.camera.width_px; ++column) {
            RayPacket rays;
            camera_rays(film, PixelSampler(1, column, row), 0, Vec2(column, row), rays);
            const double x = column + 0.5 - scene.camera.width_px / 2.0, y = row + 0.5 - scene.camera.height_px / 2.0;
            if (std::hypot(x, y) < 0.39 * scene.camera.width_px) all.push_back(rays);
        }
    return all;
}

const Orb<double> shell{Vec3(0), 67.98, 66.62, 1.51714, 1, Coating::fresnel};

void meet_one_by_one(benchmark::State &state) {
    const auto all = packets(scene_of(1.36, 64));
    for (auto _ : state)
        for (const RayPacket &rays : all)
            for (int l = 0; l < lanes; ++l) {
                Entry<double> entry;
                benchmark::DoNotOptimize(intersect(shell, {rays.origin.at(l), rays.direction.at(l)}, entry));
            }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()) * lanes);
}
BENCHMARK(meet_one_by_one);

void meet_eight_at_once(benchmark::State &state) {
    const auto all = packets(scene_of(1.36, 64));
    EntryPacket entry;
    for (auto _ : state)
        for (const RayPacket &rays : all) {
            intersect(shell, rays, entry);
            benchmark::DoNotOptimize(entry);
        }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()) * lanes);
}
BENCHMARK(meet_eight_at_once);

/// Items are rays that leave the orb, each with its origin and direction in space.
void tree_one_by_one(benchmark::State &state) {
    const auto all = packets(scene_of(1.36, 64));
    TreeScratch<double> scratch;
    std::int64_t exits = 0;
    for (auto _ : state)
        for (const RayPacket &rays : all)
            for (int l = 0; l < lanes; ++l) {
                const RayOf<double> ray{rays.origin.at(l), rays.direction.at(l)};
                Entry<double> entry;
                if (!intersect(shell, ray, entry)) continue;
                trace_orb(
                    shell, ray, entry, TreeEnd<double>{1e-3, 0}, scratch,
                    [&](Vec3 p, Vec3 d, double) {
                        benchmark::DoNotOptimize(p);
                        benchmark::DoNotOptimize(d);
                        ++exits;
                    },
                    [] { return 0.5; });
            }
    state.SetItemsProcessed(exits);
}
BENCHMARK(tree_one_by_one);

void tree_eight_at_once(benchmark::State &state) {
    const auto all = packets(scene_of(1.36, 64));
    PacketScratch scratch;
    EntryPacket entry;
    std::int64_t exits = 0;
    for (auto _ : state)
        for (const RayPacket &rays : all) {
            intersect(shell, rays, entry);
            if (!trace_packet(shell, rays, entry, entry.hits, 1e-3, 0, scratch)) continue;
            benchmark::DoNotOptimize(scratch.exits.data());
            exits += static_cast<std::int64_t>(scratch.count) * std::popcount(entry.hits);
        }
    state.SetItemsProcessed(exits);
}
BENCHMARK(tree_eight_at_once);

#ifdef THREEFOLD_BENCH_EMBREE
/// The camera's rays, asked of bare Embree: two spheres and a rectangle of its own, in single precision.
class EmbreeOrb {
public:
    EmbreeOrb() : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
        for (const float radius : {67.98f, 66.62f}) {
            RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
            auto *v = static_cast<float *>(
                rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 1));
            v[0] = v[1] = v[2] = 0;
            v[3] = radius;
            attach(g);
        }
        RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_QUAD);
        auto *v = static_cast<float *>(
            rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 4));
        const float corners[] = {-200, -200, -250, 200, -200, -250, 200, 200, -250, -200, 200, -250};
        std::copy(std::begin(corners), std::end(corners), v);
        auto *i = static_cast<unsigned *>(
            rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), 1));
        for (unsigned k = 0; k < 4; ++k) i[k] = k;
        attach(g);
        rtcCommitScene(scene_);
    }
    ~EmbreeOrb() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    EmbreeOrb(const EmbreeOrb &) = delete;
    EmbreeOrb &operator=(const EmbreeOrb &) = delete;
    RTCScene get() const { return scene_; }

private:
    void attach(RTCGeometry g) {
        rtcCommitGeometry(g);
        rtcAttachGeometry(scene_, g);
        rtcReleaseGeometry(g);
    }
    RTCDevice device_;
    RTCScene scene_;
};

void put(RTCRayHit8 &r, const LaneVectors &o, const LaneVectors &d, int l) {
    r.ray.org_x[l] = static_cast<float>(o.x[l]);
    r.ray.org_y[l] = static_cast<float>(o.y[l]);
    r.ray.org_z[l] = static_cast<float>(o.z[l]);
    r.ray.dir_x[l] = static_cast<float>(d.x[l]);
    r.ray.dir_y[l] = static_cast<float>(d.y[l]);
    r.ray.dir_z[l] = static_cast<float>(d.z[l]);
    r.ray.tnear[l] = 1e-2f;
    r.ray.tfar[l] = 1e9f;
    r.ray.mask[l] = ~0u;
    r.ray.time[l] = 0;
    r.ray.flags[l] = 0;
    r.hit.geomID[l] = RTC_INVALID_GEOMETRY_ID;
}

void embree_one_by_one(benchmark::State &state) {
    const EmbreeOrb orb;
    const auto all = packets(scene_of(1.36, 64));
    for (auto _ : state)
        for (const RayPacket &rays : all)
            for (int l = 0; l < lanes; ++l) {
                RTCRayHit8 eight;
                put(eight, rays.origin, rays.direction, l);
                RTCRayHit r{};
                r.ray.org_x = eight.ray.org_x[l];
                r.ray.org_y = eight.ray.org_y[l];
                r.ray.org_z = eight.ray.org_z[l];
                r.ray.dir_x = eight.ray.dir_x[l];
                r.ray.dir_y = eight.ray.dir_y[l];
                r.ray.dir_z = eight.ray.dir_z[l];
                r.ray.tfar = 1e9f;
                r.ray.mask = ~0u;
                r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
                RTCIntersectContext context;
                rtcInitIntersectContext(&context);
                rtcIntersect1(orb.get(), &context, &r);
                benchmark::DoNotOptimize(r);
            }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()) * lanes);
}
BENCHMARK(embree_one_by_one);

void embree_eight_at_once(benchmark::State &state) {
    const EmbreeOrb orb;
    const auto all = packets(scene_of(1.36, 64));
    alignas(32) int valid[8];
    std::fill(std::begin(valid), std::end(valid), -1);
    for (auto _ : state)
        for (const RayPacket &rays : all) {
            alignas(32) RTCRayHit8 eight;
            for (int l = 0; l < lanes; ++l) put(eight, rays.origin, rays.direction, l);
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
            rtcIntersect8(valid, orb.get(), &context, &eight);
            benchmark::DoNotOptimize(eight);
        }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()) * lanes);
}
BENCHMARK(embree_eight_at_once);
#endif

/// Items are samples; linear in pixels if the rate stays.
void whole_picture(benchmark::State &state) {
    RenderJob job;
    job.scene = scene_of(1.36, static_cast<int>(state.range(0)));
    job.samples_per_pixel = static_cast<int>(state.range(1));
    job.cut_weight = 1e-2;
    job.threads = 1;
    for (auto _ : state) benchmark::DoNotOptimize(trace(job).images);
    state.SetItemsProcessed(state.iterations() * state.range(0) * state.range(0) * state.range(1));
}
BENCHMARK(whole_picture)
    ->Unit(benchmark::kMillisecond)
    ->Args({64, 16})
    ->Args({256, 16})
    ->Args({512, 16})
    ->Args({1024, 16})
    ->Args({256, 8})
    ->Args({256, 64});

} // namespace
} // namespace threefold

BENCHMARK_MAIN();
