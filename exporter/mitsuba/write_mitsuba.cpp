// SPDX-License-Identifier: MIT
#include "exporter/mitsuba/write_mitsuba.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <pugixml.hpp>

#include "exporter/files.h"
#include "exporter/image/image_io.h"
#include "exporter/mitsuba/coordinate_corners.h"
#include "scenes/access.h"
#include "scenes/texture.h"

namespace threefold {

namespace {

using Xml = pugi::xml_node;

std::string text(Vec3 v) { return fmt::format("{}, {}, {}", v.x, v.y, v.z); }

/// XML 1.0 has no control characters, and an instruction ends at its first "?>".
std::string sayable(const std::string &name) {
    std::string out;
    for (const char c : name) out += static_cast<unsigned char>(c) < ' ' || c == 127 ? ' ' : c;
    return out;
}

Xml child(Xml parent, const char *tag, const char *type) {
    Xml node = parent.append_child(tag);
    node.append_attribute("type") = type;
    return node;
}

Xml value(Xml parent, const char *tag, const char *name, const std::string &value) {
    Xml node = parent.append_child(tag);
    node.append_attribute("name") = name;
    node.append_attribute("value") = value.c_str();
    return node;
}

Xml float_value(Xml parent, const char *name, double x) { return value(parent, "float", name, fmt::format("{}", x)); }

bool shines(const Surface &surface) {
    return std::visit(overloaded{
                          [](const Diffuse &) { return false; },
                          [](const Emissive &e) { return greatest_value(e.radiance) != Rgb(0); },
                          [](const CoordinateCard &) { return true; },
                      },
                      surface);
}

class Writer {
public:
    Writer(const Scene &scene, std::string name) : scene_(scene), name_(std::move(name)) {}

    MitsubaFiles operator()(int samples_per_pixel, std::uint64_t seed) {
        Xml declaration = document_.append_child(pugi::node_declaration);
        declaration.append_attribute("version") = "1.0";
        declaration.append_attribute("encoding") = "utf-8";
        say_our_own();
        root_ = document_.append_child("scene");
        root_.append_attribute("version") = "3.0.0";
        const auto parameter = [&](const char *key, const std::string &v) {
            Xml node = root_.append_child("default");
            node.append_attribute("name") = key;
            node.append_attribute("value") = v.c_str();
        };
        parameter("spp", fmt::format("{}", samples_per_pixel));
        parameter("seed", fmt::format("{}", seed % 0x7fffffff));
        Xml integrator = child(root_, "integrator", "path");
        value(integrator, "integer", "max_depth", "-1");
        value(integrator, "integer", "rr_depth", "1000");
        camera();
        for (const Object &object : scene_.objects) shape(object);
        lights();
        std::ostringstream out;
        document_.save(out, "  ", pugi::format_default, pugi::encoding_utf8);
        made_.files.insert(made_.files.begin(), {name_ + ".xml", out.str()});
        tell_general_losses();
        return std::move(made_);
    }

private:
    void lose(const std::string &what, bool changes_picture = true) { made_.losses.push_back({what, changes_picture}); }

    /// The attributes are written as an element first, so that they are escaped.
    void say_our_own() {
        pugi::xml_document own;
        Xml said = own.append_child("x");
        said.append_attribute("unit_mm") = "1";
        said.append_attribute("name") = sayable(scene_.name).c_str();
        constexpr const char *rules[] = {"none", "opaque", "constant", "caustic"};
        said.append_attribute("glass_shadow") = rules[static_cast<int>(scene_.glass_shadow.rule)];
        said.append_attribute("shadow_transmittance") = fmt::format("{}", scene_.glass_shadow.transmittance).c_str();
        if (scene_.environment) said.append_attribute("dome_directions") = scene_.environment->dome_directions;
        std::ostringstream out;
        own.save(out, "", pugi::format_raw | pugi::format_no_declaration);
        std::string content = out.str();
        content = content.substr(3, content.rfind("/>") - 3);
        for (std::size_t at; (at = content.find("?>")) != std::string::npos;) content.replace(at, 2, "?&gt;");
        Xml instruction = document_.append_child(pugi::node_pi);
        instruction.set_name("threefold");
        instruction.set_value(content.c_str());
    }

