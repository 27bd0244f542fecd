// SPDX-License-Identifier: MIT
// "The hand touches the orb softly and nowhere overlaps it" (the study's virtual set-up). No picture is needed: what
// is measured is the distance in the scene itself, as each renderer is given it.
#include <cmath>

#include <fmt/format.h>

#include "scenes/error.h"
#include "verifier/claims/claim.h"
#include "verifier/claims/flip.h"
#include "verifier/claims/prediction.h"
#include "verifier/claims/scope_bounds.h"
#include "verifier/measure/contact.h"

namespace threefold {

namespace {

constexpr double soft_mm = 0.5;         ///< skin gives way by as much
constexpr double rounding_share = 1e-6; ///< of the radius: an overlap below it is a contact, rounded
constexpr double unseen_relief = 24;    ///< the robe is not looked at
constexpr const char *distance = "smallest distance from hand to orb";
constexpr const char *touches = "the hand touches the orb (under 0.5 mm)";
constexpr const char *apart = "the hand nowhere overlaps the orb";

const Mesh &hand_of(const Scene &scene) {
    for (const Object &object : scene.objects)
        if (const Mesh *mesh = std::get_if<Mesh>(&object.shape); mesh && object.name == "hand") return *mesh;
    throw Error(Exit::internal, "a claim asked for the hand of a scene that has none");
}

Sphere sphere_of(const Scene &scene) {
    const OrbInScene orb = orb_of(scene);
    return {orb.centre_mm, orb.optics.outer_mm};
}

double clearance_in(const Scene &scene) { return clearance_mm(hand_of(scene), sphere_of(scene)); }

Experiment hold_experiment(const ClaimContext &context, const std::string &name, const std::string &title,
                           const std::vector<Assignment> &fixed) {
    return context.experiment(name, title, "salvator", {assign("robe.relief_resolution", unseen_relief)}, fixed);
}

Experiment contact_experiment(const ClaimContext &context) {
    Experiment e = hold_experiment(context, "hand-contact", "the hand and the orb, measured in the scene itself", {});
    const double exact = clearance_in(e.scene), radius = sphere_of(e.scene).radius_mm;
    e.predict = [=](const Accuracy &) {
        return std::vector<Expected>{
            {distance,
             "mm",
             Relation::equal,
             exact,
             {{"arithmetic", 1e-9 * radius, "rounding of a distance in double precision"}}},
            {touches, "mm", Relation::below, soft_mm, {}},
            {apart, "mm", Relation::above, -rounding_share * radius, {}},
        };
    };
    e.inspect = [](const Scene &scene) {
        const double found = clearance_in(scene);
        return std::vector<Reading>{{distance, found}, {touches, found}, {apart, found}};
    };
    return e;
}

/// How far the hand can be lowered or raised from its hold.
struct Hold {
    double drop_mm; ///< in this run
    Sphere orb;
    Mesh hand;

