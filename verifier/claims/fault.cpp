// SPDX-License-Identifier: MIT
#include "verifier/claims/fault.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scenes/access.h"
#include "scenes/error.h"
#include "scenes/parameters.h"

namespace threefold {

namespace {

Paint *paint_of(Surface &surface) {
    using Result = Paint *;
    return std::visit(overloaded{
                          [](Diffuse &d) { return &d.reflectance; },
                          [](Emissive &e) { return &e.radiance; },
                          [](CoordinateCard &) { return Result(nullptr); },
                      },
                      surface);
}

Texture mirrored(const Texture &texture) {
    Texture result = texture;
    for (int row = 0; row < texture.height; ++row) {
        const auto begin = texture.rgb.begin() + static_cast<std::ptrdiff_t>(row) * texture.width * 3;
        const auto to = result.rgb.begin() + static_cast<std::ptrdiff_t>(row) * texture.width * 3;
        for (int column = 0; column < texture.width; ++column)
            std::copy_n(begin + static_cast<std::ptrdiff_t>(texture.width - 1 - column) * 3, 3,
                        to + static_cast<std::ptrdiff_t>(column) * 3);
    }
    return result;
}

template <class Change>
Texture with_samples(const Texture &texture, Change change) {
    Texture result = texture;
    for (std::uint16_t &sample : result.rgb)
        sample = static_cast<std::uint16_t>(std::clamp(change(sample / 65535.0), 0.0, 1.0) * 65535 + 0.5);
    return result;
}

template <class OnTexture>
void change_images(Scene &scene, OnTexture change) {
    for (Object &object : scene.objects)
        if (Surface *surface = surface_of(object.shape))
            if (Paint *paint = paint_of(*surface))
                if (auto *texture = std::get_if<std::shared_ptr<const Texture>>(paint))
                    *texture = std::make_shared<const Texture>(change(**texture));
}

/// Radiance only: what a surface reflects is no light of its own. A texel stays below 1, all that it can say.
void change_emitters(Scene &scene, double factor) {
    for (Object &object : scene.objects) {
        Surface *surface = surface_of(object.shape);
        Emissive *emitter = surface ? std::get_if<Emissive>(surface) : nullptr;
        if (!emitter) continue;
        std::visit(overloaded{
                       [factor](Rgb &radiance) { radiance *= factor; },
                       [factor](std::shared_ptr<const Texture> &texture) {
                           texture = std::make_shared<const Texture>(
                               with_samples(*texture, [factor](double x) { return x * factor; }));
                       },
                   },
                   emitter->radiance);
    }
}

template <class Change>
void change_shells(Scene &scene, Change change) {
    for (Object &object : scene.objects)
        if (auto *shell = std::get_if<GlassShell>(&object.shape)) change(object, *shell);
}

void move_orbs(Scene &scene, Vec3 by_mm) {
    for (Object &object : scene.objects)
        std::visit(overloaded{
                       [by_mm](GlassBall &ball) { ball.centre_mm += by_mm; },
                       [by_mm](GlassShell &shell) { shell.centre_mm += by_mm; },
                       [](Quad &) {},
                       [](Mesh &) {},
                   },
                   object.shape);
}

} // namespace

const std::vector<FaultEntry> &faults() {
    using enum Fault;
    using enum FaultEntry::Sizes;
    static const std::vector<FaultEntry> all{
        {index_one_percent, "index+1%", "the index of the glass 1 % too high", "index", "", real, 0.01},
        {wall_ten_percent, "wall+10%", "the wall of a hollow orb 10 % too thick", "wall", "", real, 0.1},
        {wall_doubled, "wall-doubled", "the wall of a hollow orb twice as thick", "wall", "", real, 1},
        {inner_normal_flipped, "inner-normal-flipped", "light crossing the inner surface enters glass again",
         "inner normal", ""},
        {inner_surface_missing, "no-inner-surface", "a hollow orb without its inner surface", "inner surface", ""},
        {gamma_slip, "gamma-2.2", "images decoded by the power 2.2 once too often", "gamma", "", real, 2.2, 1, 0.1, 10},
        {four_bounces, "bounces-4", "every path ends after its fourth glass surface", "bounces", "", whole, 4, 256, 1,
         256},
        {camera_half_pixel, "camera+0.5px", "the camera's film half a pixel to the right", "camera", "px", real, 0.5},
        {camera_one_pixel, "camera+1px", "the camera's film one pixel to the right", "camera", "px", real, 1},
        {light_missing, "light-missing", "one of the scene's lights is off", "light", "", real, 1, 0, 0, 1},
        {texture_mirrored, "texture-mirrored", "images left for right", "texture", ""},
        {orb_one_millimetre, "orb+1mm", "the orb 1 mm to the right", "orb", "mm", real, 1},
        {tint_forgotten, "tint-forgotten", "the inner surface of a hollow orb takes no light", "tint", "", real, 1, 0,
         0, 1},
        {radiance_slip, "radiance+1%", "emitters, lights and environment 1 % too bright", "radiance", "", real, 0.01},
    };
    return all;
}

const FaultEntry &entry_of(Fault fault) { return *std::ranges::find(faults(), fault, &FaultEntry::fault); }

InjectedFault::InjectedFault(Fault listed) : fault(listed), size(entry_of(listed).listed) {}

Fault parse_fault(std::string_view name) {
    std::vector<std::string> valid;
    for (const FaultEntry &entry : faults()) {
        if (entry.name == name) return entry.fault;
        valid.emplace_back(entry.name);
    }
    throw Error(Exit::usage, unknown_name("fault", name, valid));
}

InjectedFault parse_injected_fault(std::string_view text) {
    const std::size_t at = text.find('@');
    InjectedFault injected(parse_fault(text.substr(0, at)));
    if (at == std::string_view::npos) return injected;
    const FaultEntry &entry = entry_of(injected.fault);
    if (entry.sizes == FaultEntry::Sizes::one)
        throw Error(Exit::usage, fmt::format("the fault {} is there or not: it has no size", entry.name));
    const std::string_view number = text.substr(at + 1);
    const auto size = parse_number(number);
    if (!size || !std::isfinite(*size) || *size < entry.least || *size > entry.greatest ||
        (entry.sizes == FaultEntry::Sizes::whole && *size != std::floor(*size)))
        throw Error(Exit::usage, fmt::format("the size of the fault {} must be a {}number from {:g} to {:g}, not '{}'",
                                             entry.name, entry.sizes == FaultEntry::Sizes::whole ? "whole " : "",
                                             entry.least, entry.greatest, number));
    injected.size = *size;
    return injected;
}

std::string_view to_string(Fault fault) { return entry_of(fault).name; }

std::string to_string(const InjectedFault &injected) {
    const FaultEntry &entry = entry_of(injected.fault);
    return injected.size == entry.listed ? std::string(entry.name) : fmt::format("{}@{}", entry.name, injected.size);
}

Scene with_fault(Scene scene, const InjectedFault &injected) {
    const double size = injected.size;
    switch (injected.fault) {
    case Fault::index_one_percent:
        for (Object &object : scene.objects)
            if (Glass *glass = glass_of(object.shape)) glass->index *= 1 + size;
        break;
    case Fault::wall_ten_percent:
    case Fault::wall_doubled:
        change_shells(scene, [size](Object &, GlassShell &shell) { shell.wall_mm *= 1 + size; });
        break;
    case Fault::inner_surface_missing:
        change_shells(scene, [](Object &object, const GlassShell &shell) {
            object.shape = GlassBall{shell.centre_mm, shell.outer_radius_mm, shell.glass};
        });
        break;
    case Fault::gamma_slip:
        change_images(
            scene, [size](const Texture &t) { return with_samples(t, [&](double x) { return std::pow(x, size); }); });
        break;
    case Fault::camera_half_pixel:
    case Fault::camera_one_pixel:
        scene.camera.film_offset_px.x += size;
        break;
    case Fault::light_missing:
        if (!scene.lights.empty()) scene.lights[scene.lights.size() / 2].irradiance *= 1 - size;
        break;
    case Fault::texture_mirrored:
        change_images(scene, mirrored);
        break;
    case Fault::orb_one_millimetre:
        move_orbs(scene, {size, 0, 0});
        break;
    case Fault::radiance_slip:
        change_emitters(scene, 1 + size);
        for (Directional &light : scene.lights) light.irradiance *= 1 + size;
        if (scene.environment) scene.environment->radiance *= 1 + size;
        break;
    case Fault::inner_normal_flipped:
    case Fault::four_bounces:
    case Fault::tint_forgotten:
        break; // a renderer's own
    }
    return scene;
}

Slip slip_of(const InjectedFault &injected) {
    Slip slip;
    if (injected.fault == Fault::inner_normal_flipped) slip.inner_normal_flipped = true;
    if (injected.fault == Fault::four_bounces) slip.most_interfaces = static_cast<int>(injected.size);
    if (injected.fault == Fault::tint_forgotten) slip.inner_tint_forgotten = injected.size;
    return slip;
}

RenderJob with_fault(RenderJob job, const InjectedFault &injected) {
    job.scene = with_fault(std::move(job.scene), injected);
    job.slip = slip_of(injected);
    return job;
}

} // namespace threefold
