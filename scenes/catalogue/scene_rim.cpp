// SPDX-License-Identifier: MIT
// The edge of a hollow orb in the dark, and a coordinate card that can be turned about it to where its rays go.
#include <cmath>
#include <numbers>

#include "scenes/catalogue/catalogue.h"
#include "scenes/catalogue/common.h"

namespace threefold {

namespace {

Specs turned_card_parameters() {
    ParameterSpec bearing{"card.bearing_deg", "card turned about the orb, from behind it to the right"};
    bearing.least = -180;
    bearing.greatest = 180;
    Specs card = card_parameters();
    std::erase_if(card, [](const ParameterSpec &s) { return s.name == "card.surface"; });
    return join({card, {bearing}});
}

} // namespace

SceneRecipe rim_scene() {
    return {
        "rim", "a hollow orb in the dark, and a coordinate card that catches what its edge sends aside",
        join({orb_parameters(), wall_parameters(), glass_parameters(), view_parameters(), turned_card_parameters()}),
        [](const Parameters &p) {
            const double bearing = p.number("card.bearing_deg") * std::numbers::pi / 180;
            const double half = p.number("card.half_width_mm");
            const Vec3 towards(std::sin(bearing), 0, -std::cos(bearing));
            const Vec3 across(std::cos(bearing), 0, std::sin(bearing));
            Scene scene;
            scene.objects = {
                {"orb", make_shell(p)},
                {"card", Quad{towards * p.number("card.distance_mm"), across * half, {0, half, 0}, CoordinateCard{}}}};
            scene.camera = make_camera(p);
            return scene;
        }};
}

} // namespace threefold
