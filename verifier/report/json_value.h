// SPDX-License-Identifier: MIT
// How values become JSON, alike in every result.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

namespace threefold::report {

/// JSON has no number for NaN and the infinities: null.
inline nlohmann::ordered_json real(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

/// Names and what each is, as one object.
inline nlohmann::ordered_json object(const std::vector<std::pair<std::string, std::string>> &pairs) {
    auto all = nlohmann::ordered_json::object();
    for (const auto &[name, value] : pairs) all[name] = value;
    return all;
}

} // namespace threefold::report
