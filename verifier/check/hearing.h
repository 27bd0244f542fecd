// SPDX-License-Identifier: MIT
// What every witness answers to one experiment. The programs run side by side: POV-Ray waits a fifth of a second
// between two pictures and Blender reads a scene on one core, so one fills the other's gaps.
#pragma once

#include <exception>
#include <optional>
#include <vector>

#include "verifier/tolerance/tile_noise.h"
#include "verifier/tolerance/tolerance.h"
#include "verifier/witness/witness.h"

namespace threefold {

struct Question {
    const Witness *witness;
    RenderJob job;
    RenderOptions options; ///< on_progress is called from one thread at a time, whichever
    /// They choose the samples, by pilots with this renderer; the more of both count.
    std::optional<NoiseWanted> noise{};
    std::optional<TilesWanted> tiles{};
};

struct Answer {
    const Witness *witness;
    std::optional<Rendered> rendered;
    std::exception_ptr failure; ///< set where there is no picture
    int samples_per_pixel = 0;  ///< that the pictures were asked with
};

/// One answer a question, in their order, once all have ended. `at_once`: side by side, else one after the other.
std::vector<Answer> hear(std::vector<Question> questions, bool at_once);

} // namespace threefold
