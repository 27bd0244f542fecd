// SPDX-License-Identifier: MIT
// Each fault changes what it says and nothing else.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

#include "exporter/adapter.h"
#include "exporter/scene_json.h"
#include "scenes/access.h"
#include "scenes/error.h"
#include "tests/quick_request.h"
#include "tests/temporary_folder.h"
#include "verifier/check/plan.h"
#include "verifier/claims/fault.h"
#include "verifier/tracer/tracer.h"

namespace threefold {
namespace {

Texture grey_ramp() {
    Texture t{4, 1, {}};
    for (const int sample : {0, 10000, 30000, 60000})
        for (int k = 0; k < 3; ++k) t.rgb.push_back(static_cast<std::uint16_t>(sample));
    return t;
}

/// A shell before an emissive card, and a lit one; a small film.
Scene room() {
    Scene scene;
    Glass glass;
    glass.interface_transmittance = 0.8;
    const auto ramp = std::make_shared<const Texture>(grey_ramp());
    scene.objects = {{"orb", GlassShell{{0, 0, 0}, 68, 2, glass}},
                     {"card", Quad{{0, 0, -250}, {300, 0, 0}, {0, 300, 0}, Emissive{ramp}}},
                     {"patch", Quad{{0, 200, -240}, {10, 0, 0}, {0, 10, 0}, Emissive{Rgb(0.5)}}},
                     {"floor", Quad{{0, -100, 0}, {10, 0, 0}, {0, 0, 10}, Diffuse{Rgb(0.4)}}}};
    scene.environment = Environment{Rgb(0.25), 12};
    scene.camera.width_px = scene.camera.height_px = 16;
    return scene;
}

/// The scene with the one thing changed that the fault says.
Scene expected(const InjectedFault &injected) {
    Scene scene = room();
    auto &shell = std::get<GlassShell>(scene.objects.front().shape);
    auto &paint = std::get<Emissive>(std::get<Quad>(scene.objects[1].shape).surface).radiance;
    const auto repaint = [&](std::vector<int> samples) {
        Texture t{4, 1, {}};
        for (const int sample : samples)
            for (int k = 0; k < 3; ++k) t.rgb.push_back(static_cast<std::uint16_t>(sample));
        paint = std::make_shared<const Texture>(t);
    };
    switch (injected.fault) {
    case Fault::index_one_percent:
        shell.glass.index = 1.51714 * 1.01;
        break;
    case Fault::wall_ten_percent:
        shell.wall_mm = 2.2;
        break;
    case Fault::wall_doubled:
        shell.wall_mm = 4;
        break;
    case Fault::inner_surface_missing:
        scene.objects.front().shape = GlassBall{{0, 0, 0}, 68, shell.glass};
        break;
    case Fault::gamma_slip:
        repaint({0, 1048, 11746, 53972}); // 65535 * (s / 65535)^2.2
        break;
    case Fault::camera_half_pixel:
        scene.camera.film_offset_px = {0.5, 0};
        break;
    case Fault::camera_one_pixel:
        scene.camera.film_offset_px = {1, 0};
        break;
    case Fault::texture_mirrored:
        repaint({60000, 30000, 10000, 0});
        break;
    case Fault::orb_one_millimetre:
        shell.centre_mm = {1, 0, 0};
        break;
    case Fault::radiance_slip:
        repaint({0, 10100, 30300, 60600});
        std::get<Emissive>(std::get<Quad>(scene.objects[2].shape).surface).radiance = Rgb(0.505);
        scene.environment->radiance = Rgb(0.2525);
        break;
    case Fault::inner_normal_flipped:
    case Fault::four_bounces:
    case Fault::light_missing: // none here
    case Fault::tint_forgotten:
        break;
    }
    return scene;
}

TEST(Fault, ChangesWhatItSaysAndNothingElse) {
    for (const FaultEntry &entry : faults())
        EXPECT_EQ(to_json(with_fault(room(), entry.fault)), to_json(expected(entry.fault))) << entry.name;
}

/// What may stand at the end of the path of a value that the fault changes in the scene's JSON.
std::string changed_by(Fault fault) {
    switch (fault) {
    case Fault::index_one_percent:
        return "/glass/index";
    case Fault::wall_ten_percent:
    case Fault::wall_doubled:
        return "/shell/wall_mm";
    case Fault::inner_surface_missing:
        return "/shape/(shell|ball)";
    case Fault::gamma_slip:
    case Fault::texture_mirrored:
        return "/(emissive|diffuse)/hash";
    case Fault::camera_half_pixel:
    case Fault::camera_one_pixel:
        return "/camera/film_offset_px/0";
    case Fault::light_missing:
        return "/lights/[0-9]+/irradiance/[0-9]";
    case Fault::orb_one_millimetre:
        return "/(shell|ball)/centre_mm/0";
    case Fault::radiance_slip:
        return "/lights/[0-9]+/irradiance/[0-9]|/environment/[0-9]|/emissive/(hash|[0-9])";
    case Fault::inner_normal_flipped:
    case Fault::four_bounces:
    case Fault::tint_forgotten:
        return "nothing";
    }
    return "";
}

/// Has the scene something that the fault changes?
bool concerns(Fault fault, const Scene &scene) {
    const auto some_object = [&](auto has) { return std::ranges::any_of(scene.objects, has); };
    const auto has_glass = [](const Object &o) { return glass_of(o.shape) != nullptr; };
    const auto is_shell = [](const Object &o) { return std::holds_alternative<GlassShell>(o.shape); };
    const auto shines = [](const Rgb &radiance) { return radiance != Rgb(0); };
    const auto texture_of = [](const Object &o) -> const Texture * {
        const Surface *surface = surface_of(o.shape);
        const Diffuse *d = surface ? std::get_if<Diffuse>(surface) : nullptr;
        const Emissive *e = surface ? std::get_if<Emissive>(surface) : nullptr;
        const Paint *paint = d ? &d->reflectance : e ? &e->radiance : nullptr;
        const auto *texture = paint ? std::get_if<std::shared_ptr<const Texture>>(paint) : nullptr;
        return texture ? texture->get() : nullptr;
    };
    switch (fault) {
    case Fault::index_one_percent:
    case Fault::orb_one_millimetre:
        return some_object(has_glass);
    case Fault::wall_ten_percent:
    case Fault::wall_doubled:
    case Fault::inner_surface_missing:
        return some_object(is_shell);
    case Fault::gamma_slip: // black and white stay what they are
        return some_object([&](const Object &o) {
            const Texture *t = texture_of(o);
            return t && std::ranges::any_of(t->rgb, [](int sample) { return sample > 100 && sample < 65400; });
        });
    case Fault::texture_mirrored:
        return some_object([&](const Object &o) {
            const Texture *t = texture_of(o);
            bool symmetric = true;
            for (int i = 0; t && i < t->width * t->height; ++i)
                for (int k = 0; k < 3; ++k) {
                    const int across = i / t->width * t->width + t->width - 1 - i % t->width;
                    symmetric = symmetric && t->rgb[static_cast<std::size_t>(3 * i + k)] ==
                                                 t->rgb[static_cast<std::size_t>(3 * across + k)];
                }
            return t && !symmetric;
        });
    case Fault::camera_half_pixel:
    case Fault::camera_one_pixel:
        return true;
    case Fault::light_missing:
        return !scene.lights.empty();
    case Fault::radiance_slip:
        return !scene.lights.empty() || (scene.environment && shines(scene.environment->radiance)) ||
               some_object([&](const Object &o) {
                   const Surface *surface = surface_of(o.shape);
                   const Emissive *e = surface ? std::get_if<Emissive>(surface) : nullptr;
                   const Rgb *radiance = e ? std::get_if<Rgb>(&e->radiance) : nullptr;
                   const Texture *t = texture_of(o);
                   return (radiance && shines(*radiance)) ||
                          (e && t && std::ranges::any_of(t->rgb, [](int s) { return s > 100 && s < 65535; }));
               });
    case Fault::inner_normal_flipped:
    case Fault::four_bounces:
    case Fault::tint_forgotten:
        return false;
    }
    return false;
}

TEST(Fault, ChangesTheSceneOfEveryClaimThatItConcernsAndInTheRightThingOnly) {
    const TemporaryFolder folder;
    CheckRequest request = quick_request<CheckRequest>(folder.path(), {});
    request.claims = built_in_claims();
    for (const PlannedJob &planned : planned_jobs(request)) {
        const nlohmann::json honest = to_json(planned.job.scene);
        for (const FaultEntry &entry : faults()) {
            const nlohmann::json changes =
                nlohmann::json::diff(honest, to_json(with_fault(planned.job, entry.fault).scene));
            EXPECT_EQ(!changes.empty(), concerns(entry.fault, planned.job.scene))
                << planned.claim << " " << planned.label << " " << entry.name;
            for (const auto &change : changes)
                EXPECT_TRUE(std::regex_search(change["path"].get<std::string>(),
                                              std::regex("(" + changed_by(entry.fault) + ")$")))
                    << planned.claim << " " << planned.label << " " << entry.name << ": " << change;
        }
    }
}

TEST(Fault, OfNoSizeChangesNothing) {
    RenderJob job;
    job.scene = room();
    for (const FaultEntry &entry : faults()) {
        if (entry.sizes != FaultEntry::Sizes::real) continue;
        const RenderJob same = with_fault(job, {entry.fault, entry.honest});
        EXPECT_EQ(to_json(same.scene), to_json(job.scene)) << entry.name;
        EXPECT_EQ(same.slip, Slip{}) << entry.name;
    }
}

TEST(Fault, OneLightGoesOutAndTheOthersStay) {
    Scene scene = room();
    scene.lights.assign(100, Directional{{0, -1, 0}, Rgb(0.01)});
    const Scene faulty = with_fault(scene, Fault::light_missing);
    double sum = 0;
    for (const Directional &light : faulty.lights) sum += light.irradiance.g;
    EXPECT_NEAR(sum, 0.99, 1e-12);
    EXPECT_EQ(faulty.lights.size(), 100u);
}

TEST(Fault, NamesAndKindsAreTheirOwn) {
    std::set<std::string_view> names;
    for (const FaultEntry &entry : faults()) {
        EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
        EXPECT_EQ(parse_fault(entry.name), entry.fault);
        EXPECT_EQ(to_string(InjectedFault(entry.fault)), entry.name);
    }
    for (const char *old :
         {"index+1%", "wall-doubled", "no-inner-surface", "camera+1px", "texture-mirrored", "radiance+1%"})
        EXPECT_TRUE(names.contains(old)) << old;
}

TEST(Fault, TakesASizeAfterAnAtSign) {
    const InjectedFault thin = parse_injected_fault("wall+10%@0.02");
    EXPECT_EQ(thin.fault, Fault::wall_ten_percent);
    EXPECT_EQ(thin.size, 0.02);
    EXPECT_EQ(to_string(thin), "wall+10%@0.02");
    EXPECT_EQ(parse_injected_fault("bounces-4").size, 4);
    for (const char *bad : {"wall+10%@", "wall+10%@much", "wall+10%@-1", "wall+10%@nan", "wall+10%@0.1x",
                            "texture-mirrored@1", "bounces-4@4.5", "bounces-4@0", "light-missing@2", "wal+10%@0.1"})
        EXPECT_THROW(parse_injected_fault(bad), Error) << bad;
}

/// Radiance of uniform surroundings of 1 through the orb's middle, by the tracer.
double through_the_middle(const InjectedFault *injected, double transmittance, Coating coating) {
    Scene scene;
    Glass glass;
    glass.interface_transmittance = transmittance;
    glass.coating = coating;
    scene.objects = {{"orb", GlassShell{{0, 0, 0}, 68, 2, glass}}};
    scene.environment = Environment{Rgb(1)};
    scene.camera.width_px = scene.camera.height_px = 1;
    scene.camera.horizontal_fov_deg = 0.01;
    RenderJob job;
    job.scene = scene;
    job.sampling = Sampling::pixel_centres;
    job.cut_weight = 1e-12;
    return trace(injected ? with_fault(job, *injected) : job).images.front().at(0, 0).g;
}

TEST(Slip, ForgottenTintAtTheInnerSurfaceLeavesTwoCrossingsOfFour) {
    const InjectedFault whole(Fault::tint_forgotten), half(Fault::tint_forgotten, 0.5);
    EXPECT_NEAR(through_the_middle(nullptr, 0.8, Coating::antireflective), std::pow(0.8, 4), 1e-12);
    EXPECT_NEAR(through_the_middle(&whole, 0.8, Coating::antireflective), std::pow(0.8, 2), 1e-12);
    EXPECT_NEAR(through_the_middle(&half, 0.8, Coating::antireflective), std::pow(0.8, 3), 1e-12);
}

TEST(Slip, FourSurfacesLeaveTheStraightPathAndTheFirstReflections) {
    const InjectedFault four(Fault::four_bounces), three(Fault::four_bounces, 3);
    const double r = std::pow(0.51714 / 2.51714, 2), t = 1 - r; // at normal incidence, every surface
    // One surface: r. Two, by the inner one: t r t, met at the third. Four: t^4 straight through. Reflected at the
    // far inner surface: six. From the third on, what rang in the front wall: t r r r t needs five.
    EXPECT_NEAR(through_the_middle(&four, 1, Coating::fresnel), r + t * r * t + std::pow(t, 4), 1e-6);
    EXPECT_NEAR(through_the_middle(&three, 1, Coating::fresnel), r + t * r * t, 1e-6);
    EXPECT_NEAR(through_the_middle(nullptr, 1, Coating::fresnel), 1, 1e-9);
}

TEST(Slip, AFlippedInnerNormalBendsAsGlassIntoDenserGlass) {
    // Seen off the axis: the straight path meets the card where a hollow of index n^2 sends it.
    Scene scene;
    Glass glass;
    glass.coating = Coating::antireflective;
    scene.objects = {{"orb", GlassShell{{0, 0, 0}, 68, 2, glass}},
                     {"card", Quad{{0, 0, -100}, {300, 0, 0}, {0, 300, 0}, CoordinateCard{}}}};
    scene.camera.projection = Projection::orthographic;
    scene.camera.orthographic_width_mm = 2; // one pixel: 19 to 21 mm off the axis, its centre at 20
    scene.camera.eye_mm = {20, 0, 900};
    scene.camera.target_mm = {20, 0, 0};
    scene.camera.width_px = scene.camera.height_px = 1;
    RenderJob job;
    job.scene = scene;
    job.sampling = Sampling::pixel_centres;
    const Rgb seen = trace(with_fault(job, Fault::inner_normal_flipped)).images.front().at(0, 0);
    const double n = 1.51714, b = 20;
    // Deflection: refraction at four surfaces, angles from Bouguer's constant b = index * radius * sine.
    const double outer_air = std::asin(b / 68), outer_glass = std::asin(b / n / 68),
                 inner_glass = std::asin(b / n / 66), inner_dense = std::asin(b / (n * n) / 66);
    const double turned = 2 * ((outer_air - outer_glass) + (inner_glass - inner_dense)); // towards the axis
    // The ray leaves tangent to the circle of radius b, turned by `turned`.
    const double x = (b - 100 * std::sin(turned)) / std::cos(turned);
    EXPECT_NEAR(600 * (seen.r / seen.b) - 300, x, 1e-6);
}

TEST(Slip, ARendererThatCannotErrThatWayRefuses) {
    RenderJob job;
    job.scene = room();
    job.slip.inner_normal_flipped = true;
    for (const Adapter &adapter : adapters()) EXPECT_THROW(adapter.compile(job), Error) << adapter.name;
    job.slip = {};
    for (const Adapter &adapter : adapters()) EXPECT_NO_THROW(adapter.compile(job)) << adapter.name;
}

} // namespace
} // namespace threefold
