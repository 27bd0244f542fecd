// SPDX-License-Identifier: MIT
#include "verifier/tolerance/setting.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "exporter/blender/icosphere.h"
#include "scenes/access.h"
#include "scenes/validate.h"

namespace threefold {

namespace {

bool meshes_spheres(const Witness &w) { return w.name == "cycles"; }
bool counts_bounces(const Witness &w) { return w.name == "cycles"; }
bool cuts_trees(const Witness &w) { return w.name != "cycles"; }

double greatest_radius_mm(const Scene &scene) {
    double radius = 0;
    for (const Object &object : scene.objects)
        if (const auto sphere = outer_sphere(object.shape)) radius = std::max(radius, sphere->radius_mm);
    return radius;
}

/// The tolerance that gives the largest orb this level.
double surface_of_level(const Scene &scene, int level) {
    const double radius = greatest_radius_mm(scene);
    return radius > 0 ? fit_icosphere(level).distance * radius * (1 + 1e-9) : 1e-3;
}

int level_of(const Scene &scene, double surface_mm) {
    const double radius = greatest_radius_mm(scene);
    const auto fit = radius > 0 ? coarsest_icosphere(surface_mm / radius) : std::nullopt;
    return fit ? fit->level : finest_icosphere;
}

/// A thousandth of the tolerance, as a decade: a tree loses far more than the cut, for lighter branches are more. Not
/// below 1e-6, where our reference ends too.
double finest_cut(double least_tolerance, double usual) {
    const double decade = std::pow(10, std::floor(std::log10(1e-3 * least_tolerance) + 1e-9));
    return std::clamp(decade, 1e-6, usual);
}

} // namespace

bool Setting::same_system(const Setting &o) const {
    return cut_weight == o.cut_weight && surface_mm == o.surface_mm && bounces == o.bounces &&
           tracer.precision == o.tracer.precision && tracer.transport == o.tracer.transport;
}

std::string_view to_string(Knob knob) {
    switch (knob) {
    case Knob::samples:
        return "samples";
    case Knob::truncation:
        return "truncation";
    case Knob::tessellation:
        return "tessellation";
    case Knob::precision:
        return "precision";
    case Knob::transport:
        return "transport";
    }
    return "";
}

std::string describe(const Setting &s, const Witness &witness, const Scene &scene, bool with_samples) {
    const Needs needed = needs(scene);
    std::vector<std::string> parts;
    if (with_samples) {
        // As the renderer itself counts them.
        int samples =
            witness.adapter ? for_renderer(*witness.adapter, job_of(s, scene, {1}, 0)).samples_per_pixel : s.samples;
        parts.push_back(fmt::format("{} sample{}", samples, samples == 1 ? "" : "s"));
    }
    if (needed.glass && needed.ray_tree && cuts_trees(witness)) {
        if (witness.is_tracer() && s.tracer.transport == Transport::roulette)
            parts.push_back(fmt::format("roulette under {:g}", s.tracer.roulette_weight));
        else
            parts.push_back(fmt::format("cut {:g}", s.cut_weight));
    }
    if (witness.is_tracer()) parts.push_back(s.tracer.precision == Precision::single_precision ? "float" : "double");
    if (needed.glass && meshes_spheres(witness))
        parts.push_back(fmt::format("mesh level {}", level_of(scene, s.surface_mm)));
    if (needed.glass && counts_bounces(witness)) parts.push_back(fmt::format("{} bounces", s.bounces.value_or(256)));
    if (parts.empty()) parts.push_back("as it is");
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<std::string> render_options(const Setting &s, const Witness &witness) {
    std::vector<std::string> all{"--spp", fmt::format("{}", s.samples)};
    if (cuts_trees(witness)) all.insert(all.end(), {"--cut", fmt::format("{}", s.cut_weight)});
    if (witness.is_tracer())
        all.insert(all.end(), {"--precision", s.tracer.precision == Precision::single_precision ? "float" : "double",
                               "--transport", s.tracer.transport == Transport::roulette ? "roulette" : "tree"});
    if (meshes_spheres(witness)) all.insert(all.end(), {"--surface-mm", fmt::format("{}", s.surface_mm)});
    if (s.bounces) all.insert(all.end(), {"--bounces", fmt::format("{}", *s.bounces)});
    return all;
}

std::vector<Setting> systems_of(const Witness &witness, const Scene &scene) {
    const Needs needed = needs(scene);
    std::vector<Setting> all;
    if (!needed.glass) return {Setting{}};
    if (witness.is_tracer() || cuts_trees(witness)) {
        if (!needed.ray_tree) return {Setting{}};
        for (const double cut : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) all.push_back({.cut_weight = cut});
        return all;
    }
    for (const int level : {6, 7, finest_icosphere}) all.push_back({.surface_mm = surface_of_level(scene, level)});
    return all;
}

std::vector<SweepPoint> sweep_of(const Witness &witness, const Scene &scene, bool quick, double least_tolerance) {
    const Needs needed = needs(scene);
    const bool tree = needed.glass && needed.ray_tree;
    std::vector<SweepPoint> all;
    if (witness.is_tracer()) {
        const Setting middle{.samples = 16, .cut_weight = tree ? 1e-3 : 1e-6};
        if (tree) {
            all.push_back({{.samples = 16, .cut_weight = 1e-6}, Knob::truncation});
            for (const double cut : {1e-1, 3e-2, 1e-2, 1e-4, 1e-5})
                if (cut >= 1e-2 || least_tolerance <= 10 * cut)
                    all.push_back({{.samples = 16, .cut_weight = cut}, Knob::truncation});
        }
        for (const int n : {16, 1, 4, 64}) {
            all.push_back({middle, Knob::samples});
            all.back().setting.samples = n;
        }
        if (!quick) {
            all.push_back({middle, Knob::samples});
            all.back().setting.samples = 256;
        }
        all.push_back({middle, Knob::precision});
        all.back().setting.tracer.precision = Precision::single_precision;
        if (tree) {
            all.push_back({middle, Knob::transport});
            all.back().setting.tracer.transport = Transport::roulette;
        }
        return all;
    }
    if (cuts_trees(witness)) {
        // Trees grow with every decade, so the cuts are told apart at the fewest samples: what is cut off is the same.
        constexpr int few = 2;
        const Setting middle{.samples = 8, .cut_weight = tree ? 1e-3 : 1e-6};
        if (tree) {
            const double finest = finest_cut(least_tolerance, quick ? 1e-4 : 1e-5);
            for (const double cut : {1e-6, 1e-5, 1e-4, 1e-2})
                if (cut > 0.5 * finest) all.push_back({{.samples = few, .cut_weight = cut}, Knob::truncation});
        }
        for (const int n : {8, few, 32}) {
            all.push_back({middle, Knob::samples});
            all.back().setting.samples = n;
        }
        return all;
    }
    const Setting middle{.samples = 4, .surface_mm = surface_of_level(scene, 7)};
    int finest = 0;
    if (needed.glass) {
        constexpr double fine_tolerance = 3e-3;
        finest = quick && least_tolerance > fine_tolerance ? 7 : finest_icosphere;
        all.push_back({{.samples = 4, .surface_mm = surface_of_level(scene, finest)}, Knob::tessellation});
        for (const int level : quick ? std::vector{5} : std::vector{4, 5, 6})
            all.push_back({{.samples = 4, .surface_mm = surface_of_level(scene, level)}, Knob::tessellation});
        for (const int bounces : quick ? std::vector{8} : std::vector{4, 8, 32}) {
            all.push_back({middle, Knob::truncation});
            all.back().setting.bounces = bounces;
        }
    }
    for (const int n : {4, 1, 16}) {
        if (n == 4 && finest == 7) continue; // the first one is it
        all.push_back({middle, Knob::samples});
        all.back().setting.samples = n;
    }
    return all;
}

int round_up_samples(const Witness &witness, double samples) {
    constexpr double most = 1 << 24;
    const double n = std::clamp(std::ceil(samples - 1e-9), 1.0, most);
    if (witness.name != "povray") return static_cast<int>(n);
    const double side = std::max(1.0, std::ceil(std::sqrt(n / 2) - 1e-9));
    return static_cast<int>(2 * side * side);
}

RenderJob job_of(const Setting &s, const Scene &scene, std::vector<std::uint64_t> seeds, int threads) {
    RenderJob job;
    job.scene = scene;
    job.sampling = Sampling::box;
    job.samples_per_pixel = s.samples;
    job.cut_weight = s.cut_weight;
    job.surface_tolerance_mm = s.surface_mm;
    job.most_bounces = s.bounces;
    job.threads = threads;
    job.replicates.clear();
    for (const std::uint64_t seed : seeds) job.replicates.push_back({seed, {0, 0}});
    return job;
}

} // namespace threefold