    void camera() {
        const Camera &c = scene_.camera;
        const bool parallel = c.projection == Projection::orthographic;
        Xml sensor = child(root_, "sensor", parallel ? "orthographic" : "perspective");
        if (!parallel) {
            float_value(sensor, "fov", c.horizontal_fov_deg);
            value(sensor, "string", "fov_axis", "x");
            // A shift of the picture by a share of its size; a crop has the film as its measure.
            if (c.film_offset_px != Vec2(0))
                lose(fmt::format("a film offset of ({}, {}) px", c.film_offset_px.x, c.film_offset_px.y));
        } else if (c.film_offset_px != Vec2(0))
            lose("a film offset");
        // Mitsuba cuts what is nearer or farther.
        float_value(sensor, "near_clip", 1e-3);
        float_value(sensor, "far_clip", 1e9);
        Xml transform = sensor.append_child("transform");
        transform.append_attribute("name") = "to_world";
        if (parallel) {
            Xml scale = transform.append_child("scale");
            const std::string half = fmt::format("{}", c.orthographic_width_mm / 2);
            scale.append_attribute("x") = half.c_str();
            scale.append_attribute("y") = half.c_str();
        }
        Xml look = transform.append_child("lookat");
        look.append_attribute("origin") = text(c.eye_mm).c_str();
        look.append_attribute("target") = text(c.target_mm).c_str();
        look.append_attribute("up") = text(c.up).c_str();
        Xml sampler = child(sensor, "sampler", "independent");
        value(sampler, "integer", "sample_count", "$spp");
        value(sampler, "integer", "seed", "$seed");
        Xml film = child(sensor, "film", "hdrfilm");
        const auto whole = [&](const char *name, int n) { value(film, "integer", name, fmt::format("{}", n)); };
        whole("width", c.width_px);
        whole("height", c.height_px);
        if (c.crop) {
            whole("crop_offset_x", c.crop->x_px);
            whole("crop_offset_y", c.crop->y_px);
            whole("crop_width", c.crop->width_px);
            whole("crop_height", c.crop->height_px);
        }
        value(film, "string", "file_format", "openexr");
        value(film, "string", "pixel_format", "rgb");
        value(film, "string", "component_format", "float32");
        child(film, "rfilter", "box");
    }

    void glass_bsdf(Xml shape, const std::string &name, const Glass &glass) {
        Xml bsdf = child(shape, "bsdf", "dielectric");
        float_value(bsdf, "int_ior", glass.index);
        float_value(bsdf, "ext_ior", 1);
        if (glass.interface_transmittance != 1)
            float_value(bsdf, "specular_transmittance", glass.interface_transmittance);
        if (glass.coating == Coating::antireflective)
            lose(fmt::format("{}: the antireflective coating of the glass: it reflects as bare glass does", name));
    }

    Xml begin_shape(const char *type, const std::string &name) {
        Xml shape = child(root_, "shape", type);
        // Identifiers are unique, without a dot (Mitsuba's own separator), and no reference to a parameter.
        std::string id;
        for (const char c : sayable(name)) id += c == '.' || c == '$' ? '_' : c;
        if (id.empty()) id = "object";
        for (int k = 2; !ids_.insert(id).second; ++k) id = fmt::format("{} {}", id, k);
        shape.append_attribute("id") = id.c_str();
        if (id != name) lose(fmt::format("the name '{}', written as '{}'", sayable(name), id), false);
        return shape;
    }

    void sphere(const std::string &name, Vec3 centre, double radius, const Glass &glass, bool hollow) {
        Xml shape = begin_shape("sphere", name);
        Xml point = shape.append_child("point");
        point.append_attribute("name") = "center";
        point.append_attribute("x") = fmt::format("{}", centre.x).c_str();
        point.append_attribute("y") = fmt::format("{}", centre.y).c_str();
        point.append_attribute("z") = fmt::format("{}", centre.z).c_str();
        float_value(shape, "radius", radius);
        if (hollow) value(shape, "boolean", "flip_normals", "true");
        glass_bsdf(shape, name, glass);
    }

    void paint(Xml parent, const char *name, const Paint &paint) {
        std::visit(overloaded{
                       [&](const Rgb &colour) { value(parent, "rgb", name, text(colour)); },
                       [&](const std::shared_ptr<const Texture> &texture) {
                           const std::string bytes = encode_png16(*texture);
                           const std::string file = content_hash(bytes).substr(0, 16) + ".png";
                           add_file({file, bytes});
                           Xml node = child(parent, "texture", "bitmap");
                           node.append_attribute("name") = name;
                           value(node, "string", "filename", file);
                           value(node, "boolean", "raw", "true");
                           value(node, "string", "filter_type", "bilinear");
                           value(node, "string", "wrap_mode", "clamp");
                           // By default 16 bits are kept as half a float, which has 11.
                           value(node, "string", "format", "variant");
                       },
                   },
                   paint);
    }

