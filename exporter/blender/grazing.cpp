// SPDX-License-Identifier: MIT
#include "exporter/blender/grazing.h"

#include <algorithm>
#include <cmath>

#include "exporter/recentre.h"
#include "exporter/sample_rays.h"

namespace threefold {

double grazing_mm(double radius_mm, double surface_mm) { return 1e-4 * radius_mm + 4 * surface_mm; }

double grazing_share(const Scene &scene, double surface_mm) {
    const std::vector<Ray> rays = sample_rays(scene.camera);
    const std::vector<Sphere> edges = glass_spheres(scene);
    const auto grazes = [&](const Ray &ray) {
        return std::ranges::any_of(edges, [&](const Sphere &edge) {
            const Passing passing = pass(ray, edge.centre_mm);
            return passing.along_mm > 0 &&
                   std::abs(passing.impact_mm - edge.radius_mm) < grazing_mm(edge.radius_mm, surface_mm);
        });
    };
    return static_cast<double>(std::ranges::count_if(rays, grazes)) / static_cast<double>(rays.size());
}

} // namespace threefold
