// SPDX-License-Identifier: MIT
// A quick CheckRequest or PowerRequest of built-in claims, for our tracer alone.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/catalogue/catalogue.h"
#include "verifier/claims/claim.h"
#include "verifier/witness/witness.h"

namespace threefold {

template <class Request>
Request quick_request(const std::filesystem::path &folder, const std::vector<std::string> &names) {
    Request r;
    const auto claims = built_in_claims();
    for (const std::string &name : names) r.claims.push_back(find_claim(claims, name));
    r.scenes = built_in_scenes();
    r.witnesses = find_witnesses({"tracer"});
    r.quick = true;
    r.folder = folder;
    return r;
}

} // namespace threefold
