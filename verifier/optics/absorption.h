// SPDX-License-Identifier: MIT
// How far light goes in the glass of an orb. Lengths in millimetres.
#pragma once

#include "verifier/optics/orb.h"

namespace threefold::optics {

/// Of one leg as optics::Order counts them: one crossing of a shell's wall (towards its hollow or from it, or to the
/// place of total reflection), or one chord of a ball. Pythagoras on the half chords; valid for 0 <= b <= R.
template <class T>
T glass_leg_mm(const Orb<T> &orb, const Impact<T> &impact) {
    const T outer = outer_chords(orb, impact).glass_mm;
    if (course(orb, impact) == Course::through_glass) return 2 * outer;
    return outer - inner_chords(orb, impact).glass_mm;
}

} // namespace threefold::optics
