// SPDX-License-Identifier: MIT
// The half figure as a relief that stands behind the orb: a mesh with the painting on it.
// Frame: that of scenes/scene.h; the eye looks along -z. Every place of the relief is raised along its line of sight:
// whatever its depth it is seen where the painting has it, and nothing hides behind anything else.
#pragma once

#include "scenes/figure/painting.h"

namespace threefold::figure {

/// Where the picture is seen from and where it stands: what turns its places into points.
struct Standpoint {
    Vec3 eye_mm{0};
    double half_angle_tangent = 0.1878; ///< of the picture's horizontal field of view
    double plane_z_mm = -297.5;         ///< of the relief's ground

    double unit_mm() const { return half_angle_tangent * (eye_mm.z - plane_z_mm); }
    /// The point of the relief's ground plane that is seen at the place, raised by `height` along the line of sight.
    Vec3 point_mm(Vec2 place, double height = 0) const;
    /// Where a point is seen.
    Vec2 place(Vec3 point_mm) const;
};

/// What no parameter changes; others take longer.
inline constexpr int usual_relief_columns = 240;

/// `columns` vertices a row (at least 2); rows as make its cells square. Texture coordinates are those of the whole
/// picture, so that any picture of this composition fits it; grey.
Mesh relief(const Standpoint &standpoint, int columns);

/// What belongs on it.
std::shared_ptr<const Texture> relief_texture();

} // namespace threefold::figure