    /// Lowering the hand is raising the orb.
    double clearance_at(double drop) const {
        return clearance_mm(hand, {orb.centre_mm + Vec3(0, drop - drop_mm, 0), orb.radius_mm});
    }
};

Hold hold_of(const ClaimContext &context) {
    const Experiment e = hold_experiment(context, "", "", {});
    return {std::stod(e.record.parameters.at("hand.drop_mm")), sphere_of(e.scene), hand_of(e.scene)};
}

/// The drop nearest to none at which the clearance passes a threshold, up to half a radius either way.
std::optional<double> drop_at(const Hold &hold, double threshold_mm) {
    const auto f = [&](double drop) { return hold.clearance_at(drop) - threshold_mm; };
    const double start = f(0);
    double nearer = 0;
    for (double farther = 1e-3 * hold.orb.radius_mm; nearer < 0.5 * hold.orb.radius_mm; farther *= 1.5) {
        for (const double sign : {1.0, -1.0})
            if (std::signbit(f(sign * farther)) != std::signbit(start))
                return root_between(f, std::min(sign * nearer, sign * farther),
                                    std::max(sign * nearer, sign * farther));
        nearer = farther;
    }
    return std::nullopt;
}

struct HoldFlip {
    std::string name; ///< of its two experiments, without "-below" and "-above"
    double threshold_mm;
    std::string meaning;
    std::optional<double> drop_mm;
};

std::vector<HoldFlip> hold_flips_of(const Hold &hold) {
    const double overlap = -rounding_share * hold.orb.radius_mm;
    return {{"hand-contact-flip", soft_mm,
             "lowered by more (raised by less, where negative), the hand no longer touches the orb",
             drop_at(hold, soft_mm)},
            {"hand-overlap-flip", overlap,
             "raised by more (lowered by less, where positive), the hand overlaps the orb", drop_at(hold, overlap)}};
}

std::vector<Experiment> hold_bracket_experiments(const ClaimContext &context, const Hold &hold) {
    std::vector<Experiment> all;
    for (const HoldFlip &flip : hold_flips_of(hold)) {
        if (!flip.drop_mm) continue;
        for (const auto &[label, drop] : bracket_of(*flip.drop_mm)) {
            Experiment e =
                hold_experiment(context, fmt::format("{}-{}", flip.name, label),
                                fmt::format("the hand moved {:.4g} mm down, just {} where it {}", drop, label,
                                            flip.threshold_mm > 0 ? "loses the orb" : "enters the orb"),
                                {assign("hand.drop_mm", drop)});
            const Relation side = hold.clearance_at(drop) < flip.threshold_mm ? Relation::below : Relation::above;
            e.predict = [side, threshold = flip.threshold_mm](const Accuracy &) {
                return std::vector<Expected>{{distance, "mm", side, threshold, {}}};
            };
            e.inspect = [](const Scene &scene) { return std::vector<Reading>{{distance, clearance_in(scene)}}; };
            all.push_back(std::move(e));
        }
    }
    return all;
}

std::vector<ScopeNumber> hold_scope(const ClaimContext &context, const ScopeSettings &) {
    const Hold hold = hold_of(context);
    const double clearance = hold.clearance_at(hold.drop_mm), overlap = -rounding_share * hold.orb.radius_mm;
    const EffectBounds none = none_of_them("it is a distance in the scene: no light is followed for it");
    return {{"smallest distance from hand to orb, under touch", "mm", clearance, margin_to(clearance, {soft_mm}),
             margin_words({soft_mm}, "mm"), none},
            {"smallest distance from hand to orb, over overlap", "mm", clearance, margin_to(clearance, {overlap}),
             margin_words({overlap}, "mm"), none}};
}

} // namespace

Claim claim_hand_contact() {
    Claim claim;
    claim.name = "hand-contact";
    claim.statement = "The hand touches the orb softly (under 0.5 mm) and nowhere overlaps it.";
    claim.experiments = [](const ClaimContext &context) {
        std::vector<Experiment> all{contact_experiment(context)};
        for (Experiment &e : hold_bracket_experiments(context, hold_of(context))) all.push_back(std::move(e));
        return all;
    };
    claim.summary = [](const ClaimContext &context, Verdict verdict) -> std::string {
        const Hold hold = hold_of(context);
        const double gap = hold.clearance_at(hold.drop_mm);
        switch (verdict) {
        case Verdict::holds:
            return fmt::format(
                "The hand carries the orb: between skin and glass {:.3g} mm are left at the nearest place, and "
                "nowhere does one reach into the other.",
                std::max(0.0, gap));
        case Verdict::fails:
            if (gap < -rounding_share * hold.orb.radius_mm)
                return fmt::format("The hand reaches {:.3g} mm into the orb.", -gap);
            if (gap >= soft_mm)
                return fmt::format("The hand does not touch the orb: {:.3g} mm are left between them.", gap);
            return "The hand holds the orb, but some renderer is given them in other places.";
        case Verdict::undecided:
            return "Not every renderer's scene could be measured.";
        }
        return "";
    };
    claim.notes = [](const ClaimContext &context) {
        std::vector<std::string> notes{
            "Nothing is rendered for this claim: the distance between the hand's triangles and the sphere is exact, "
            "and is measured in the scene as each renderer gets it."};
        const Hold hold = hold_of(context);
        for (const HoldFlip &flip : hold_flips_of(hold))
            if (!flip.drop_mm)
                notes.push_back(
                    fmt::format("No shift of the hand up or down by up to {:.4g} mm brings it to where it {}.",
                                0.5 * hold.orb.radius_mm,
                                flip.threshold_mm > 0 ? "is just within touch" : "just overlaps the orb"));
        return notes;
    };
    claim.flips = [](const ClaimContext &context) {
        const Hold hold = hold_of(context);
        std::vector<FlipPoint> points;
        for (const HoldFlip &flip : hold_flips_of(hold))
            if (flip.drop_mm)
                points.push_back({"hand.drop_mm",
                                  "mm",
                                  *flip.drop_mm,
                                  hold.drop_mm,
                                  flip.meaning,
                                  {flip.name + "-below", flip.name + "-above"}});
        return points;
    };
    claim.scope = hold_scope;
    claim.mutant = Fault::orb_one_millimetre;
    return claim;
}

} // namespace threefold
