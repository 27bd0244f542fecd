// SPDX-License-Identifier: MIT
// What a picture is held against. Where a closed form is known it is used: uniform surroundings, and a scene without
// branching rays (no glass, or one orb with the ideal coating: the coordinate card). Elsewhere our tracer makes it: in
// double, with trees cut at 1e-6, from several independent pictures, so that its own noise is known and taken off.
// A renderer's own converged picture would hide what it does wrong, so none is used.
#pragma once

#include <functional>
#include <optional>

#include "verifier/agreement/error_split.h"

namespace threefold {

struct ReferenceRequest {
    double error = 1e-3; ///< relative RMS through its own noise: asked for, and reached unless `most_cpu_s` ends it
    double most_cpu_s = 300;
    std::uint64_t seed = 1;
    int threads = 0;
    int pictures = 4; ///< independent, at least two: more tell the noise of few pixels better
    std::function<void(double share)> on_progress; ///< may be empty
};

ReferencePicture make_reference(const Scene &scene, const ReferenceRequest &request);

/// The picture by closed forms alone, by independent sets of samples within the pixels; a single one where the picture
/// is exact. Empty where this scene has none.
std::optional<std::vector<Image>> closed_form_pictures(const Scene &scene, int samples, int pictures,
                                                       std::uint64_t seed);

} // namespace threefold