    void add_file(ExportedFile file) {
        if (std::ranges::count(made_.files, file.name, &ExportedFile::name) == 0)
            made_.files.push_back(std::move(file));
    }

    void black(Xml shape) { value(child(shape, "bsdf", "diffuse"), "rgb", "reflectance", "0"); }

    void surface(Xml shape, const Surface &surface) {
        std::visit(overloaded{
                       [&](const Diffuse &d) {
                           Xml both = child(shape, "bsdf", "twosided");
                           paint(child(both, "bsdf", "diffuse"), "reflectance", d.reflectance);
                           if (greatest_value(d.reflectance) != Rgb(0)) ++diffuse_;
                       },
                       [&](const Emissive &e) {
                           black(shape);
                           paint(child(shape, "emitter", "area"), "radiance", e.radiance);
                           if (greatest_value(e.radiance) != Rgb(0)) ++emissive_;
                       },
                       [&](const CoordinateCard &) {
                           // Bilinear between (u, v, 1) at the card's corners: a picture of two by two texels, of
                           // which the card shows what lies between their centres.
                           black(shape);
                           const auto corners = std::make_shared<const Texture>(coordinate_corners());
                           Xml emitter = child(shape, "emitter", "area");
                           paint(emitter, "radiance", corners);
                           Xml window = emitter.child("texture").append_child("transform");
                           window.append_attribute("name") = "to_uv";
                           Xml scale = window.append_child("scale"), move = window.append_child("translate");
                           for (const char *axis : {"x", "y"}) {
                               scale.append_attribute(axis) = "0.5";
                               move.append_attribute(axis) = "0.25";
                           }
                           ++emissive_;
                       },
                   },
                   surface);
    }

    /// Front to the eye and to all glass, if one side has them all.
    bool one_side(Vec3 on_plane, Vec3 normal, bool &front) const {
        const Camera &c = scene_.camera;
        double least = c.projection == Projection::perspective ? glm::dot(c.eye_mm - on_plane, normal)
                                                               : glm::dot(c.eye_mm - c.target_mm, normal);
        double most = least;
        front = least >= 0;
        for (const Object &object : scene_.objects)
            if (const auto orb = outer_sphere(object.shape)) {
                const double d = glm::dot(orb->centre_mm - on_plane, normal), r = orb->radius_mm * (1 - 1e-9);
                least = std::min(least, d - r);
                most = std::max(most, d + r);
            }
        return least >= 0 || most <= 0;
    }

    void quad(const std::string &name, const Quad &q) {
        Xml shape = begin_shape("rectangle", name);
        const Vec3 right = q.half_u_mm, up = -q.half_v_mm; // its pictures hang with their first row at -y
        const Vec3 normal = glm::normalize(glm::cross(right, up));
        bool front = true;
        const bool whole = one_side(q.centre_mm, normal, front);
        if (!whole && shines(q.surface)) lose(fmt::format("{}: it emits from both sides, and both can be seen", name));
        Xml transform = shape.append_child("transform");
        transform.append_attribute("name") = "to_world";
        Xml matrix = transform.append_child("matrix");
        matrix.append_attribute("value") =
            fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} 0 0 0 1", right.x, up.x, normal.x, q.centre_mm.x, right.y,
                        up.y, normal.y, q.centre_mm.y, right.z, up.z, normal.z, q.centre_mm.z)
                .c_str();
        if (!front) value(shape, "boolean", "flip_normals", "true");
        surface(shape, q.surface);
    }

