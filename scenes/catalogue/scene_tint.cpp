// SPDX-License-Identifier: MIT
// The study's tinted glass: 0.89 of the light passes each surface, and the robe behind the orb is darkened.
#include "scenes/catalogue/catalogue.h"
#include "scenes/catalogue/plain_card.h"

namespace threefold {

SceneRecipe tint_scene() {
    return {"tint", "a hollow orb of tinted glass before a card",
            plain_card_parameters({.interface_transmittance = 0.89,
                                   .card_half_width_mm = 300,
                                   .card_radiance = 1,
                                   .environment_radiance = 0.2}),
            build_plain_card};
}

} // namespace threefold
