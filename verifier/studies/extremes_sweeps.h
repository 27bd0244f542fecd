// SPDX-License-Identifier: MIT
// The scenes of the extremes study: one number of a plain scene is led to where arithmetic ends, point by point.
#pragma once

#include <string>
#include <vector>

#include "scenes/scene.h"

namespace threefold {

/// `landing`: coated glass before the coordinate card; every pixel says where its ray landed. `light`: glass that
/// splits light, in surroundings of radiance 1; every pixel must be 1, however long the light stays inside.
enum class Probe { landing, light };

struct ExtremePoint {
    std::string label; ///< the number, as on the axis of the map
    double value = 0;
    Scene scene;
    /// Our tracer in double precision answers for this point: it must be right there. Elsewhere it may be refused or
    /// degraded, not wrong.
    bool promised = false;
    bool landmark = false; ///< in a quick study too
};

struct ExtremeSweep {
    std::string name;   ///< "wall"
    std::string title;  ///< "Wall of a hollow orb"
    std::string number; ///< what is swept: "wall / R"
    Probe probe = Probe::landing;
    std::vector<ExtremePoint> points; ///< from the ordinary to the extreme
};

/// `quick`: about every third point, the last ones always.
std::vector<ExtremeSweep> extreme_sweeps(bool quick);

} // namespace threefold
