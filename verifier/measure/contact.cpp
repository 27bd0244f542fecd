// SPDX-License-Identifier: MIT
#include "verifier/measure/contact.h"

#include <cmath>
#include <numbers>

#include "scenes/geometry.h"

namespace threefold {
namespace {

/// How often the mesh surrounds the point: 1 inside a closed one, 0 outside, between them for one with holes. The sum
/// of the triangles' solid angles (Van Oosterom and Strackee, 1983) over the whole sphere's.
double winding_number(const Mesh &mesh, Vec3 p) {
    double angle = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Triangle t = triangle_of(mesh, i);
        const Vec3 a = t.a - p, b = t.b - p, c = t.c - p;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        const double volume = glm::dot(a, glm::cross(b, c));
        const double cosine = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
        angle += 2 * std::atan2(volume, cosine);
    }
    return angle / (4 * std::numbers::pi);
}

} // namespace

double clearance_mm(const Mesh &mesh, const Sphere &sphere) {
    const double nearest = distance_to(mesh, sphere.centre_mm);
    const double gap = nearest - sphere.radius_mm;
    if (gap < 0 || !std::isfinite(gap)) return gap;
    const bool swallowed = std::abs(winding_number(mesh, sphere.centre_mm)) > 0.5;
    return swallowed ? -(nearest + sphere.radius_mm) : gap;
}

} // namespace threefold