    void mesh(const std::string &name, const Mesh &m) {
        const bool emits = shines(m.surface);
        std::string obj = "# millimetres\n";
        for (const Vec3 &v : m.vertices_mm) obj += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
        for (const Vec2 &uv : m.uv) obj += fmt::format("vt {} {}\n", uv.x, uv.y);
        std::size_t unsure = 0;
        for (glm::uvec3 t : m.triangles) {
            if (emits) {
                const Vec3 a = m.vertices_mm[t.x];
                const Vec3 normal = glm::cross(m.vertices_mm[t.y] - a, m.vertices_mm[t.z] - a);
                bool front = true;
                if (glm::length(normal) > 0 && !one_side(a, glm::normalize(normal), front)) ++unsure;
                if (!front) std::swap(t.y, t.z);
            }
            const glm::uvec3 n = t + 1u;
            obj += m.uv.empty() ? fmt::format("f {} {} {}\n", n.x, n.y, n.z)
                                : fmt::format("f {0}/{0} {1}/{1} {2}/{2}\n", n.x, n.y, n.z);
        }
        if (unsure > 0)
            lose(fmt::format("{}: it emits from both sides, and of {} of its {} triangles both can be seen", name,
                             unsure, m.triangles.size()));
        const std::string file = content_hash(obj).substr(0, 16) + ".obj";
        add_file({file, std::move(obj)});
        Xml shape = begin_shape("obj", name);
        value(shape, "string", "filename", file);
        value(shape, "boolean", "face_normals", "true");
        surface(shape, m.surface);
    }

    void shape(const Object &object) {
        std::visit(overloaded{
                       [&](const GlassBall &b) { sphere(object.name, b.centre_mm, b.radius_mm, b.glass, false); },
                       [&](const GlassShell &s) {
                           sphere(object.name, s.centre_mm, s.outer_radius_mm, s.glass, false);
                           const std::size_t before = made_.losses.size();
                           sphere(object.name + ", hollow", s.centre_mm, s.inner_radius_mm(), s.glass, true);
                           made_.losses.resize(before); // the same glass, said once
                       },
                       [&](const Quad &q) { quad(object.name, q); },
                       [&](const Mesh &m) { mesh(object.name, m); },
                   },
                   object.shape);
    }

    void lights() {
        for (const Directional &light : scene_.lights) {
            Xml emitter = child(root_, "emitter", "directional");
            value(emitter, "rgb", "irradiance", text(light.irradiance));
            Xml direction = emitter.append_child("vector");
            direction.append_attribute("name") = "direction";
            direction.append_attribute("x") = fmt::format("{}", light.travel.x).c_str();
            direction.append_attribute("y") = fmt::format("{}", light.travel.y).c_str();
            direction.append_attribute("z") = fmt::format("{}", light.travel.z).c_str();
        }
        if (scene_.environment)
            value(child(root_, "emitter", "constant"), "rgb", "radiance", text(scene_.environment->radiance));
    }

    void tell_general_losses() {
        const bool glass =
            std::ranges::any_of(scene_.objects, [](const Object &o) { return outer_sphere(o.shape).has_value(); });
        const GlassShadow &shadow = scene_.glass_shadow;
        const bool opaque = shadow.rule == GlassShadow::Rule::opaque ||
                            (shadow.rule == GlassShadow::Rule::constant && shadow.transmittance == 0);
        if (diffuse_ > 0 && glass && !scene_.lights.empty() && !opaque)
            lose("the glass-shadow rule: Mitsuba's path tracer stops parallel light at glass");
        if (diffuse_ > 0 && scene_.environment && scene_.environment->radiance != Rgb(0)) {
            lose(fmt::format("the environment's light on surfaces as that of {} parallel lights: Mitsuba takes it from "
                             "all directions, through glass too",
                             scene_.environment->dome_directions));
        }
        if (diffuse_ > 1 || (diffuse_ > 0 && glass))
            lose("light that surfaces pass on to each other, or that glass throws on them: Mitsuba adds it, here there "
                 "is none");
        if (diffuse_ > 0 && emissive_ > 0) lose("emitters light diffuse surfaces in Mitsuba, and are only seen here");
        lose("Mitsuba computes in single precision, meshes are stored in it", false);
    }

    const Scene &scene_;
    std::string name_;
    pugi::xml_document document_;
    Xml root_;
    MitsubaFiles made_;
    std::set<std::string> ids_;
    int diffuse_ = 0, emissive_ = 0;
};

} // namespace

MitsubaFiles to_mitsuba(const Scene &scene, const std::string &name, int samples_per_pixel, std::uint64_t seed) {
    return Writer(scene, name)(samples_per_pixel, seed);
}

std::vector<MitsubaLoss> write_mitsuba(const Scene &scene, const std::filesystem::path &folder, int samples_per_pixel,
                                       std::uint64_t seed) {
    MitsubaFiles made = to_mitsuba(scene, "scene", samples_per_pixel, seed);
    make_folder(folder);
    for (const ExportedFile &file : made.files) write_file_atomically(folder / file.name, file.bytes);
    return made.losses;
}

} // namespace threefold
