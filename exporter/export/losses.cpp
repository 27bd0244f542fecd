// SPDX-License-Identifier: MIT
#include "exporter/export/losses.h"

#include <algorithm>

#include <fmt/format.h>

#include "exporter/export/display_sphere.h"
#include "exporter/mitsuba/write_mitsuba.h"
#include "exporter/text.h"
#include "scenes/access.h"
#include "scenes/validate.h"

namespace threefold {

namespace {

/// What a scene has that a format may be unable to say.
class Features {
public:
    explicit Features(const Scene &scene) : scene_(scene), needs_(needs(scene)) {}

    void add(std::string sentence) { list_.push_back(std::move(sentence)); }
    std::vector<std::string> take() { return std::move(list_); }

    bool has_glass() const { return needs_.glass; }
    bool has_lights() const { return !scene_.lights.empty(); }

    void glass_shadow() {
        if (!needs_.glass_shadow) return;
        const auto word = [&]() -> std::string {
            switch (scene_.glass_shadow.rule) {
            case GlassShadow::Rule::none:
                return "glass casts none";
            case GlassShadow::Rule::opaque:
                return "glass casts an opaque one";
            case GlassShadow::Rule::constant:
                return fmt::format("glass lets {} of the light through in a straight line",
                                   scene_.glass_shadow.transmittance);
            case GlassShadow::Rule::caustic:
                return "glass bends the light";
            }
            return {};
        };
        add(fmt::format("The rule for shadows of glass ({}): each program has its own.", word()));
    }

    void environment() {
        if (!scene_.environment) return;
        const Rgb r = scene_.environment->radiance;
        if (r == Rgb(0)) return;
        add(fmt::format("The surroundings, radiance ({:g}, {:g}, {:g}){}.", r.r, r.g, r.b,
                        scene_.environment->dome_directions > 0 ? ", and the dome of lights that stands for them on "
                                                                  "diffuse surfaces"
                                                                : ""));
    }

    void glass_details() {
        for (const Object &object : scene_.objects) {
            const Glass *glass = glass_of(object.shape);
            if (!glass) continue;
            if (glass->interface_transmittance != 1)
                add(fmt::format("The factor {:g} on light at each surface of the glass \"{}\".",
                                glass->interface_transmittance, one_line(object.name)));
            if (glass->coating == Coating::antireflective)
                add(fmt::format("The antireflective coating of \"{}\": it will reflect as bare glass does.",
                                one_line(object.name)));
        }
    }

    void facets() {
        double farthest_mm = 0;
        for (const Object &object : scene_.objects)
            if (const auto sphere = outer_sphere(object.shape))
                farthest_mm = std::max(farthest_mm, display_sphere().distance * sphere->radius_mm);
        if (farthest_mm > 0)
            add(fmt::format("The roundness of spheres: they become facets, up to {:.2g} mm from the true surface.",
                            farthest_mm));
    }

    void textures() {
        const auto painted = [](const Surface &surface) {
            const auto is_picture = [](const Paint &p) { return p.index() == 1; };
            return std::visit(overloaded{[&](const Diffuse &d) { return is_picture(d.reflectance); },
                                         [&](const Emissive &e) { return is_picture(e.radiance); },
                                         [](const CoordinateCard &) { return false; }},
                              surface);
        };
        for (const Object &object : scene_.objects)
            if (const Surface *surface = surface_of(object.shape); surface && painted(*surface))
                return add("The last bits of textures: 16 linear bits become 8 bits of sRGB.");
    }

    void emitters_that_light_nothing() {
        bool emits = false, reflects = false;
        for (const Object &object : scene_.objects)
            if (const Surface *surface = surface_of(object.shape))
                std::visit(overloaded{[&](const Diffuse &) { reflects = true; },
                                      [&](const Emissive &) { emits = true; },
                                      [&](const CoordinateCard &) { emits = true; }},
                           *surface);
        if (emits && (reflects || has_glass()))
            add("That emitters are only seen, and light no diffuse surface: a path tracer will let them.");
    }

    void film() {
        if (scene_.camera.crop) add("The window of the film: the camera has the whole film.");
        if (scene_.camera.film_offset_px != Vec2(0)) add("The shift of the film by a part of a pixel.");
    }

private:
    const Scene &scene_;
    Needs needs_;
    std::vector<std::string> list_;
};

std::vector<std::string> losses_of_glb(const Scene &scene) {
    Features f(scene);
    if (f.has_glass())
        f.add("Exact refraction: index and thickness are said, but most viewers bend what lies behind glass only "
              "roughly, and may not show that an orb inverts.");
    f.glass_shadow();
    f.environment();
    f.glass_details();
    f.facets();
    f.textures();
    f.emitters_that_light_nothing();
    f.film();
    return f.take();
}

std::vector<std::string> losses_of_obj(const Scene &scene) {
    Features f(scene);
    f.add("The camera.");
    if (f.has_lights()) f.add(fmt::format("The lights: {} parallel ones.", scene.lights.size()));
    f.environment();
    if (f.has_glass()) f.add("What glass is: the material has index and illumination model 7, which few readers heed.");
    f.glass_shadow();
    f.glass_details();
    f.facets();
    f.textures();
    f.emitters_that_light_nothing();
    f.add("The unit: numbers are millimetres, and the format has no way to say so.");
    return f.take();
}

std::vector<std::string> losses_of_stmap(const Scene &scene) {
    Features f(scene);
    f.add("All light: the map says where the refracted ray lands, not how bright anything is.");
    if (f.has_glass()) f.add("Reflections: of each branching ray only the refracted part is followed.");
    f.add("Edges: each pixel is its centre's ray, so the border of the map is not smooth.");
    return f.take();
}

std::vector<std::string> losses_of_mitsuba(const Scene &scene) {
    std::vector<std::string> all;
    for (const MitsubaLoss &loss : to_mitsuba(scene, "scene").losses) all.push_back(loss.what);
    return all;
}

} // namespace

std::vector<std::string> losses(const Scene &scene, ExportFormat format) {
    switch (format) {
    case ExportFormat::blender: // what these two cannot say exactly, their adapters refuse
    case ExportFormat::povray:
        return {};
    case ExportFormat::glb:
        return losses_of_glb(scene);
    case ExportFormat::obj:
        return losses_of_obj(scene);
    case ExportFormat::mitsuba:
        return losses_of_mitsuba(scene);
    case ExportFormat::stmap:
        return losses_of_stmap(scene);
    }
    return {};
}

std::string losses_text(const std::vector<std::string> &losses, ExportFormat format) {
    if (losses.empty()) return fmt::format("Nothing is lost: {} says all of this scene.\n", entry_of(format).title);
    std::string text = fmt::format("What {} cannot say of this scene:\n\n", entry_of(format).title);
    for (const std::string &loss : losses) text += "- " + loss + "\n";
    return text;
}

} // namespace threefold
