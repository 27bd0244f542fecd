// SPDX-License-Identifier: MIT
// Our tracer against bare Embree calls on scenes with meshes: the very same rays, in the same order and packets, one
// thread. Ours counts everything that the tracer does for a picture but building the scene: camera, glass, shading,
// double precision. Items are rays that ask for surfaces; segments inside glass are not counted on either side.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <bit>
#include <map>

#include "scenes/catalogue/catalogue.h"
#include "scenes/validate.h"
#include "tests/bench/embree_scene.h"
#include "verifier/tracer/pixel.h"
#include "verifier/tracer/tracer.h"

namespace threefold {
namespace {

using namespace tracer;

constexpr std::array scene_names{"salvator", "setup", "folds"};

RenderJob job_of(std::string_view name) {
    const auto scenes = built_in_scenes();
    const SceneRecipe &recipe = find_scene(scenes, name);
    Parameters values(recipe.parameters, Preset::text);
    RenderJob job;
    job.scene = recipe.make(values);
    validate(job.scene);
    // About as many pixels for each.
    Camera &camera = job.scene.camera;
    const double shrink = std::sqrt(20000.0 / (static_cast<double>(camera.width_px) * camera.height_px));
    camera.width_px = static_cast<int>(camera.width_px * shrink);
    camera.height_px = static_cast<int>(camera.height_px * shrink);
    job.samples_per_pixel = 16;
    job.cut_weight = 1e-2;
    return job;
}

/// A scene, ready to be rendered, and all rays that its picture asks for.
struct Prepared {
    RenderJob job;
    World<double> world{job.scene, job.slip, TreeEnd<double>{job.cut_weight, 0}, job.samples_per_pixel};
    std::vector<CastRays> rays;
    std::int64_t count = 0;

    explicit Prepared(std::string_view name) : job(job_of(name)) {
        render(&rays);
        for (const CastRays &r : rays) count += std::popcount(r.active);
    }

    std::vector<Rgb> render(std::vector<CastRays> *log) const {
        const Camera &camera = job.scene.camera;
        const std::size_t n =
            static_cast<std::size_t>(camera.image_width_px()) * static_cast<std::size_t>(camera.image_height_px());
        std::vector<Rgb> pixels(n, Rgb(0));
        std::vector<double> missing(n);
        PixelScratch<double> scratch;
        scratch.log = log;
        const PixelRenderer<double> pixel(world, job, job.replicates[0]);
        for (int tile = 0; tile < tiles_of(camera); ++tile) render_tile(pixel, camera, tile, scratch, pixels, missing);
        return pixels;
    }
};

const Prepared &prepared(std::int64_t scene) {
    static std::map<std::int64_t, std::unique_ptr<Prepared>> all;
    auto &one = all[scene];
    if (!one) one = std::make_unique<Prepared>(scene_names[static_cast<std::size_t>(scene)]);
    return *one;
}

/// All of the scene as Embree's own primitives, with nothing else asked of it.
class BareWorld : public EmbreeScene {
public:
    explicit BareWorld(const Scene &scene) {
        for (const Object &object : scene.objects)
            std::visit(overloaded{
                           [&](const GlassBall &b) { sphere(b.centre_mm, b.radius_mm); },
                           [&](const GlassShell &s) {
                               sphere(s.centre_mm, s.outer_radius_mm);
                               sphere(s.centre_mm, s.inner_radius_mm());
                           },
                           [&](const Quad &q) {
                               const std::array<Vec3, 4> corners{
                                   q.centre_mm - q.half_u_mm - q.half_v_mm, q.centre_mm + q.half_u_mm - q.half_v_mm,
                                   q.centre_mm + q.half_u_mm + q.half_v_mm, q.centre_mm - q.half_u_mm + q.half_v_mm};
                               triangles(std::vector<Vec3>(corners.begin(), corners.end()), {{0, 1, 2}, {0, 2, 3}});
                           },
                           [&](const Mesh &m) { triangles(m.vertices_mm, m.triangles); },
                       },
                       object.shape);
        commit();
    }

private:
    void sphere(Vec3 centre, double radius) {
        RTCGeometry g = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
        auto *v = static_cast<float *>(
            rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, 4 * sizeof(float), 1));
        for (int k = 0; k < 3; ++k) v[k] = static_cast<float>(centre[k]);
        v[3] = static_cast<float>(radius);
        attach(g);
    }
    void triangles(const std::vector<Vec3> &vertices, const std::vector<glm::uvec3> &indices) {
        RTCGeometry g = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
        auto *v = static_cast<float *>(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                               3 * sizeof(float), vertices.size()));
        for (const Vec3 &p : vertices)
            for (int k = 0; k < 3; ++k) *v++ = static_cast<float>(p[k]);
        auto *i = static_cast<unsigned *>(rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                  3 * sizeof(unsigned), indices.size()));
        for (const glm::uvec3 &t : indices)
            for (int k = 0; k < 3; ++k) *i++ = t[k];
        attach(g);
    }
};

