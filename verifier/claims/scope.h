// SPDX-License-Identifier: MIT
// What a claim's model leaves out, and how far each of it could move the claim's numbers. Every claim answers for every
// effect: a number's `EffectBounds` has one field an effect, and none of them can be left empty.
//
// Margin of a number. Where a conclusion lies on one side of a threshold: the distance from the number, by the closed
// form, to the threshold at which the conclusion flips. Where the conclusion is an equality: the tolerance that `check`
// would give an exact renderer which stores 16 bits (reference_accuracy), the narrowest that any number is held to.
// An effect is required when its bound is greater than the margin: the claim then holds within its model only.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "exporter/job.h"
#include "scenes/scene.h"

namespace threefold {

enum class Effect {
    polarisation,
    dispersion,
    absorption,
    birefringence,
    light_size,
    caustics,
    interreflection,
    pupil,
};

struct EffectEntry {
    Effect effect;
    std::string_view name;    ///< "light-size", for JSON and tables
    std::string_view meaning; ///< "the sun's disc in place of parallel light"
};
const std::array<EffectEntry, 8> &effects();
std::string_view to_string(Effect effect);

/// The world that a bound is reckoned for. Defaults: a borosilicate crown glass, the sun, an eye in daylight.
struct ScopeSettings {
    double abbe_number = 64.2; ///< BK7: 64.17
    double least_wavelength_nm = 400, greatest_wavelength_nm = 700;
    double absorption_per_mm = 3e-4; ///< natural logarithm; BK7 lets 0.997 of 400 nm through 10 mm
    double strain_nm_per_cm = 20;    ///< path difference by strain, the coarsest grade of ISO 10110-2 for images
    double light_deg = 0.53;         ///< across: the sun
    double pupil_mm = 4;             ///< across
    double calcite_abbe_ordinary = 48.8,
           calcite_abbe_extraordinary = 78.5; ///< n_F, n_C: 1.6679, 1.6544; 1.4908, 1.4846
};

/// A question for whoever can render: how far do the means of a picture's tiles move when the scene is another one?
struct PictureChange {
    Scene as_it_is;
    std::vector<Scene> instead; ///< the worst of them; or, `as_mean`, their mean picture
    bool as_mean = false;
    int tile_px = 8;
    double tiles_needed_share = 1; ///< so many of the tiles lie within the bound
};

/// How far an effect can move a number (absolute, in its unit), and by what formula, or why it cannot at all.
struct Bound {
    double value;
    std::string why;
    bool depends = true; ///< false: the number does not depend on the effect at all
    /// Set where no closed form gives it: `value` is NaN until the picture has been asked.
    std::shared_ptr<const PictureChange> picture{};

    Bound(double value_, std::string why_) : value(value_), why(std::move(why_)) {}
    Bound(PictureChange change, std::string why_);
    /// The number has no way to depend on it.
    static Bound none(std::string why);
};

/// One field an effect, without defaults: the compiler names every place that forgot one.
struct EffectBounds {
    Bound polarisation, dispersion, absorption, birefringence, light_size, caustics, interreflection, pupil;

    const Bound &of(Effect effect) const;
    Bound &of(Effect effect) { return const_cast<Bound &>(static_cast<const EffectBounds &>(*this).of(effect)); }
};

struct ScopeNumber {
    std::string quantity, unit;
    double value;
    double margin;
    std::string margin_is; ///< "to the threshold 0", "its tolerance"
    EffectBounds bounds;

    bool requires_effect(Effect effect) const;
};

/// Of a claim's numbers, the one whose bound is the greatest share of its margin; null: none depends on the effect.
const ScopeNumber *most_moved(const std::vector<ScopeNumber> &numbers, Effect effect);

/// "polarisation could move the brightness ... (0.397) by 0.031, more than its margin of 0.0024 (its tolerance): within
/// its model only".
std::string scope_sentence(const ScopeNumber &number, Effect effect);

/// An exact renderer that stores 16 bits.
Accuracy reference_accuracy();

} // namespace threefold
