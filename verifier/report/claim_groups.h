// SPDX-License-Identifier: MIT
// A run under both presets judges every claim twice: here the two belong together again.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "verifier/agreement/result.h"

namespace threefold::report {

/// One claim, as it was judged under each preset; at least one part.
struct ClaimGroup {
    std::vector<const ClaimResult *> parts;

    const ClaimResult &first() const { return *parts.front(); }
    Verdict verdict() const;
    /// Null where the claim was not judged under this preset.
    const ClaimResult *under(std::string_view preset) const;
};

/// In order of first appearance. Pointers into `result`.
std::vector<ClaimGroup> groups_of(const RunResult &result);
/// The presets that claims were judged under, in order of appearance.
std::vector<std::string> presets_of(const RunResult &result);
/// "the study's wording"; empty for a preset we do not know.
std::string_view meaning_of_preset(std::string_view preset);

} // namespace threefold::report
