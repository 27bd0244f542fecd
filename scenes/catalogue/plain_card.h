// SPDX-License-Identifier: MIT
// A hollow orb before a card of one even radiance, or the robe: what the claims about tint and the dark layer measure.
#pragma once

#include "scenes/catalogue/common.h"

namespace threefold {

struct PlainCardDefaults {
    double interface_transmittance, card_half_width_mm, card_radiance, environment_radiance;
};

/// Those of `hollow`, with `card.surface` textured or plain, `card.radiance`, and `criterion.contrast`: the least
/// contrast (Weber) that counts as seen, a threshold of claims and nothing in the scene.
Specs plain_card_parameters(const PlainCardDefaults &defaults);
Scene build_plain_card(const Parameters &p);

} // namespace threefold
