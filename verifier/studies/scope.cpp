// SPDX-License-Identifier: MIT
#include "verifier/studies/scope.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <limits>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "scenes/error.h"
#include "scenes/texture.h"
#include "verifier/agreement/tiles.h"
#include "verifier/measure/radiance.h"
#include "verifier/optics/concentric.h"
#include "verifier/tracer/tracer.h"

namespace threefold {

namespace {

constexpr int picture_samples = 16;

void require_known(const ScopeRequest &request) {
    std::vector<std::string> valid;
    for (const SceneRecipe &scene : request.scenes)
        for (const ParameterSpec &p : scene.parameters) valid.push_back(p.name);
    std::ranges::sort(valid);
    valid.erase(std::unique(valid.begin(), valid.end()), valid.end()); // not of std::ranges, for Clang 14
    for (const Assignment &a : request.assignments)
        if (!std::ranges::binary_search(valid, a.name))
            throw Error(Exit::usage, unknown_name("parameter", a.name, valid));
}

std::optional<ScopeRay> ray_of(const ScopeRequest &request) {
    const SceneRecipe &hollow = find_scene(request.scenes, "hollow");
    Parameters values(hollow.parameters, Preset::text);
    values.set("orb.wall_mm", 1.36);
    for (const Assignment &a : request.assignments)
        if (values.has(a.name)) values.set(a.name, a.value);
    const auto orb_with = [&](double index) {
        return optics::shell(values.number("orb.radius_mm"), values.number("orb.wall_mm"), index);
    };
    const double index = values.number("glass.index");
    const optics::Orb<double> orb = orb_with(index);
    if (!(orb.inner_mm > 0) || !(request.impact_mm >= 0)) return std::nullopt;
    const auto impact = optics::impact_at(orb, request.impact_mm);
    const auto light = optics::path_transmittance(orb, impact);
    const auto turn = optics::deflection(orb, impact);
    if (!light || !turn || optics::course(orb, impact) != optics::Course::through_hollow) return std::nullopt;
    const auto turn_at = [&](double nm) {
        const auto coloured =
            orb_with(std::max(1.0, optics::index_at_wavelength(index, request.settings.abbe_number, nm)));
        return optics::deflection(coloured, optics::impact_at(coloured, request.impact_mm)).value_or(*turn);
    };
    const double red = turn_at(request.settings.greatest_wavelength_nm),
                 violet = turn_at(request.settings.least_wavelength_nm);
    return ScopeRay{orb.outer_mm,
                    orb.wall_mm,
                    index,
                    request.impact_mm,
                    light->unpolarised,
                    light->polarised,
                    -std::expm1(-2 * request.settings.absorption_per_mm * optics::glass_leg_mm(orb, impact)),
                    *turn,
                    std::min(red, violet),
                    std::max(red, violet)};
}

Image traced(const Scene &scene, int threads) {
    RenderJob job;
    job.scene = scene;
    job.samples_per_pixel = picture_samples;
    job.cut_weight = 1e-3;
    job.threads = threads;
    return trace(job).images.front();
}

double change_between(const Image &a, const Image &b, int tile_px, double needed_share) {
    Image change(a.width, a.height);
    for (std::size_t i = 0; i < change.pixels.size(); ++i)
        change.pixels[i] = Rgb(grey(b.pixels[i]) - grey(a.pixels[i]));
    std::vector<double> changes;
    for (const Rgb &mean : tile_means(change, tile_px).pixels) changes.push_back(std::abs(mean.r));
    std::ranges::sort(changes, std::greater<>());
    const auto spare = static_cast<std::size_t>(tiles_allowed(static_cast<int>(changes.size()), needed_share));
    return changes[std::min(spare, changes.size() - 1)];
}

} // namespace

std::vector<Effect> ClaimScope::required() const {
    std::vector<Effect> all;
    for (const EffectEntry &entry : effects())
        if (std::ranges::any_of(numbers, [&](const ScopeNumber &n) { return n.requires_effect(entry.effect); }))
            all.push_back(entry.effect);
    return all;
}

double picture_change(const PictureChange &change, int threads) {
    const Image as_it_is = traced(change.as_it_is, threads);
    std::vector<Image> instead;
    for (const Scene &scene : change.instead) instead.push_back(traced(scene, threads));
    if (change.as_mean) instead = {mean(instead)};
    double greatest = 0;
    for (const Image &image : instead)
        greatest = std::max(greatest, change_between(as_it_is, image, change.tile_px, change.tiles_needed_share));
    return greatest;
}

ScopeResult study_scope(const ScopeRequest &request) {
    require_known(request);
    ScopeResult result;
    result.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
    result.settings = request.settings;
    result.ray = ray_of(request);
    const double steps = static_cast<double>(request.presets.size() * request.claims.size());
    double done = 0;
    for (const Claim &claim : request.claims)
        for (const Preset preset : request.presets) {
            if (request.on_progress) request.on_progress(done / steps, claim.name);
            done += 1;
            ClaimScope scope{claim.name, claim.statement, std::string(to_string(preset)), true, {}};
            scope.answered = static_cast<bool>(claim.scope);
            const ClaimContext context{request.scenes, preset, request.assignments, true};
            try {
                if (claim.scope) scope.numbers = claim.scope(context, request.settings);
            } catch (const Error &error) {
                if (error.code() != Exit::bad_data || request.claims.size() * request.presets.size() == 1) throw;
                result.problems.push_back(fmt::format("{} ({}): {}", claim.name, to_string(preset), error.what()));
                continue;
            }
            for (ScopeNumber &number : scope.numbers)
                for (const EffectEntry &entry : effects()) {
                    Bound &bound = number.bounds.of(entry.effect);
                    if (!bound.picture || request.closed_forms_only) continue;
                    if (request.on_progress)
                        request.on_progress((done - 1) / steps, fmt::format("{}: {}", claim.name, entry.name));
                    try {
                        bound.value = picture_change(*bound.picture, request.threads);
                        bound.picture.reset();
                    } catch (const Error &error) {
                        if (error.code() != Exit::bad_data) throw;
                        result.problems.push_back(fmt::format("{}, {}: {}", claim.name, entry.name, error.what()));
                    }
                }
            result.claims.push_back(std::move(scope));
        }
    if (result.claims.empty())
        throw Error(Exit::bad_data, fmt::format("no claim has a scene with these values: {}", result.problems.front()));
    return result;
}

} // namespace threefold
