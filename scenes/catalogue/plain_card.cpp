// SPDX-License-Identifier: MIT
#include "scenes/catalogue/plain_card.h"

#include <algorithm>

#include "scenes/catalogue/textures.h"

namespace threefold {

Specs plain_card_parameters(const PlainCardDefaults &defaults) {
    Specs card = card_parameters();
    std::erase_if(card, [](const ParameterSpec &s) { return s.name == "card.surface"; });
    ParameterSpec surface{"card.surface", "textured: the robe; plain: the same radiance all over"};
    surface.choices = {"textured", "plain"};
    ParameterSpec radiance{"card.radiance", "radiance of a plain card"};
    radiance.text = radiance.published = defaults.card_radiance;
    radiance.least = 0;
    radiance.greatest = 1e6;
    ParameterSpec contrast{"criterion.contrast", "least contrast that counts as seen: a claim's threshold"};
    contrast.text = contrast.published = 0.02;
    contrast.least = 0;
    contrast.greatest = 1;

    Specs all = join({orb_parameters(),
                      wall_parameters(),
                      glass_parameters(),
                      view_parameters(),
                      card,
                      {surface, radiance},
                      environment_parameters(defaults.environment_radiance),
                      {contrast}});
    for (ParameterSpec &s : all) {
        if (s.name == "glass.interface_transmittance") s.text = s.published = defaults.interface_transmittance;
        if (s.name == "card.half_width_mm") s.text = s.published = defaults.card_half_width_mm;
    }
    return all;
}

Scene build_plain_card(const Parameters &p) {
    const double half = p.number("card.half_width_mm");
    Quad card{{0, 0, -p.number("card.distance_mm")}, {half, 0, 0}, {0, half, 0}, Emissive{}};
    const bool plain = p.word("card.surface") == "plain";
    card.surface = Emissive{plain ? Paint(Rgb(p.number("card.radiance"))) : Paint(robe_texture())};
    Scene scene;
    scene.objects = {{"orb", make_shell(p)}, {"card", card}};
    scene.environment = make_environment(p);
    scene.camera = make_camera(p);
    return scene;
}

} // namespace threefold
