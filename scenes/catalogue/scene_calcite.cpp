// SPDX-License-Identifier: MIT
// Figure 7 of the study: calcite as two isotropic balls, one for each of its principal indices. A scene shows one of
// them; the mean of the two pictures is the study's calcite. Walk-off is left out, as in the study.
#include "scenes/catalogue/catalogue.h"
#include "scenes/catalogue/common.h"

namespace threefold {

namespace {

ParameterSpec index_parameter(std::string name, std::string description, double value) {
    ParameterSpec s{std::move(name), std::move(description)};
    s.text = s.published = value;
    s.least = 1;
    s.greatest = 10;
    return s;
}

Specs calcite_parameters() {
    ParameterSpec ray{"calcite.ray", "which of the two images; the mean of both pictures is the study's calcite"};
    ray.choices = {"ordinary", "extraordinary"};
    ParameterSpec ratio{"criterion.ratio", "how many times the separation counts as far more: a claim's threshold"};
    ratio.text = ratio.published = 3;
    ratio.least = 0;
    ratio.greatest = 1e6;
    Specs glass = glass_parameters();
    std::erase_if(glass, [](const ParameterSpec &s) { return s.name == "glass.index"; });
    return join(
        {{index_parameter("calcite.ordinary_index", "index of calcite's ordinary ray", 1.658),
          index_parameter("calcite.extraordinary_index", "least index of its extraordinary ray", 1.486), ray, ratio},
         glass});
}

} // namespace

SceneRecipe calcite_scene() {
    return {"calcite", "a solid calcite ball before a card, by one of its two rays",
            join({calcite_parameters(), orb_parameters(), view_parameters(), card_parameters(),
                  environment_parameters(0.2)}),
            [](const Parameters &p) {
                const Coating coating =
                    p.word("glass.coating") == "antireflective" ? Coating::antireflective : Coating::fresnel;
                const Glass glass{p.number("calcite." + p.word("calcite.ray") + "_index"),
                                  p.number("glass.interface_transmittance"), coating};
                Scene scene;
                scene.objects = {{"orb", GlassBall{orb_centre(p), p.number("orb.radius_mm"), glass}},
                                 {"card", make_card(p)}};
                scene.environment = make_environment(p);
                scene.camera = make_camera(p);
                return scene;
            }};
}

} // namespace threefold
