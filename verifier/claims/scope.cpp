// SPDX-License-Identifier: MIT
#include "verifier/claims/scope.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace threefold {

const std::array<EffectEntry, 8> &effects() {
    static constexpr std::array<EffectEntry, 8> all{{
        {Effect::polarisation, "polarisation", "polarisation carried from surface to surface"},
        {Effect::dispersion, "dispersion", "the index runs over the visible range"},
        {Effect::absorption, "absorption", "light lost on its way in the glass"},
        {Effect::birefringence, "birefringence", "strain in glass; a crystal's own double refraction"},
        {Effect::light_size, "light-size", "lights with a disc in place of parallel light"},
        {Effect::caustics, "caustics", "light that glass gathers on surfaces"},
        {Effect::interreflection, "interreflection", "light that surfaces throw on each other"},
        {Effect::pupil, "pupil", "an eye with a pupil in place of a pinhole"},
    }};
    return all;
}

std::string_view to_string(Effect effect) { return std::ranges::find(effects(), effect, &EffectEntry::effect)->name; }

Bound::Bound(PictureChange change, std::string why_)
    : value(std::numeric_limits<double>::quiet_NaN()), why(std::move(why_)),
      picture(std::make_shared<const PictureChange>(std::move(change))) {}

Bound Bound::none(std::string why) {
    Bound bound(0, std::move(why));
    bound.depends = false;
    return bound;
}

const Bound &EffectBounds::of(Effect effect) const {
    switch (effect) {
    case Effect::polarisation:
        return polarisation;
    case Effect::dispersion:
        return dispersion;
    case Effect::absorption:
        return absorption;
    case Effect::birefringence:
        return birefringence;
    case Effect::light_size:
        return light_size;
    case Effect::caustics:
        return caustics;
    case Effect::interreflection:
        return interreflection;
    case Effect::pupil:
        break;
    }
    return pupil;
}

bool ScopeNumber::requires_effect(Effect effect) const {
    const Bound &bound = bounds.of(effect);
    if (std::isnan(margin)) return false; // the number itself does not exist in this scene
    // What could not be told may be anything; a picture that was not asked has said nothing yet.
    return bound.depends && !bound.picture && !(bound.value <= margin);
}

const ScopeNumber *most_moved(const std::vector<ScopeNumber> &numbers, Effect effect) {
    const ScopeNumber *most = nullptr;
    double most_share = -1;
    for (const ScopeNumber &n : numbers) {
        const Bound &bound = n.bounds.of(effect);
        if (!bound.depends) continue;
        double share = bound.value == 0 ? 0 : bound.value / n.margin;
        if (std::isnan(share)) share = bound.picture ? 0 : std::numeric_limits<double>::infinity();
        if (share <= most_share) continue;
        most_share = share;
        most = &n;
    }
    return most;
}

std::string scope_sentence(const ScopeNumber &number, Effect effect) {
    const std::string unit = number.unit.empty() ? "" : " " + number.unit;
    return fmt::format("{} could move the {} ({:.4g}{}) by {:.2g}{}, more than its margin of {:.2g}{} ({}): it is told "
                       "within its model only",
                       to_string(effect), number.quantity, number.value, unit, number.bounds.of(effect).value, unit,
                       number.margin, unit, number.margin_is);
}

Accuracy reference_accuracy() {
    Accuracy a;
    a.radiance_step = 0.5 / 65535;
    return a;
}

} // namespace threefold
