// SPDX-License-Identifier: MIT
#include "scenes/catalogue/composition.h"

#include <cmath>
#include <initializer_list>
#include <numbers>

#include <fmt/format.h>

#include "scenes/access.h"
#include "scenes/error.h"
#include "scenes/figure/hand.h"
#include "scenes/figure/light.h"
#include "scenes/geometry.h"

namespace threefold {

namespace {

// The study's picture: 21.271 degrees wide, seen from 1200 mm, its relief's ground 297.5 mm behind the orb.
constexpr Vec2 eye_beside_orb_mm{-143.4, 234.12312};
constexpr double study_eye_mm = 1200, study_robe_mm = 297.5, study_fov_deg = 21.271;
constexpr double study_robe_scale = 1.19;
constexpr Vec2 study_robe_mm_from_axis{-0.68, -3.98};

/// Half the picture's width at the orb.
double half_width_at_orb_mm() { return study_eye_mm * std::tan(study_fov_deg * std::numbers::pi / 360); }

ParameterSpec length(std::string name, std::string description, double value) {
    return {.name = std::move(name),
            .description = std::move(description),
            .text = value,
            .published = value,
            .least = -1e9,
            .greatest = 1e9};
}

ParameterSpec file(std::string name, std::string description) {
    return {.name = std::move(name), .description = std::move(description), .path = true};
}

ParameterSpec axes(std::string name) {
    return {.name = std::move(name),
            .description = "axes of the mesh's file; study: x towards the eye, y up, z to the picture's left; "
                           "ours: x to its right, y up, z towards the eye",
            .choices = {"study", "ours"}};
}

ParameterSpec unit(std::string name) {
    return {.name = std::move(name),
            .description = "length of one unit of the mesh's file",
            .text = 10,
            .published = 10,
            .least = 1e-9,
            .greatest = 1e9};
}

/// A user's mesh in our axes and in millimetres.
Mesh read_mesh(const Parameters &p, const std::string &what) {
    Mesh mesh = p.files().mesh(p.word(what + ".mesh"));
    const double unit_mm = p.number(what + ".mesh_unit_mm");
    const bool study = p.word(what + ".mesh_axes") == "study";
    for (Vec3 &v : mesh.vertices_mm) v = unit_mm * (study ? Vec3(-v.z, v.y, v.x) : v);
    return mesh;
}

std::shared_ptr<const Texture> read_texture(const Parameters &p, const std::string &what, const Mesh &mesh) {
    const std::string &path = p.word(what + ".texture");
    if (mesh.uv.empty())
        throw Error(Exit::bad_data, fmt::format("{0}.texture={1}: the mesh {2} has no texture coordinates", what, path,
                                                p.word(what + ".mesh")));
    return p.files().texture(path, p.number(what + ".texture_gamma"));
}

bool given(const Parameters &p, const std::string &name) { return !p.word(name).empty(); }

/// What says how a file is taken means nothing without the file: it is refused, not ignored.
void require_file_for(const Parameters &p, const std::string &file, std::initializer_list<const char *> means) {
    if (given(p, file)) return;
    const Parameters usual(p.specs(), p.preset());
    for (const std::string mean : means)
        if (p.text(mean) != usual.text(mean))
            throw Error(Exit::bad_data, fmt::format("{}={} means nothing without {}", mean, p.text(mean), file),
                        fmt::format("--set {}=FILE", file));
}

Mesh make_hand(const Parameters &p) {
    require_file_for(p, "hand.mesh",
                     {"hand.mesh_unit_mm", "hand.mesh_axes", "hand.mesh_x_mm", "hand.mesh_y_mm", "hand.mesh_z_mm"});
    require_file_for(p, "hand.texture", {"hand.texture_gamma"});
    const bool own = given(p, "hand.mesh");
    Mesh hand = own ? read_mesh(p, "hand") : figure::holding_hand(orb_centre(p), p.number("orb.radius_mm"));
    const double drop = p.number("hand.drop_mm");
    for (Vec3 &v : hand.vertices_mm) v.y -= drop;
    if (own)
        for (Vec3 &v : hand.vertices_mm)
            v += Vec3(p.number("hand.mesh_x_mm"), p.number("hand.mesh_y_mm"), p.number("hand.mesh_z_mm")) +
                 orb_centre(p);
    if (given(p, "hand.texture"))
        hand.surface = Diffuse{read_texture(p, "hand", hand)};
    else if (own)
        hand.surface = Diffuse{Rgb(0.45, 0.27, 0.15)};
    else
        hand.surface = Diffuse{figure::hand_texture()};
    return hand;
}

Mesh make_robe(const Parameters &p) {
    require_file_for(p, "robe.mesh", {"robe.mesh_unit_mm", "robe.mesh_axes"});
    require_file_for(p, "robe.texture", {"robe.texture_gamma"});
    const figure::Standpoint view = standpoint(p);
    const bool own = given(p, "robe.mesh");
    Mesh robe = own ? read_mesh(p, "robe") : figure::relief(view, static_cast<int>(p.number("robe.relief_resolution")));
    if (own) {
        // As the study places its relief, and in the same proportion to the picture at other distances.
        const double study_unit = half_width_at_orb_mm() * (1 + study_robe_mm / study_eye_mm);
        const double scale = view.unit_mm() / study_unit;
        const Vec3 origin(view.eye_mm.x + scale * study_robe_mm_from_axis.x,
                          view.eye_mm.y + scale * study_robe_mm_from_axis.y, view.plane_z_mm);
        for (Vec3 &v : robe.vertices_mm) v = origin + study_robe_scale * scale * v;
    }
    for (Vec3 &v : robe.vertices_mm) v.x += p.number("robe.shift_mm");
    const double nearest = distance_to(robe, orb_centre(p));
    if (nearest < p.number("orb.radius_mm"))
        throw Error(Exit::bad_data,
                    fmt::format("the robe reaches into the orb ({:.4g} mm from its centre, radius {:g} mm): "
                                "card.distance_mm must be larger, or orb.radius_mm smaller",
                                nearest, p.number("orb.radius_mm")));
    if (given(p, "robe.texture"))
        robe.surface = Diffuse{read_texture(p, "robe", robe)};
    else if (own && robe.uv.empty())
        robe.surface = Diffuse{Rgb(0.2)};
    else
        robe.surface = Diffuse{figure::relief_texture()};
    return robe;
}

/// The study's black rectangle behind the relief.
Quad make_ground(const figure::Standpoint &view) {
    const double behind = 1.1; // of the relief's distance from the eye
    const double distance = behind * (view.eye_mm.z - view.plane_z_mm);
    const double half = 1.1 * view.half_angle_tangent * distance;
    return {{view.eye_mm.x, view.eye_mm.y, view.eye_mm.z - distance},
            {half, 0, 0},
            {0, half * figure::picture_height, 0},
            Diffuse{Rgb(0)}};
}

} // namespace

Specs composition_parameters() {
    Specs glass = glass_parameters();
    for (ParameterSpec &s : glass)
        if (s.name == "glass.interface_transmittance") s.published = 0.89; // the study's tint
    glass.push_back({.name = "glass.shadow_transmittance",
                     .description = "share of the light that the orb lets through to what lies in its shadow",
                     .text = 0.8,
                     .published = 0.8,
                     .least = 0,
                     .greatest = 1});
    const Specs kind{{.name = "orb.kind", .description = "hollow or solid", .choices = {"hollow", "solid"}}};
    const Specs distances{{.name = "eye.distance_mm",
                           .description = "eye to orb centre, along the view",
                           .text = 900,
                           .published = 1200,
                           .least = 1e-9,
                           .greatest = 1e9},
                          {.name = "card.distance_mm",
                           .description = "orb centre to the robe's ground",
                           .text = 250,
                           .published = 297.5,
                           .least = 1e-9,
                           .greatest = 1e9}};
    Specs surroundings = environment_parameters(0.02);
    surroundings.push_back({.name = "environment.dome_directions",
                            .description = "parallel lights that stand for the environment's light on surfaces",
                            .text = 48,
                            .published = 48,
                            .least = 1,
                            .greatest = 1e5,
                            .whole = true});
    const Specs figure_own{
        {.name = "figure.surface",
         .description = "painted; or identity: hand red, robe green, ground blue, all else black, each alike all over",
         .choices = {"painted", "identity"}},
        file("hand.mesh", "a hand of one's own; none: a generated one, which grows with the orb"),
        unit("hand.mesh_unit_mm"),
        axes("hand.mesh_axes"),
        length("hand.mesh_x_mm", "the mesh's origin from the orb's centre, to the picture's right", -144.124),
        length("hand.mesh_y_mm", "the same, upwards", 219),
        length("hand.mesh_z_mm", "the same, towards the eye", -344.268),
        length("hand.drop_mm", "how far the hand is lowered from its hold (negative: pushed up into the orb)", 0),
        file("hand.texture", "an image for the hand, by its mesh's texture coordinates"),
        {.name = "hand.texture_gamma",
         .description = "reflectance = sample to this power; 0: as the file declares",
         .least = 0,
         .greatest = 10},
        file("robe.mesh", "a relief of one's own, placed as the study places its own; none: a generated one"),
        unit("robe.mesh_unit_mm"),
        axes("robe.mesh_axes"),
        length("robe.shift_mm", "robe moved sideways, to the right of the picture", 0),
        file("robe.texture",
             "an image for the relief, by its mesh's texture coordinates; for the generated one, of the whole picture"),
        {.name = "robe.texture_gamma",
         .description = "reflectance = sample to this power (the study's: 3); 0: as the file declares",
         .text = 3,
         .published = 3,
         .least = 0,
         .greatest = 10},
        {.name = "robe.relief_resolution",
         .description = "vertices in a row of the generated relief",
         .text = figure::usual_relief_columns,
         .published = figure::usual_relief_columns,
         .least = 2,
         .greatest = 2000,
         .whole = true}};
    return join({kind, orb_parameters(), wall_parameters(), glass, distances, surroundings, figure_own});
}

Specs picture_size_parameters(int width_px, int height_px) {
    const auto pixels = [](std::string name, std::string description, int value, double least) {
        return ParameterSpec{.name = std::move(name),
                             .description = std::move(description),
                             .text = static_cast<double>(value),
                             .published = static_cast<double>(value),
                             .least = least,
                             .greatest = 1e6,
                             .whole = true};
    };
    return {pixels("image.width_px", "width of the picture", width_px, 1),
            pixels("image.height_px", "height of the picture", height_px, 1)};
}

figure::Standpoint standpoint(const Parameters &p) {
    const double eye = p.number("eye.distance_mm");
    return {Vec3(eye_beside_orb_mm, eye), half_width_at_orb_mm() / eye, -p.number("card.distance_mm")};
}

Camera eye_camera(const Parameters &p) {
    const figure::Standpoint view = standpoint(p);
    Camera camera;
    camera.eye_mm = view.eye_mm;
    camera.target_mm = {view.eye_mm.x, view.eye_mm.y, 0};
    camera.horizontal_fov_deg = 360 / std::numbers::pi * std::atan(view.half_angle_tangent);
    camera.width_px = static_cast<int>(p.number("image.width_px"));
    camera.height_px = static_cast<int>(p.number("image.height_px"));
    return camera;
}

Scene composition(const Parameters &p) {
    Scene scene;
    scene.objects = {{"orb", p.word("orb.kind") == "solid" ? Shape(make_ball(p)) : Shape(make_shell(p))},
                     {"hand", make_hand(p)},
                     {"robe", make_robe(p)},
                     {"ground", make_ground(standpoint(p))}};
    if (p.word("figure.surface") == "identity") {
        for (Object &object : scene.objects)
            if (Surface *surface = surface_of(object.shape)) *surface = Emissive{identity_colour(object.name)};
        return scene;
    }
    scene.lights = study_lights();
    scene.environment =
        Environment{Rgb(p.number("environment.radiance")), static_cast<int>(p.number("environment.dome_directions"))};
    scene.glass_shadow = {GlassShadow::Rule::constant, p.number("glass.shadow_transmittance")};
    return scene;
}

Rgb identity_colour(std::string_view object) {
    return {object == "hand" ? 1 : 0, object == "robe" ? 1 : 0, object == "ground" ? 1 : 0};
}

} // namespace threefold
