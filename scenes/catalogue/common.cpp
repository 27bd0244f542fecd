// SPDX-License-Identifier: MIT
#include "scenes/catalogue/common.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "scenes/catalogue/textures.h"
#include "scenes/error.h"

namespace threefold {

namespace {

ParameterSpec word(std::string name, std::string description, std::vector<std::string> choices) {
    ParameterSpec s{std::move(name), std::move(description)};
    s.choices = std::move(choices);
    return s;
}

ParameterSpec pixels(std::string name, std::string description) {
    ParameterSpec s = number_parameter(std::move(name), std::move(description), 256, 256, 1, 1e6);
    s.whole = true;
    return s;
}

} // namespace

ParameterSpec number_parameter(std::string name, std::string description, double text, double published, double least,
                               double greatest) {
    ParameterSpec s{std::move(name), std::move(description)};
    s.text = text;
    s.published = published;
    s.least = least;
    s.greatest = greatest;
    return s;
}

ParameterSpec number_parameter(std::string name, std::string description, double value, double least, double greatest) {
    return number_parameter(std::move(name), std::move(description), value, value, least, greatest);
}

Specs orb_parameters() {
    return {
        number_parameter("orb.radius_mm", "outer radius of the orb", 68, 67.98, tiny_mm, huge_mm),
        number_parameter("orb.shift_mm", "orb moved sideways, to the right of the picture", 0, 0, -huge_mm, huge_mm)};
}

Specs wall_parameters() {
    return {number_parameter("orb.wall_mm", "thickness of the glass wall", 1.3, 1.36, tiny_mm, huge_mm)};
}

Specs glass_parameters() {
    return {number_parameter("glass.index", "index of the glass in air", 1.51714, 1.51714, 1, 10),
            number_parameter("glass.interface_transmittance", "factor on light at each crossing of a glass surface", 1,
                             1, 0, 1),
            word("glass.coating", "fresnel: reflects as glass does; antireflective: only total reflection is left",
                 {"fresnel", "antireflective"})};
}

Specs view_parameters() {
    return {
        number_parameter("eye.distance_mm", "eye to orb centre", 900, 1200, tiny_mm, huge_mm),
        pixels("image.width_px", "width of the picture"), pixels("image.height_px", "height of the picture"),
        number_parameter("image.orb_share", "share of the picture's width that the orb fills", 0.8, 0.8, 1e-6, 100)};
}

Specs card_parameters() {
    return {number_parameter("card.distance_mm", "orb centre to card", 250, 297.5, tiny_mm, huge_mm),
            number_parameter("card.half_width_mm", "half the side of the square card", 300, 300, tiny_mm, huge_mm),
            word("card.surface",
                 "textured: the robe; coordinate: the probe that says where each ray lands, in the dark",
                 {"textured", "coordinate"})};
}

Specs environment_parameters(double radiance) {
    return {number_parameter("environment.radiance", "radiance of the surroundings", radiance, radiance, 0, 1e6)};
}

Specs join(std::initializer_list<Specs> parts) {
    Specs all;
    for (const Specs &part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
}

Vec3 orb_centre(const Parameters &p) { return {p.number("orb.shift_mm"), 0, 0}; }

Glass make_glass(const Parameters &p) {
    return {p.number("glass.index"), p.number("glass.interface_transmittance"),
            p.word("glass.coating") == "antireflective" ? Coating::antireflective : Coating::fresnel};
}

GlassBall make_ball(const Parameters &p) { return {orb_centre(p), p.number("orb.radius_mm"), make_glass(p)}; }

GlassShell make_shell(const Parameters &p) {
    return {orb_centre(p), p.number("orb.radius_mm"), p.number("orb.wall_mm"), make_glass(p)};
}

Camera make_camera(const Parameters &p) {
    const double radius = p.number("orb.radius_mm"), eye = p.number("eye.distance_mm");
    if (!(eye > radius))
        throw Error(Exit::bad_data,
                    fmt::format("the eye ({} mm from the orb's centre) lies inside the orb of radius {} mm: "
                                "eye.distance_mm must be greater than orb.radius_mm",
                                eye, radius));
    const double silhouette = radius / std::sqrt((eye - radius) * (eye + radius)); // tangent of its angular radius
    Camera camera;
    camera.eye_mm = {0, 0, eye};
    camera.horizontal_fov_deg = 360 / std::numbers::pi * std::atan(silhouette / p.number("image.orb_share"));
    camera.width_px = static_cast<int>(p.number("image.width_px"));
    camera.height_px = static_cast<int>(p.number("image.height_px"));
    return camera;
}

Quad make_card(const Parameters &p) {
    const double half = p.number("card.half_width_mm");
    Quad card{{0, 0, -p.number("card.distance_mm")}, {half, 0, 0}, {0, half, 0}, CoordinateCard{}};
    if (p.word("card.surface") == "textured") card.surface = Emissive{robe_texture()};
    return card;
}

std::optional<Environment> make_environment(const Parameters &p) {
    if (p.has("card.surface") && p.word("card.surface") == "coordinate") return std::nullopt;
    return Environment{Rgb(p.number("environment.radiance"))};
}

} // namespace threefold
