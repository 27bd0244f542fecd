// SPDX-License-Identifier: MIT
// What the parts of the Blender exporter share: its frame, and how it refuses.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "exporter/recentre.h"
#include "scenes/error.h"

namespace threefold {

/// Millimetres to units. +y up becomes +z up by exchange of axes alone, which rounds nothing.
class ToBlender {
public:
    ToBlender(const Frame &frame, double unit_mm) : origin_mm_(frame.origin_mm), unit_mm_(unit_mm) {}

    double length(double mm) const { return mm / unit_mm_; }
    static Vec3 direction(Vec3 v) { return {v.x, -v.z, v.y}; }
    Vec3 vector(Vec3 mm) const { return direction(mm) / unit_mm_; }
    Vec3 point(Vec3 mm) const { return vector(mm - origin_mm_); }

private:
    Vec3 origin_mm_;
    double unit_mm_;
};

inline nlohmann::ordered_json to_json(Vec3 v) {
    return {v.x + 0.0, v.y + 0.0, v.z + 0.0}; // + 0.0: no negative zeros
}

[[noreturn]] inline void refuse_for_cycles(const std::string &what, const std::string &hint = {}) {
    throw Error(Exit::bad_data, "Cycles: " + what, hint);
}

} // namespace threefold
