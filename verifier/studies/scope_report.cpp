// SPDX-License-Identifier: MIT
#include "verifier/studies/scope_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "verifier/report/json_value.h"

namespace threefold {

namespace {

using Json = nlohmann::ordered_json;

std::string with_unit(const std::string &number, const ScopeNumber &n) {
    return n.unit.empty() ? number : number + " " + n.unit;
}

std::string bound_text(const ScopeNumber &n, const Bound &bound) {
    if (!bound.depends) return "cannot";
    if (bound.picture) return "not asked";
    if (!std::isfinite(bound.value)) return "not to be told";
    return with_unit(fmt::format("{:.2g}", bound.value), n);
}

std::string margin_text(const ScopeNumber &n) { return with_unit(fmt::format("{:.2g}", n.margin), n); }

/// "required", "no", "not asked".
std::string required_text(const ScopeNumber &n, Effect effect) {
    const Bound &bound = n.bounds.of(effect);
    if (bound.picture) return "not asked";
    return n.requires_effect(effect) ? "required" : "no";
}

/// Without an exponent.
std::string two_digits(double value) {
    return value < 99.5 ? fmt::format("{:.2g}", value) : fmt::format("{:.0f}", value);
}

std::string share_text(const ScopeNumber &n, const Bound &bound) {
    if (!bound.depends) return "-";
    if (bound.picture) return "?";
    if (bound.value == 0) return "0 %";
    const double share = bound.value / n.margin;
    if (!std::isfinite(share)) return "all";
    if (share < 1e-4) return "under 0.01 %";
    return share < 10 ? two_digits(100 * share) + " %" : two_digits(share) + " times";
}

std::string named(const ScopeResult &result, const ClaimScope &scope) {
    const bool twice = std::ranges::count(result.claims, scope.claim, &ClaimScope::claim) > 1;
    return twice ? fmt::format("{} ({})", scope.claim, scope.preset) : scope.claim;
}

std::string ray_text(const ScopeRay &r) {
    return fmt::format(
        "One ray, straight through a hollow orb of {:g} mm with a wall of {:g} mm and an index of {:g}, {:g} mm from "
        "the axis: with polarisation carried {:.3f} of its light arrives, where renderers, which take light as "
        "unpolarised anew at every surface, say {:.3f}: {:.1f} % more. The glass absorbs {:.2g} % of it. It is turned "
        "by {:.2f} mrad outwards, over the visible range by {:.2f} to {:.2f}.",
        r.outer_mm, r.wall_mm, r.index, r.impact_mm, r.polarised, r.unpolarised,
        100 * (r.polarised / r.unpolarised - 1), 100 * r.absorbed, -1e3 * r.turn_rad, -1e3 * r.turn_greatest_rad,
        -1e3 * r.turn_least_rad);
}

std::string conclusion(const ScopeResult &result) {
    std::vector<std::string> required;
    std::vector<std::string> unknown, not_asked;
    std::size_t untold = 0;
    for (const ClaimScope &scope : result.claims) {
        const auto some = [&](const auto &holds) {
            return std::ranges::any_of(scope.numbers, [&](const ScopeNumber &n) {
                return std::ranges::any_of(effects(),
                                           [&](const EffectEntry &e) { return holds(n, n.bounds.of(e.effect)); });
            });
        };
        if (some([](const ScopeNumber &, const Bound &bound) { return bound.picture != nullptr; }))
            not_asked.push_back(named(result, scope));
        if (some([](const ScopeNumber &n, const Bound &bound) { return bound.depends && std::isnan(n.margin); }))
            unknown.push_back(named(result, scope));
        std::vector<std::string_view> names;
        for (const Effect effect : scope.required()) names.push_back(to_string(effect));
        if (!names.empty()) required.push_back(fmt::format("{} ({})", named(result, scope), fmt::join(names, ", ")));
        untold += !scope.answered;
    }
    std::string text =
        required.empty()
            ? "No effect that the models leave out could move a claim's number by more than its margin."
            : fmt::format("Within their models only: {}. For the other claims asked nothing that is left out "
                          "could move a number by more than its margin.",
                          fmt::join(required, "; "));
    if (!unknown.empty())
        text += fmt::format(" But some numbers do not exist with these values, and of them nothing is said: {}.",
                            fmt::join(unknown, ", "));
    if (!not_asked.empty())
        text += fmt::format(" But effects that take a picture were not asked: {}.", fmt::join(not_asked, ", "));
    if (untold > 0) text += fmt::format(" {} claim(s) do not say what they leave out.", untold);
    for (const std::string &problem : result.problems) text += " Not asked: " + problem + ".";
    return text;
}

std::string settings_text(const ScopeSettings &s) {
    return fmt::format("Abbe number {:g}, {:g} to {:g} nm; absorption {:g} per mm; strain {:g} nm/cm; lights of {:g} "
                       "degrees; a pupil of {:g} mm; calcite's Abbe numbers {:g} and {:g}",
                       s.abbe_number, s.least_wavelength_nm, s.greatest_wavelength_nm, s.absorption_per_mm,
                       s.strain_nm_per_cm, s.light_deg, s.pupil_mm, s.calcite_abbe_ordinary,
                       s.calcite_abbe_extraordinary);
}

using report::real;

Json to_json(const ScopeNumber &n) {
    Json bounds = Json::array();
    for (const EffectEntry &entry : effects()) {
        const Bound &bound = n.bounds.of(entry.effect);
        bounds.push_back({{"effect", entry.name},
                          {"depends", bound.depends},
                          {"bound", real(bound.value)},
                          {"asked", !bound.picture},
                          {"required", n.requires_effect(entry.effect)},
                          {"why", bound.why}});
    }
    return {{"quantity", n.quantity},   {"unit", n.unit},           {"value", real(n.value)},
            {"margin", real(n.margin)}, {"margin_is", n.margin_is}, {"effects", bounds}};
}

std::string cell_of(const ClaimScope &scope, Effect effect) {
    if (!scope.answered) return "?";
    const ScopeNumber *n = most_moved(scope.numbers, effect);
    if (!n) return "-";
    const std::string share = share_text(*n, n->bounds.of(effect));
    return n->requires_effect(effect) ? "**" + share + "**" : share;
}

} // namespace

Json to_json(const ScopeResult &result) {
    const ScopeSettings &s = result.settings;
    Json claims = Json::array();
    for (const ClaimScope &scope : result.claims) {
        Json numbers = Json::array(), required = Json::array();
        for (const ScopeNumber &n : scope.numbers) numbers.push_back(to_json(n));
        for (const Effect effect : scope.required()) required.push_back(to_string(effect));
        claims.push_back({{"claim", scope.claim},
                          {"preset", scope.preset},
                          {"answered", scope.answered},
                          {"required", required},
                          {"numbers", numbers}});
    }
    Json ray = nullptr;
    if (const auto &r = result.ray)
        ray = {{"outer_mm", r->outer_mm},
               {"wall_mm", r->wall_mm},
               {"index", r->index},
               {"impact_mm", r->impact_mm},
               {"transmittance_unpolarised", r->unpolarised},
               {"transmittance_polarised", r->polarised},
               {"absorbed", r->absorbed},
               {"turn_rad", r->turn_rad},
               {"turn_least_rad", r->turn_least_rad},
               {"turn_greatest_rad", r->turn_greatest_rad}};
    return {{"schema", "threefold scope"},
            {"schema_version", ScopeResult::schema_version},
            {"threefold_version", result.threefold_version},
            {"command", result.command},
            {"started", result.started},
            {"settings",
             {{"abbe_number", s.abbe_number},
              {"least_wavelength_nm", s.least_wavelength_nm},
              {"greatest_wavelength_nm", s.greatest_wavelength_nm},
              {"absorption_per_mm", s.absorption_per_mm},
              {"strain_nm_per_cm", s.strain_nm_per_cm},
              {"light_deg", s.light_deg},
              {"pupil_mm", s.pupil_mm},
              {"calcite_abbe_ordinary", s.calcite_abbe_ordinary},
              {"calcite_abbe_extraordinary", s.calcite_abbe_extraordinary}}},
            {"summary", conclusion(result)},
            {"ray", ray},
            {"claims", claims},
            {"problems", result.problems}};
}

std::string to_text(const ScopeResult &result, bool every_number) {
    std::string out;
    for (const ClaimScope &scope : result.claims) {
        out += fmt::format("{}  {}\n", named(result, scope), scope.statement);
        if (!scope.answered) out += "  says nothing of what it leaves out\n";
        for (const ScopeNumber &n : scope.numbers)
            out += fmt::format("  {}: {}, margin {} ({})\n", n.quantity, with_unit(fmt::format("{:.4g}", n.value), n),
                               margin_text(n), n.margin_is);
        for (const EffectEntry &entry : effects())
            for (const ScopeNumber &n : scope.numbers) {
                const ScopeNumber *most = most_moved(scope.numbers, entry.effect);
                if (!most) most = &scope.numbers.front();
                if (!every_number && &n != most) continue;
                const Bound &bound = n.bounds.of(entry.effect);
                out += fmt::format("    {:<15} {:>14}  of {:>14}  {:<9}  {}{}\n", entry.name, bound_text(n, bound),
                                   margin_text(n), required_text(n, entry.effect),
                                   scope.numbers.size() > 1 && bound.depends ? n.quantity + ": " : "", bound.why);
            }
        out += "\n";
    }
    if (result.ray) out += ray_text(*result.ray) + "\n";
    return out + conclusion(result) + "\n";
}

std::string to_markdown(const ScopeResult &result) {
    std::string out =
        fmt::format("# What the claims leave out, and whether it matters\n\nMade by `{}` (Threefold {}).\n\n{}\n\n",
                    result.command, result.threefold_version, conclusion(result));
    if (result.ray) out += ray_text(*result.ray) + "\n\n";
    out +=
        "Each cell is the greatest of the claim's bounds, as a share of its number's margin; bold is more than all of "
        "it: the effect is required, and the claim holds within its model only. `-`: no number of the claim can "
        "depend on the effect.\n\n| claim |";
    for (const EffectEntry &entry : effects()) out += fmt::format(" {} |", entry.name);
    out += "\n|---|";
    for (std::size_t k = 0; k < effects().size(); ++k) out += "---|";
    out += "\n";
    for (const ClaimScope &scope : result.claims) {
        out += fmt::format("| {} |", named(result, scope));
        for (const EffectEntry &entry : effects()) out += fmt::format(" {} |", cell_of(scope, entry.effect));
        out += "\n";
    }
    out += fmt::format("\nReckoned for: {}.\n\n", settings_text(result.settings));
    for (const EffectEntry &entry : effects()) out += fmt::format("- **{}**: {}\n", entry.name, entry.meaning);
    out +=
        "\nThe *margin* of a number is its distance, by the closed form, from the threshold at which the conclusion "
        "flips; of an equality, the tolerance that `check` gives an exact renderer which stores 16 bits. A bound is "
        "reckoned by the claim's own closed form in the other world (at another index, for s and p apart, with light "
        "lost on its way, from the points of a pupil); where a whole picture is the number, by conservation of energy, "
        "by albedo times form factor, or by the tracer. The sources of the formulas are in the headers of "
        "`verifier/optics/` and `verifier/claims/scope_bounds.h`.\n";
    for (const ClaimScope &scope : result.claims) {
        out += fmt::format("\n## {}\n\n{}\n", named(result, scope), scope.statement);
        for (const ScopeNumber &n : scope.numbers) {
            out += fmt::format("\n**{}**: {}, margin {} ({})\n\n| effect | bound | of the margin | required | why |\n"
                               "|---|---|---|---|---|\n",
                               n.quantity, with_unit(fmt::format("{:.4g}", n.value), n), margin_text(n), n.margin_is);
            for (const EffectEntry &entry : effects()) {
                const Bound &bound = n.bounds.of(entry.effect);
                const std::string required = required_text(n, entry.effect);
                out += fmt::format("| {} | {} | {} | {} | {} |\n", entry.name, bound_text(n, bound),
                                   share_text(n, bound), required == "required" ? "**required**" : required, bound.why);
            }
        }
    }
    return out;
}

} // namespace threefold