void ours(benchmark::State &state) {
    const Prepared &p = prepared(state.range(0));
    for (auto _ : state) benchmark::DoNotOptimize(p.render(nullptr));
    state.SetItemsProcessed(state.iterations() * p.count);
    std::size_t shadows = 0;
    for (const CastRays &r : p.rays) shadows += static_cast<std::size_t>(r.shadow ? std::popcount(r.active) : 0);
    state.counters["rays"] = static_cast<double>(p.count);
    state.counters["shadow_share"] = static_cast<double>(shadows) / static_cast<double>(p.count);
    state.counters["lanes_filled"] = static_cast<double>(p.count) / (8 * static_cast<double>(p.rays.size()));
}

/// Embree's calls change their rays: these are made ready outside the time that counts, and copied inside it.
std::vector<RTCRayHit> single_rays(const Prepared &p) {
    std::vector<RTCRayHit> ready;
    for (const CastRays &c : p.rays)
        for (std::uint32_t bits = c.active; bits; bits &= bits - 1) {
            const int l = std::countr_zero(bits);
            RTCRayHit r{};
            r.ray.org_x = static_cast<float>(c.rays.origin.x[l]);
            r.ray.org_y = static_cast<float>(c.rays.origin.y[l]);
            r.ray.org_z = static_cast<float>(c.rays.origin.z[l]);
            r.ray.dir_x = static_cast<float>(c.rays.direction.x[l]);
            r.ray.dir_y = static_cast<float>(c.rays.direction.y[l]);
            r.ray.dir_z = static_cast<float>(c.rays.direction.z[l]);
            r.ray.tnear = 1e-2f;
            r.ray.tfar = 1e9f;
            r.ray.mask = ~0u;
            r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
            ready.push_back(r);
        }
    return ready;
}

void bare_single(benchmark::State &state) {
    const Prepared &p = prepared(state.range(0));
    const BareWorld world(p.job.scene);
    const auto ready = single_rays(p);
    for (auto _ : state)
        for (const RTCRayHit &ray : ready) {
            RTCRayHit r = ray;
            EmbreeQuery().one(world.get(), r);
            benchmark::DoNotOptimize(r);
        }
    state.SetItemsProcessed(state.iterations() * p.count);
}

#ifdef THREEFOLD_BENCH_STREAMS
template <bool coherent>
void bare_stream(benchmark::State &state) {
    const Prepared &p = prepared(state.range(0));
    const BareWorld world(p.job.scene);
    const auto ready = single_rays(p);
    constexpr std::size_t stream = 256;
    std::vector<RTCRayHit> now(stream);
    for (auto _ : state)
        for (std::size_t first = 0; first < ready.size(); first += stream) {
            const std::size_t n = std::min(stream, ready.size() - first);
            std::copy_n(ready.begin() + static_cast<std::ptrdiff_t>(first), n, now.begin());
            EmbreeQuery(coherent).stream(world.get(), now.data(), n);
            benchmark::DoNotOptimize(now.data());
        }
    state.SetItemsProcessed(state.iterations() * p.count);
}

#endif

/// Full packets: the rays one after another, without the empty places that ours have.
template <class Hit, std::size_t width, auto shoot, bool coherent>
void bare_packet(benchmark::State &state) {
    const Prepared &p = prepared(state.range(0));
    const BareWorld world(p.job.scene);
    auto rays = single_rays(p);
    alignas(64) int valid[16];
    std::fill(std::begin(valid), std::end(valid), -1);
    while (rays.size() % width != 0) rays.push_back(rays.back());
    std::vector<Hit> ready(rays.size() / width);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        Hit &r = ready[i / width];
        const std::size_t l = i % width;
        const RTCRayHit &one = rays[i];
        r.ray.org_x[l] = one.ray.org_x;
        r.ray.org_y[l] = one.ray.org_y;
        r.ray.org_z[l] = one.ray.org_z;
        r.ray.dir_x[l] = one.ray.dir_x;
        r.ray.dir_y[l] = one.ray.dir_y;
        r.ray.dir_z[l] = one.ray.dir_z;
        r.ray.tnear[l] = one.ray.tnear;
        r.ray.tfar[l] = one.ray.tfar;
        r.ray.time[l] = 0;
        r.ray.flags[l] = 0;
        r.ray.mask[l] = ~0u;
        r.hit.geomID[l] = r.hit.instID[0][l] = RTC_INVALID_GEOMETRY_ID;
    }
    for (auto _ : state)
        for (const Hit &hit : ready) {
            Hit r = hit;
            EmbreeQuery(coherent).packet<shoot>(valid, world.get(), r);
            benchmark::DoNotOptimize(r);
        }
    state.SetItemsProcessed(state.iterations() * p.count);
}

