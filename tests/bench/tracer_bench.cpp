// SPDX-License-Identifier: MIT
// Speed of the tracer's parts; docs/PERFORMANCE.md says what they came to. Ratios are what counts: the same machine,
// one run. Needs Google Benchmark.
#include <benchmark/benchmark.h>

#include <bit>

#include "scenes/camera.h"
#include "tests/bench/embree_scene.h"
#include "verifier/tracer/packet.h"
#include "verifier/tracer/rectangles.h"
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

/// Items are rays that leave the orb, each with its origin and direction in space; eight at once up to where each meets
/// the card.
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
    const std::vector<Rectangle> card{Rectangle(1, std::get<Quad>(scene_of(1.36, 64).objects[1].shape))};
    RectangleHits hits;
    const auto all = packets(scene_of(1.36, 64));
    PacketScratch scratch;
    EntryPacket entry;
    std::int64_t exits = 0;
    for (auto _ : state)
        for (const RayPacket &rays : all) {
            intersect(shell, rays, entry);
            if (!trace_packet(shell, rays, entry, entry.hits, 1e-3, 0, scratch)) continue;
            for (std::size_t i = 0; i < scratch.count; ++i) {
                meet_rectangles(card, scratch.exits[i].origin, scratch.exits[i].direction, hits);
                benchmark::DoNotOptimize(hits);
            }
            exits += static_cast<std::int64_t>(scratch.count) * std::popcount(entry.hits);
        }
    state.SetItemsProcessed(exits);
}
BENCHMARK(tree_eight_at_once);

/// The rays that leave the orb, asked of bare Embree: two spheres and a rectangle of its own, in single precision.
class EmbreeOrb : public EmbreeScene {
public:
    EmbreeOrb() {
        for (const float radius : {67.98f, 66.62f}) {
            RTCGeometry g = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
            auto *v = static_cast<float *>(
                rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 1));
            v[0] = v[1] = v[2] = 0;
            v[3] = radius;
            attach(g);
        }
        RTCGeometry g = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_QUAD);
        auto *v = static_cast<float *>(
            rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 4));
        const float corners[] = {-200, -200, -250, 200, -200, -250, 200, 200, -250, -200, 200, -250};
        std::copy(std::begin(corners), std::end(corners), v);
        auto *i = static_cast<unsigned *>(
            rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned), 1));
        for (unsigned k = 0; k < 4; ++k) i[k] = k;
        attach(g);
        commit();
    }
};

/// All rays of the scene's trees beyond the camera's: those that leave the orb, eight by eight as they leave.
std::vector<RayPacket> leaving_rays() {
    std::vector<RayPacket> leaving;
    PacketScratch scratch;
    EntryPacket entry;
    for (const RayPacket &rays : packets(scene_of(1.36, 64))) {
        intersect(shell, rays, entry);
        if (entry.hits != (1u << lanes) - 1 || !trace_packet(shell, rays, entry, entry.hits, 1e-3, 0, scratch))
            continue;
        for (std::size_t i = 0; i < scratch.count; ++i)
            leaving.push_back({scratch.exits[i].origin, scratch.exits[i].direction});
    }
    return leaving;
}

template <class Hit>
void put(Hit &r, const RayPacket &rays, int from, int to) {
    r.ray.org_x[to] = static_cast<float>(rays.origin.x[from]);
    r.ray.org_y[to] = static_cast<float>(rays.origin.y[from]);
    r.ray.org_z[to] = static_cast<float>(rays.origin.z[from]);
    r.ray.dir_x[to] = static_cast<float>(rays.direction.x[from]);
    r.ray.dir_y[to] = static_cast<float>(rays.direction.y[from]);
    r.ray.dir_z[to] = static_cast<float>(rays.direction.z[from]);
    r.ray.tnear[to] = 1e-2f;
    r.ray.tfar[to] = 1e9f;
    r.ray.mask[to] = ~0u;
    r.ray.time[to] = 0;
    r.ray.flags[to] = 0;
    r.hit.geomID[to] = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0][to] = RTC_INVALID_GEOMETRY_ID;
}

RTCRayHit single(const RayPacket &rays, int l) {
    RTCRayHit r{};
    r.ray.org_x = static_cast<float>(rays.origin.x[l]);
    r.ray.org_y = static_cast<float>(rays.origin.y[l]);
    r.ray.org_z = static_cast<float>(rays.origin.z[l]);
    r.ray.dir_x = static_cast<float>(rays.direction.x[l]);
    r.ray.dir_y = static_cast<float>(rays.direction.y[l]);
    r.ray.dir_z = static_cast<float>(rays.direction.z[l]);
    r.ray.tnear = 1e-2f;
    r.ray.tfar = 1e9f;
    r.ray.mask = ~0u;
    r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    return r;
}

