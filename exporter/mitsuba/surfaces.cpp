// SPDX-License-Identifier: MIT
// BSDFs, textures and area lights.
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "exporter/mitsuba/coordinate_corners.h"
#include "exporter/mitsuba/reader.h"
#include "exporter/text.h"
#include "scenes/error.h"
#include "scenes/texture.h"

namespace threefold::mitsuba {

std::shared_ptr<const Texture> Reader::bitmap(const Node &node, const std::string &shape, TwoSides &sides) {
    Properties p(node, document_);
    const std::string named = p.word("filename", "");
    const std::optional<double> gamma = p.number("gamma");
    const bool raw = p.boolean("raw", false);
    const std::string filter = p.word("filter_type", document_.old_dialect() ? "ewa" : "bilinear");
    const std::string wrap = p.word("wrap_mode", "repeat"), wrap_u = p.word("wrap_mode_u", wrap),
                      wrap_v = p.word("wrap_mode_v", wrap);
    for (const char *name : {"uscale", "vscale"})
        if (p.number(name).value_or(1) != 1) findings_.problem(node, fmt::format("{} other than 1", name));
    for (const char *name : {"uoffset", "voffset"})
        if (p.number(name).value_or(0) != 0) findings_.problem(node, fmt::format("{} other than 0", name));
    // Between the centres of two by two texels: how a coordinate card is said.
    const glm::dmat4 window = glm::dmat4({0.5, 0, 0, 0}, {0, 0.5, 0, 0}, {0, 0, 1, 0}, {0.25, 0.25, 0, 1}),
                     to_uv = p.transform("to_uv").matrix;
    p.leave_out({"cache", "max_anisotropy", "id", "format", "accel"}, "how the picture is kept");
    p.finish();
    if (filter == "nearest")
        findings_.problem(node, "filter nearest: pictures are bilinear here");
    else if (filter == "trilinear" || filter == "ewa")
        findings_.note(node, fmt::format("filter {} is taken as bilinear: alike where the picture is not seen smaller "
                                         "than its texels",
                                         filter));
    else if (filter != "bilinear")
        findings_.problem(node, fmt::format("filter '{}' is unknown", one_line(filter)));
    if (wrap_u != "clamp" || wrap_v != "clamp") wrap_[shape] = wrap_u;

    std::string file;
    const std::string parameter = shape + ".texture";
    if (parameters_.has(parameter)) file = parameters_.word(parameter);
    if (file.empty() && parameters_.has("robe.shape") && parameters_.word("robe.shape") == shape)
        file = parameters_.word("robe.texture");
    if (file.empty()) {
        if (named.empty()) {
            findings_.problem(node, "filename is missing");
            return nullptr;
        }
        file = resolved(named, node, document_.tree.root).string();
        std::error_code ignored;
        if (!std::filesystem::exists(file, ignored)) {
            findings_.problem(node, fmt::format("there is no picture {} (--set {}=FILE gives another)", one_line(named),
                                                one_line(parameter)));
            return nullptr;
        }
    }
    if (gamma && *gamma < 0 && *gamma != -1) findings_.problem(node, "gamma must be positive, or -1 for sRGB");
    try {
        const auto read = parameters_.files().texture(file, raw ? 1 : gamma && *gamma > 0 ? *gamma : 0);
        if (to_uv == window && *read == coordinate_corners())
            sides.coordinates = true;
        else if (to_uv != glm::dmat4(1))
            findings_.problem(node, "to_uv that moves the picture");
        return read;
    } catch (const Error &error) {
        if (error.code() != Exit::bad_data && error.code() != Exit::input_output) throw;
        findings_.problem(node, error.what());
        return nullptr;
    }
}

Paint Reader::paint(const Node &node, const std::string &shape, TwoSides &sides) {
    if (node.tag != "texture") return to_colour(node, document_).value_or(Rgb(0));
    const std::string *type = node.attribute("type");
    if (type && *type == "bitmap") {
        const auto texture = bitmap(node, shape, sides);
        return texture ? Paint(texture) : Paint(Rgb(0));
    }
    if (type && *type == "gridtexture") {
        Properties p(node, document_);
        Grid grid;
        grid.field = p.colour("color0").value_or(grid.field);
        grid.line = p.colour("color1").value_or(grid.line);
        grid.line_width = p.number("line_width").value_or(grid.line_width);
        grid.scale = {p.number("uscale").value_or(1), p.number("vscale").value_or(1)};
        grid.offset = {p.number("uoffset").value_or(0), p.number("voffset").value_or(0)};
        p.finish();
        constexpr double most_cells = 200;
        if (!(grid.scale.x > 0 && grid.scale.y > 0 && grid.scale.x <= most_cells && grid.scale.y <= most_cells))
            findings_.problem(node, fmt::format("uscale and vscale must lie between 0 and {}", most_cells));
        else if (!(grid.line_width >= 0 && grid.line_width < 0.5))
            findings_.problem(node, "lineWidth must lie between 0 and 0.5");
        else if (grid.offset != Vec2(0))
            findings_.problem(node, "a grid that is moved by uoffset or voffset");
        else
            sides.grid = grid;
        return grid.field;
    }
    findings_.problem(node, "is no texture that can be said (bitmap, and gridtexture on a rectangle)");
    return Rgb(0);
}

TwoSides Reader::surface(const Node &bsdf, const std::string &shape, int depth) {
    TwoSides sides;
    Properties p(bsdf, document_);
    if (p.type() == "diffuse") {
        const Node *reflectance = p.named("reflectance");
        if (!reflectance) reflectance = p.named("diffuse_reflectance");
        if (reflectance) sides.front = Diffuse{paint(*reflectance, shape, sides)};
        p.finish();
        if (sides.coordinates) findings_.problem(bsdf, "to_uv that moves the picture");
        return sides;
    }
    if (p.type() == "twosided" && depth < 4) {
        const std::vector<const Node *> inner = p.children("bsdf");
        p.finish();
        if (inner.empty() || inner.size() > 2) {
            findings_.problem(bsdf, "needs one BSDF, or two");
            return sides;
        }
        sides = surface(*inner.front(), shape, depth + 1);
        sides.back = sides.front;
        sides.alike = true;
        if (inner.size() == 2) {
            const TwoSides other = surface(*inner.back(), shape, depth + 1);
            const auto *a = std::get_if<Diffuse>(&sides.front), *b = std::get_if<Diffuse>(&other.front);
            sides.alike = a && b && a->reflectance == b->reflectance && !sides.grid && !other.grid;
            sides.back = other.front;
            if ((sides.grid || other.grid) && !sides.alike)
                findings_.problem(bsdf, "two sides that differ, one a grid");
        }
        return sides;
    }
    findings_.problem(bsdf, "is no surface that can be said of a rectangle or a mesh (diffuse, twosided diffuse)");
    return sides;
}

std::optional<GlassSurface> Reader::glass(const Node &bsdf) {
    Properties p(bsdf, document_);
    if (p.type() != "dielectric" && p.type() != "thindielectric") {
        findings_.problem(bsdf, "a sphere can only be of glass (dielectric, thindielectric)");
        return std::nullopt;
    }
    GlassSurface glass;
    glass.thin = p.type() == "thindielectric";
    const std::optional<double> inside = p.index_of("int_ior", "bk7"), outside = p.index_of("ext_ior", "air");
    const Rgb tint = p.colour("specular_transmittance").value_or(Rgb(1));
    const Rgb mirror = p.colour("specular_reflectance").value_or(Rgb(1));
    p.finish();
    if (!inside || !outside) return std::nullopt;
    glass.inside = *inside;
    glass.outside = *outside;
    if (mirror != Rgb(1)) findings_.problem(bsdf, "specularReflectance other than 1");
    if (tint != Rgb(tint.r) || tint.r > 1) findings_.problem(bsdf, "specularTransmittance must be grey and at most 1");
    glass.transmittance = tint.r;
    return glass;
}

void Reader::emission(Properties &shape, const std::string &name, TwoSides &sides) {
    for (const Node *node : shape.children("emitter")) {
        Properties p(*node, document_);
        if (p.type() != "area") {
            findings_.problem(*node, "a surface can only have an area light");
            continue;
        }
        const Node *radiance = p.named("radiance");
        const Paint shown = radiance ? paint(*radiance, name, sides) : Paint(Rgb(1));
        p.leave_out({"sampling_weight"}, "how the light is found");
        p.finish();
        if (!radiance) findings_.problem(*node, "radiance is missing");
        if (sides.grid) findings_.problem(*node, "a grid that emits");
        const auto *below = std::get_if<Diffuse>(&sides.front);
        if (!below || greatest_value(below->reflectance) != Rgb(0))
            findings_.problem(*node, "a surface that both emits and reflects: give it a BSDF of reflectance 0");
        sides.front = sides.coordinates ? Surface(CoordinateCard{}) : Surface(Emissive{shown});
        sides.alike = false;
    }
}

std::optional<TwoSides> Reader::painted(Properties &shape, const std::string &name) {
    const std::vector<const Node *> bsdfs = shape.children("bsdf");
    if (bsdfs.size() > 1) {
        findings_.problem(shape.element(), "has more than one BSDF");
        return std::nullopt;
    }
    TwoSides sides;
    if (!bsdfs.empty())
        sides = surface(*bsdfs.front(), name);
    else
        for (const Node &child : shape.element().children)
            if (child.tag == "emitter") sides.front = Diffuse{Rgb(0)};
    emission(shape, name, sides);
    return sides;
}

} // namespace threefold::mitsuba