/// A hilly net of about so many triangles behind the orb, lit from aside: how the cost grows with a mesh.
Scene hills(double triangles) {
    const auto side = static_cast<unsigned>(std::lround(std::sqrt(triangles / 2))) + 1;
    Mesh mesh;
    for (unsigned row = 0; row < side; ++row)
        for (unsigned column = 0; column < side; ++column) {
            const double x = 2.0 * column / (side - 1) - 1, y = 2.0 * row / (side - 1) - 1;
            mesh.vertices_mm.emplace_back(150 * x, 150 * y, -250 + 12 * std::sin(9 * x + 2 * y) * std::cos(7 * y - x));
        }
    for (unsigned row = 0; row + 1 < side; ++row)
        for (unsigned column = 0; column + 1 < side; ++column) {
            const unsigned a = row * side + column, b = a + 1, c = a + side, d = c + 1;
            mesh.triangles.emplace_back(a, b, d);
            mesh.triangles.emplace_back(a, d, c);
        }
    mesh.surface = Diffuse{Rgb(0.5)};
    Scene scene;
    scene.objects = {{"orb", GlassShell{}}, {"hills", std::move(mesh)}};
    scene.lights = {{Vec3(-1, -1, -0.5), Rgb(1)}, {Vec3(0.3, -1, -1), Rgb(1)}};
    scene.camera.horizontal_fov_deg = 18;
    return scene;
}

void mesh_of(benchmark::State &state) {
    RenderJob job;
    job.scene = hills(static_cast<double>(state.range(0)));
    job.samples_per_pixel = 8;
    job.cut_weight = 1e-2;
    job.threads = 1;
    double set_up = 0, all = 0;
    for (auto _ : state) {
        const TracerOutcome outcome = trace(job);
        set_up += outcome.set_up_cpu_seconds;
        all += outcome.cpu_seconds;
    }
    const auto n = static_cast<double>(state.iterations());
    state.counters["render_ms"] = 1e3 * (all - set_up) / n;
    state.counters["set_up_ms"] = 1e3 * set_up / n;
    state.counters["triangles"] = static_cast<double>(std::get<Mesh>(job.scene.objects[1].shape).triangles.size());
}
BENCHMARK(mesh_of)->Unit(benchmark::kMillisecond)->Arg(1000)->Arg(10000)->Arg(100000)->Arg(1000000);

const int registered = [] {
    const auto add = [](const char *name, auto *function, std::size_t scene) {
        benchmark::RegisterBenchmark((std::string("figure/") + scene_names[scene] + "/" + name).c_str(), function)
            ->Arg(static_cast<std::int64_t>(scene))
            ->Unit(benchmark::kMillisecond);
    };
    for (std::size_t scene = 0; scene < scene_names.size(); ++scene) {
        add("ours", ours, scene);
        add("bare_single", bare_single, scene);
#ifdef THREEFOLD_BENCH_STREAMS
        add("bare_stream", bare_stream<false>, scene);
        add("bare_stream_coherent", bare_stream<true>, scene);
#endif
        add("bare_four", bare_packet<RTCRayHit4, 4, rtcIntersect4, false>, scene);
        add("bare_four_coherent", bare_packet<RTCRayHit4, 4, rtcIntersect4, true>, scene);
        add("bare_eight", bare_packet<RTCRayHit8, 8, rtcIntersect8, false>, scene);
        add("bare_eight_coherent", bare_packet<RTCRayHit8, 8, rtcIntersect8, true>, scene);
        add("bare_sixteen_coherent", bare_packet<RTCRayHit16, 16, rtcIntersect16, true>, scene);
    }
    return 0;
}();

} // namespace
} // namespace threefold
