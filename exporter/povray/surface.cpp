// SPDX-License-Identifier: MIT
// What quads and meshes are made of. Pigments are written over the unit square of (u, v), v = 0 at the bottom.
#include "exporter/povray/writer.h"

#include <algorithm>

#include <fmt/format.h>

#include "exporter/image/image_io.h"

namespace threefold::povray {
namespace {

constexpr int border_texels = 1; // bilinear interpolation would otherwise wrap around at the edges

std::string file_of(Writer &writer, const Texture &texture) {
    const auto known = std::find(writer.texture_of_file.begin(), writer.texture_of_file.end(), &texture);
    const auto index = static_cast<std::size_t>(known - writer.texture_of_file.begin());
    if (known == writer.texture_of_file.end()) {
        writer.texture_of_file.push_back(&texture);
        writer.textures.push_back({fmt::format("texture-{}.png", index), encode_png16(texture, border_texels)});
    }
    return writer.textures[index].name;
}

std::string pigment(Writer &writer, const Paint &paint) {
    return std::visit(overloaded{[](const Rgb &colour) { return fmt::format("rgb {}", vector(colour)); },
                                 [&](const std::shared_ptr<const Texture> &texture) {
                                     // `gamma 1.0`: the samples are linear. The border is moved out of the unit square.
                                     const double width = texture->width, height = texture->height;
                                     return fmt::format("image_map {{ png \"{}\" gamma 1.0 map_type 0 interpolate 2 }} "
                                                        "scale {} translate {}",
                                                        file_of(writer, *texture),
                                                        vector({(width + 2 * border_texels) / width,
                                                                (height + 2 * border_texels) / height, 1}),
                                                        vector({-border_texels / width, -border_texels / height, 0}));
                                 }},
                      paint);
}

// The mean of three pigments, each three times as bright. The clamp keeps rounding at the edges from wrapping around.
constexpr const char *coordinate_pigment = R"(average pigment_map {
    [1 function { min(1, max(0, x)) } color_map { [0 rgb 0] [1 rgb <3,0,0>] }]
    [1 function { min(1, max(0, y)) } color_map { [0 rgb 0] [1 rgb <0,3,0>] }]
    [1 rgb <0,0,3>]
  })";

std::string texture_block(const char *mapping, const std::string &pigment_body, const std::string &finish_body) {
    return fmt::format("  texture {{\n  pigment {{ {}{} }}\n  finish {{ ambient 0 specular 0 {} }}\n  }}\n", mapping,
                       pigment_body, finish_body);
}

} // namespace

std::string surface_texture(Writer &writer, const Surface &surface, bool by_uv) {
    const char *mapping = by_uv ? "uv_mapping " : "";
    const std::string emits = fmt::format("diffuse 0 emission {}", number(writer.radiance_scale));
    return std::visit(
        overloaded{
            [&](const Diffuse &diffuse) {
                return texture_block(mapping, pigment(writer, diffuse.reflectance),
                                     "emission 0 diffuse 1 brilliance 1");
            },
            [&](const Emissive &emissive) { return texture_block(mapping, pigment(writer, emissive.radiance), emits); },
            [&](const CoordinateCard &) { return texture_block(mapping, coordinate_pigment, emits); }},
        surface);
}

bool needs_uv(const Surface &surface) {
    const auto painted = [](const Paint &paint) {
        return std::holds_alternative<std::shared_ptr<const Texture>>(paint);
    };
    return std::visit(overloaded{[&](const Diffuse &diffuse) { return painted(diffuse.reflectance); },
                                 [&](const Emissive &emissive) { return painted(emissive.radiance); },
                                 [](const CoordinateCard &) { return true; }},
                      surface);
}

} // namespace threefold::povray
