// SPDX-License-Identifier: MIT
// Three dark lines seen through an orb (figure 4 of the study): the middle one lies in a plane with the eye and the
// orb's centre, two stand beside it; the same with the middle one bent outside the orb; the set-up from aside.
#include <cmath>
#include <numbers>

#include "scenes/catalogue/catalogue.h"
#include "scenes/catalogue/movie_camera.h"
#include "scenes/catalogue/three_lines.h"

namespace threefold {

namespace {

ParameterSpec orb_kind() {
    ParameterSpec kind{"orb.kind", "hollow or solid"};
    kind.choices = {"hollow", "solid"};
    return kind;
}

/// The orb stands last: what a claim calls the card of the scene is its first rectangle.
Scene with_orb(const Parameters &p, std::vector<Object> objects, const Shape &orb) {
    Scene scene;
    scene.objects = std::move(objects);
    scene.objects.push_back({"orb", orb});
    scene.environment = make_environment(p);
    scene.camera.eye_mm = {0, 0, p.number("eye.distance_mm")};
    scene.camera.width_px = static_cast<int>(p.number("image.width_px"));
    scene.camera.height_px = static_cast<int>(p.number("image.height_px"));
    return scene;
}

Scene from_the_eye(const Parameters &p, const Shape &orb) {
    Scene scene = with_orb(p, three_lines_objects(p), orb);
    scene.camera.horizontal_fov_deg = p.number("image.horizontal_fov_deg");
    return scene;
}

Shape orb_of_kind(const Parameters &p) {
    return p.word("orb.kind") == "solid" ? Shape(make_ball(p)) : Shape(make_shell(p));
}

ParameterSpec field_of_view(double degrees) {
    return number_parameter("image.horizontal_fov_deg", "field of view across the picture", degrees, degrees, 1e-3,
                            179);
}

constexpr double half_length_mm = 300, setup_half_length_mm = 600;

/// Untinted glass in uniform surroundings vanishes: seen from aside it is tinted a little.
constexpr double setup_interface_transmittance = 0.95;

Specs setup_orb_parameters() {
    Specs specs = three_lines_orb_parameters(true);
    for (ParameterSpec &s : specs)
        if (s.name == "glass.interface_transmittance") s.text = s.published = setup_interface_transmittance;
    return specs;
}

} // namespace

SceneRecipe three_lines_solid_scene() {
    return {"three-lines-solid", "three dark lines behind a solid orb, the middle one in line with eye and centre",
            join({three_lines_orb_parameters(false),
                  three_lines_parameters(half_length_mm),
                  three_lines_image_parameters(),
                  {field_of_view(10)}}),
            [](const Parameters &p) { return from_the_eye(p, make_ball(p)); }};
}

SceneRecipe three_lines_hollow_scene() {
    return {"three-lines-hollow", "three dark lines behind a hollow orb, the middle one in line with eye and centre",
            join({three_lines_orb_parameters(true),
                  three_lines_parameters(half_length_mm),
                  three_lines_image_parameters(),
                  {field_of_view(10)}}),
            [](const Parameters &p) { return from_the_eye(p, make_shell(p)); }};
}

SceneRecipe three_lines_bent_scene() {
    const Specs bent{
        orb_kind(),
        number_parameter("lines.bend_beyond_mm",
                         "where the middle line bends, beyond the orb's edge to the upper right", 4, 12, 1e-9, 1e9),
        number_parameter("image.centre_mm", "the parallel view's centre, to the right of the axis and above it", 39, 39,
                         -1e9, 1e9),
        number_parameter("image.width_mm", "what the parallel view spans across the picture", 70, 70, 1e-9, 1e9)};
    return {"three-lines-bent", "the middle one of the three lines bent outside the orb, in a parallel view",
            join({three_lines_orb_parameters(true), three_lines_parameters(half_length_mm),
                  three_lines_image_parameters(), bent}),
            [](const Parameters &p) {
                Scene scene = with_orb(p, bent_lines_objects(p), orb_of_kind(p));
                const double centre = p.number("image.centre_mm");
                scene.camera.projection = Projection::orthographic;
                scene.camera.eye_mm += Vec3(centre, centre, 0);
                scene.camera.target_mm = {centre, centre, 0};
                scene.camera.orthographic_width_mm = p.number("image.width_mm");
                return scene;
            }};
}

SceneRecipe three_lines_setup_scene() {
    const Specs setup{orb_kind(), field_of_view(24),
                      number_parameter("setup.turn_deg", "how far below the axis of eye and orb the picture is taken",
                                       70, 70, -180, 180),
                      number_parameter("setup.camera_mm",
                                       "orb centre to the lens of the movie camera that stands for the eye", 108, 108,
                                       1e-9, 1e9)};
    return {"three-lines-setup", "lines, orb and a camera in the eye's place, seen from aside",
            join({setup_orb_parameters(), three_lines_parameters(setup_half_length_mm), three_lines_image_parameters(),
                  setup}),
            [](const Parameters &p) {
                constexpr double camera_length_mm = 73;
                Scene scene = with_orb(p, three_lines_objects(p), orb_of_kind(p));
                scene.camera.horizontal_fov_deg = p.number("image.horizontal_fov_deg");
                const double turn = p.number("setup.turn_deg") * std::numbers::pi / 180;
                scene.camera.eye_mm = p.number("eye.distance_mm") * Vec3(0, -std::sin(turn), std::cos(turn));
                scene.camera.up = {0, std::cos(turn), std::sin(turn)};
                scene.objects.push_back(
                    {"movie camera", movie_camera({0, 0, p.number("setup.camera_mm")}, {0, 0, -1}, {-1, 0, 0},
                                                  camera_length_mm, p.number("environment.radiance"))});
                return scene;
            }};
}

} // namespace threefold