/// Embree's calls change their rays: these are made ready outside the time that counts, and copied inside it.
void embree_one_by_one(benchmark::State &state) {
    const EmbreeOrb orb;
    std::vector<RTCRayHit> ready;
    for (const RayPacket &rays : leaving_rays())
        for (int l = 0; l < lanes; ++l) ready.push_back(single(rays, l));
    for (auto _ : state)
        for (const RTCRayHit &ray : ready) {
            RTCRayHit r = ray;
            EmbreeQuery().one(orb.get(), r);
            benchmark::DoNotOptimize(r);
        }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ready.size()));
}
BENCHMARK(embree_one_by_one);

#ifdef THREEFOLD_BENCH_STREAMS
void embree_stream(benchmark::State &state) {
    const EmbreeOrb orb;
    std::vector<RTCRayHit> ready, now;
    for (const RayPacket &rays : leaving_rays())
        for (int l = 0; l < lanes; ++l) ready.push_back(single(rays, l));
    constexpr std::size_t stream = 128;
    ready.resize(ready.size() / stream * stream);
    now.resize(stream);
    for (auto _ : state)
        for (std::size_t first = 0; first < ready.size(); first += stream) {
            std::copy_n(ready.begin() + static_cast<std::ptrdiff_t>(first), stream, now.begin());
            EmbreeQuery(true).stream(orb.get(), now.data(), stream);
            benchmark::DoNotOptimize(now.data());
        }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ready.size()));
}
BENCHMARK(embree_stream);
#endif

template <class Hit, int width, auto shoot>
void embree_packet(benchmark::State &state) {
    const EmbreeOrb orb;
    alignas(64) int valid[16];
    std::fill(std::begin(valid), std::end(valid), -1);
    const auto leaving = leaving_rays();
    std::vector<Hit> ready(leaving.size() * lanes / width);
    for (std::size_t i = 0; i < ready.size() * width; ++i)
        put(ready[i / width], leaving[i / lanes], static_cast<int>(i % lanes), static_cast<int>(i % width));
    for (auto _ : state)
        for (const Hit &rays : ready) {
            Hit r = rays;
            EmbreeQuery(true).packet<shoot>(valid, orb.get(), r);
            benchmark::DoNotOptimize(r);
        }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ready.size()) * width);
}
BENCHMARK(embree_packet<RTCRayHit4, 4, rtcIntersect4>)->Name("embree_four_at_once");
BENCHMARK(embree_packet<RTCRayHit8, 8, rtcIntersect8>)->Name("embree_eight_at_once");
BENCHMARK(embree_packet<RTCRayHit16, 16, rtcIntersect16>)->Name("embree_sixteen_at_once");

/// Items are samples; linear in pixels and samples if the rate stays. Pixels beside the orb take four times the
/// samples: their number, like the others', is in proportion to the pixels, so the items need not know.
void whole_picture(benchmark::State &state) {
    RenderJob job;
    job.scene = scene_of(1.36, static_cast<int>(state.range(0)));
    job.samples_per_pixel = static_cast<int>(state.range(1));
    job.cut_weight = 1e-2;
    job.threads = 1;
    double set_up = 0, all = 0;
    for (auto _ : state) {
        const TracerOutcome outcome = trace(job);
        benchmark::DoNotOptimize(outcome.images.data());
        set_up += outcome.set_up_cpu_seconds;
        all += outcome.cpu_seconds;
    }
    const auto samples = static_cast<double>(state.iterations() * state.range(0) * state.range(0) * state.range(1));
    state.counters["ns_a_sample"] = 1e9 * all / samples;
    state.counters["ns_without_set_up"] = 1e9 * (all - set_up) / samples;
    state.counters["set_up_ms"] = 1e3 * set_up / static_cast<double>(state.iterations());
}
BENCHMARK(whole_picture)
    ->Unit(benchmark::kMillisecond)
    ->Args({64, 16})
    ->Args({128, 16})
    ->Args({256, 16})
    ->Args({512, 16})
    ->Args({1024, 16})
    ->Args({256, 8})
    ->Args({256, 64})
    ->Args({256, 256});

} // namespace
} // namespace threefold

BENCHMARK_MAIN();
