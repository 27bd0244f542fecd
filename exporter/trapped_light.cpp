// SPDX-License-Identifier: MIT
#include "exporter/trapped_light.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exporter/sample_rays.h"
#include "scenes/access.h"

namespace threefold {
namespace {

/// Reflected share at a sphere, from the sines on both sides; all beyond the critical angle.
double reflected(double index, double sine_air, double sine_glass) {
    if (sine_air >= 1) return 1;
    const double air = std::sqrt((1 - sine_air) * (1 + sine_air));
    const double glass = std::sqrt((1 - sine_glass) * (1 + sine_glass));
    const double s = (air - index * glass) / (air + index * glass), p = (index * air - glass) / (index * air + glass);
    return (s * s + p * p) / 2;
}

/// `inner_mm`: 0 for a solid orb.
double left_inside(const Glass &made_of, double outer_mm, double inner_mm, double impact_mm, int most_interfaces) {
    const double n = made_of.index, tau = made_of.interface_transmittance;
    const double outer = reflected(n, impact_mm / outer_mm, impact_mm / outer_mm / n);
    double inward = (1 - outer) * tau, outward = 0, hollow = 0; // what has left each surface, and where to
    const double inner_sine = inner_mm > 0 ? impact_mm / n / inner_mm : 2;
    if (inner_sine >= 1) return inward * std::pow(outer, std::max(most_interfaces - 2, 0));
    const double inner = reflected(n, inner_sine * n, inner_sine);
    for (int met = 1; met < most_interfaces - 1; ++met) { // what leaves at the last one is lost too
        const double next_outward = inward * inner + hollow * (1 - inner) * tau;
        const double next_hollow = inward * (1 - inner) * tau + hollow * inner;
        inward = outward * outer;
        outward = next_outward;
        hollow = next_hollow;
    }
    return inward + outward + hollow;
}

} // namespace

double trapped_light(const Scene &scene, int most_interfaces) {
    double sum = 0;
    const std::vector<Ray> rays = sample_rays(scene.camera);
    for (const Ray &ray : rays) {
        double nearest = std::numeric_limits<double>::infinity(), left = 0;
        for (const Object &object : scene.objects) {
            const auto orb = outer_sphere(object.shape);
            if (!orb || glass_of(object.shape)->coating == Coating::antireflective) continue;
            const Passing passing = pass(ray, orb->centre_mm);
            if (passing.along_mm <= 0 || passing.along_mm >= nearest || passing.impact_mm >= orb->radius_mm) continue;
            nearest = passing.along_mm;
            const GlassShell *shell = std::get_if<GlassShell>(&object.shape);
            left = left_inside(*glass_of(object.shape), orb->radius_mm, shell ? shell->inner_radius_mm() : 0,
                               passing.impact_mm, most_interfaces);
        }
        sum += left;
    }
    return sum / static_cast<double>(rays.size());
}

} // namespace threefold
