// SPDX-License-Identifier: MIT
#include "exporter/mesh/obj_file.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "exporter/export/display_sphere.h"
#include "exporter/image/image_io.h"

namespace threefold {

namespace {

/// A name as one word of ASCII: the format ends names at a space, and a comment or line could hide in one.
std::string word_of(const std::string &name) {
    std::string word = name.substr(0, 60);
    std::ranges::replace_if(
        word, [](unsigned char c) { return c <= ' ' || c >= 127 || c == '#' || c == '\\' || c == '"' || c == '/'; },
        '_');
    return word.empty() ? "object" : word;
}

class ObjWriter {
public:
    explicit ObjWriter(std::string stem) : stem_(std::move(stem)) {
        obj_ = fmt::format("# Made by Threefold: see README.txt. Lengths are millimetres, +y is up.\nmtllib {}.mtl\n",
                           stem_);
        mtl_ = "# Made by Threefold. Colours are linear.\n";
    }

    void write(const Object &object) {
        // The number keeps two things of one name apart.
        const std::string name = fmt::format("{}_{}", word_of(object.name), ++count_);
        std::visit(overloaded{
                       [&](const GlassBall &ball) {
                           glass_material(name, ball.glass);
                           sphere(name, name, ball.centre_mm, ball.radius_mm, false);
                       },
                       [&](const GlassShell &shell) {
                           glass_material(name, shell.glass);
                           sphere(name + "_outer", name, shell.centre_mm, shell.outer_radius_mm, false);
                           sphere(name + "_inner", name, shell.centre_mm, shell.inner_radius_mm(), true);
                       },
                       [&](const Quad &q) { quad(name, q); },
                       [&](const Mesh &m) { mesh(name, m); },
                   },
                   object.shape);
    }

    std::vector<ExportedFile> take() {
        std::vector<ExportedFile> files{{stem_ + ".obj", std::move(obj_)}, {stem_ + ".mtl", std::move(mtl_)}};
        std::ranges::move(textures_, std::back_inserter(files));
        return files;
    }

private:
    auto out() { return std::back_inserter(obj_); }

    void begin(const std::string &object, const std::string &material) {
        fmt::format_to(out(), "o {}\nusemtl {}\n", object, material);
    }

    void vertex(const Vec3 &p) { fmt::format_to(out(), "v {} {} {}\n", p.x, p.y, p.z); }

    void glass_material(const std::string &name, const Glass &glass) {
        // Model 7: refraction, and reflection by Fresnel. Tf is what one surface lets through.
        const double t = glass.interface_transmittance;
        mtl_ += fmt::format("newmtl {}\nKd 0 0 0\nKs 1 1 1\nNs 1000\nNi {}\nTf {} {} {}\nd 1\nillum 7\n", name,
                            glass.index, t, t, t);
    }

    void sphere(const std::string &object, const std::string &material, const Vec3 &centre_mm, double radius_mm,
                bool inwards) {
        begin(object, material);
        const IcosphereFit fit = display_sphere();
        if (sphere_.vertices.empty()) sphere_ = make_icosphere(fit.level);
        for (const Vec3 &p : sphere_.vertices) vertex(centre_mm + radius_mm * fit.scale * p);
        for (const Vec3 &p : sphere_.vertices) {
            const Vec3 n = inwards ? -p : p;
            fmt::format_to(out(), "vn {:.7f} {:.7f} {:.7f}\n", n.x, n.y, n.z);
        }
        for (const glm::uvec3 &t : sphere_.triangles) {
            const glm::uvec3 c = inwards ? glm::uvec3(t.x, t.z, t.y) : t;
            fmt::format_to(out(), "f {0}//{3} {1}//{4} {2}//{5}\n", vertices_ + c.x + 1, vertices_ + c.y + 1,
                           vertices_ + c.z + 1, normals_ + c.x + 1, normals_ + c.y + 1, normals_ + c.z + 1);
        }
        vertices_ += sphere_.vertices.size();
        normals_ += sphere_.vertices.size();
    }

    void quad(const std::string &name, const Quad &quad) {
        surface_material(name, quad.surface);
        begin(name, name);
        std::string face = "f";
        for (const Vec2 &c : {Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1)}) {
            vertex(quad.centre_mm + c.x * quad.half_u_mm + c.y * quad.half_v_mm);
            fmt::format_to(out(), "vt {} {}\n", (c.x + 1) / 2, (c.y + 1) / 2);
            face += fmt::format(" {}/{}", ++vertices_, ++uvs_);
        }
        obj_ += face + "\n";
    }

    void mesh(const std::string &name, const Mesh &mesh) {
        surface_material(name, mesh.surface);
        begin(name, name);
        for (const Vec3 &p : mesh.vertices_mm) vertex(p);
        for (const Vec2 &t : mesh.uv) fmt::format_to(out(), "vt {} {}\n", t.x, t.y);
        for (const glm::uvec3 &t : mesh.triangles) {
            obj_ += "f";
            for (const std::size_t corner : {t.x, t.y, t.z}) {
                fmt::format_to(out(), " {}", vertices_ + corner + 1);
                if (!mesh.uv.empty()) fmt::format_to(out(), "/{}", uvs_ + corner + 1);
            }
            obj_ += "\n";
        }
        vertices_ += mesh.vertices_mm.size();
        uvs_ += mesh.uv.size();
    }

    void surface_material(const std::string &name, const Surface &surface) {
        mtl_ += fmt::format("newmtl {}\n", name);
        std::visit(overloaded{
                       [&](const Diffuse &d) {
                           paint("Kd", d.reflectance);
                           mtl_ += "Ks 0 0 0\nillum 1\n";
                       },
                       [&](const Emissive &e) {
                           mtl_ += "Kd 0 0 0\nKs 0 0 0\nillum 1\n";
                           paint("Ke", e.radiance);
                       },
                       [](const CoordinateCard &) {}, // refused before
                   },
                   surface);
    }

    void paint(std::string_view what, const Paint &paint) {
        std::visit(overloaded{
                       [&](const Rgb &c) { mtl_ += fmt::format("{} {} {} {}\n", what, c.r, c.g, c.b); },
                       [&](const std::shared_ptr<const Texture> &texture) {
                           mtl_ += fmt::format("{0} 1 1 1\nmap_{0} {1}\n", what, texture_file(texture));
                       },
                   },
                   paint);
    }

    std::string texture_file(const std::shared_ptr<const Texture> &texture) {
        std::string &name = texture_names_[texture.get()];
        if (name.empty()) {
            name = fmt::format("{}-texture-{}.png", stem_, texture_names_.size());
            textures_.push_back({name, encode_png_srgb(*texture)});
        }
        return name;
    }

    std::string stem_, obj_, mtl_;
    std::vector<ExportedFile> textures_;
    std::map<const Texture *, std::string> texture_names_;
    Icosphere sphere_;
    std::size_t vertices_ = 0, normals_ = 0, uvs_ = 0, count_ = 0;
};

} // namespace

std::vector<ExportedFile> make_obj_files(const ExportJob &job) {
    refuse_coordinate_card(job.job.scene, "OBJ");
    ObjWriter writer(job.stem());
    for (const Object &object : job.job.scene.objects) writer.write(object);
    std::vector<ExportedFile> files = writer.take();
    files.push_back({"README.txt", to_text(job.provenance) +
                                       "\nLengths are millimetres, right-handed, +y up; colours are linear, textures "
                                       "8-bit sRGB.\nEach glass object has one material; a shell is two surfaces, the "
                                       "inner one with its faces to the centre.\n"});
    return files;
}

} // namespace threefold
