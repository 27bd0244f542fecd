// SPDX-License-Identifier: MIT
#include "verifier/claims/scope_three_lines.h"

#include <cmath>

#include <fmt/format.h>

#include "verifier/claims/lines_asked.h"
#include "verifier/claims/scope_bounds.h"

namespace threefold {

namespace {

/// All rays of a circle have one impact parameter: what they lose on their way they lose alike, and a line's centre of
/// darkness stays.
EffectBounds line_bounds(const Experiment &e, const LinesAsked &asked, const SoftLine &line,
                         const ScopeSettings &settings) {
    const auto jump = [&](const LinesView &view, Camera camera, Vec2 aside) {
        const CameraFrame frame = camera_frame(camera);
        camera.eye_mm += aside.x * frame.right + aside.y * frame.up;
        const double mm = predicted_jump(view, camera, line);
        return std::copysign(asked.arcmin(camera, mm), mm);
    };
    const IndexBounds index = by_index(asked.view.orb.optics.index, settings, [&](double n) {
        LinesView view = asked.view;
        view.orb.optics.index = n;
        return jump(view, e.scene.camera, Vec2(0));
    });
    const bool has_eye = e.scene.camera.projection == Projection::perspective;
    const char *alike = "on a circle all rays have the same impact parameter and lose the same share of light: the "
                        "line's centre of darkness stays where refraction puts it";
    EffectBounds bounds =
        of_directions(e.scene, index,
                      has_eye ? by_pupil(settings, [&](Vec2 aside) { return jump(asked.view, e.scene.camera, aside); })
                              : Bound::none("the view is orthographic: it has no eye, and so no pupil"));
    bounds.polarisation = bounds.absorption = Bound::none(alike);
    return bounds;
}

} // namespace

std::vector<ScopeNumber> scope_three_lines(const ClaimContext &context, const ScopeSettings &settings) {
    std::vector<ScopeNumber> numbers;
    for (const std::string kind : {"hollow", "solid", "bent"}) {
        const Experiment e = lines_probe(context, "", "", "three-lines-" + kind, {});
        const LinesAsked asked = asked_of(e);
        for (const NamedLine &named : asked.lines) {
            if (named.name == "lower line") continue; // the upper one, mirrored
            const double seen = asked.arcmin(e.scene.camera, predicted_jump(asked.view, e.scene.camera, named.line));
            numbers.push_back(
                {fmt::format("break of the {} behind the {} orb", named.name, kind == "bent" ? "hollow" : kind),
                 "arcmin", seen, margin_to(seen, {asked.acuity_arcmin}), margin_words({asked.acuity_arcmin}, "arcmin"),
                 line_bounds(e, asked, named.line, settings)});
        }
    }
    return numbers;
}

} // namespace threefold
