// SPDX-License-Identifier: MIT
// Figure 5C of the study: a hollow orb in dim surroundings before a brighter robe, which ends a little outside the orb.
#include "scenes/catalogue/catalogue.h"
#include "scenes/catalogue/plain_card.h"

namespace threefold {

SceneRecipe dark_layer_scene() {
    return {"dark-layer", "a hollow orb in dim surroundings before a brighter card",
            plain_card_parameters({.interface_transmittance = 1,
                                   .card_half_width_mm = 100,
                                   .card_radiance = 0.2,
                                   .environment_radiance = 0.02}),
            build_plain_card};
}

} // namespace threefold
