// SPDX-License-Identifier: MIT
#include "exporter/blender/grazing.h"

#include <algorithm>
#include <cmath>

#include "exporter/sample_rays.h"
#include "scenes/access.h"

namespace threefold {

double grazing_mm(double radius_mm, double surface_mm) { return 1e-4 * radius_mm + 4 * surface_mm; }

double grazing_share(const Scene &scene, double surface_mm) {
    const std::vector<Ray> rays = sample_rays(scene.camera);
    const auto grazes = [&](const Ray &ray) {
        return std::ranges::any_of(scene.objects, [&](const Object &object) {
            const auto orb = outer_sphere(object.shape);
            if (!orb) return false;
            const Passing passing = pass(ray, orb->centre_mm);
            return passing.along_mm > 0 &&
                   std::abs(passing.impact_mm - orb->radius_mm) < grazing_mm(orb->radius_mm, surface_mm);
        });
    };
    return static_cast<double>(std::ranges::count_if(rays, grazes)) / static_cast<double>(rays.size());
}

} // namespace threefold
