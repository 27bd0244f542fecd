// SPDX-License-Identifier: MIT
#include "verifier/claims/fault.h"

#include <algorithm>

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

Texture brightened(const Texture &texture, double factor) {
    Texture result = texture;
    for (std::uint16_t &sample : result.rgb)
        sample = static_cast<std::uint16_t>(std::min(65535.0, sample * factor + 0.5));
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

} // namespace

const std::vector<FaultEntry> &faults() {
    static const std::vector<FaultEntry> all{
        {Fault::index_one_percent, "index+1%", "the index of the glass 1 % too high"},
        {Fault::wall_doubled, "wall-doubled", "the wall of a hollow orb twice as thick"},
        {Fault::inner_surface_missing, "no-inner-surface", "a hollow orb without its inner surface"},
        {Fault::camera_one_pixel, "camera+1px", "the camera's film one pixel to the right"},
        {Fault::texture_mirrored, "texture-mirrored", "images left for right"},
        {Fault::radiance_slip, "radiance+1%", "emitters and environment 1 % too bright"},
        {Fault::orb_one_millimetre, "orb+1mm", "the orb 1 mm to the right"},
    };
    return all;
}

Fault parse_fault(std::string_view name) {
    std::vector<std::string> valid;
    for (const FaultEntry &entry : faults()) {
        if (entry.name == name) return entry.fault;
        valid.emplace_back(entry.name);
    }
    throw Error(Exit::usage, unknown_name("fault", name, valid));
}

std::string_view to_string(Fault fault) { return std::ranges::find(faults(), fault, &FaultEntry::fault)->name; }

Scene with_fault(Scene scene, Fault fault) {
    constexpr double slip = 1.01;
    switch (fault) {
    case Fault::index_one_percent:
        for (Object &object : scene.objects)
            if (Glass *glass = glass_of(object.shape)) glass->index *= slip;
        break;
    case Fault::wall_doubled:
        for (Object &object : scene.objects)
            if (auto *shell = std::get_if<GlassShell>(&object.shape)) shell->wall_mm *= 2;
        break;
    case Fault::inner_surface_missing:
        for (Object &object : scene.objects)
            if (const auto *shell = std::get_if<GlassShell>(&object.shape))
                object.shape = GlassBall{shell->centre_mm, shell->outer_radius_mm, shell->glass};
        break;
    case Fault::camera_one_pixel:
        scene.camera.film_offset_px.x += 1;
        break;
    case Fault::texture_mirrored:
        change_images(scene, mirrored);
        break;
    case Fault::orb_one_millimetre:
        for (Object &object : scene.objects) {
            if (auto *ball = std::get_if<GlassBall>(&object.shape)) ball->centre_mm.x += 1;
            if (auto *shell = std::get_if<GlassShell>(&object.shape)) shell->centre_mm.x += 1;
        }
        break;
    case Fault::radiance_slip:
        change_images(scene, [](const Texture &t) { return brightened(t, slip); });
        if (scene.environment) scene.environment->radiance *= slip;
        break;
    }
    return scene;
}

} // namespace threefold
