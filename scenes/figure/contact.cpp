// SPDX-License-Identifier: MIT
#include "scenes/figure/contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace threefold::figure {

// Ericson, Real-Time Collision Detection (2005), section 5.1.5: the Voronoi regions of a triangle.
Vec3 nearest_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
    const Vec3 ab = b - a, ac = c - a;
    const double d1 = glm::dot(ab, p - a), d2 = glm::dot(ac, p - a);
    if (d1 <= 0 && d2 <= 0) return a;
    const double d3 = glm::dot(ab, p - b), d4 = glm::dot(ac, p - b);
    if (d3 >= 0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return d1 == d3 ? a : a + d1 / (d1 - d3) * ab;
    const double d5 = glm::dot(ab, p - c), d6 = glm::dot(ac, p - c);
    if (d6 >= 0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return d2 == d6 ? a : a + d2 / (d2 - d6) * ac;
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        const double length = d4 - d3 + d5 - d6;
        return length > 0 ? b + (d4 - d3) / length * (c - b) : b;
    }
    const double sum = va + vb + vc;
    return a + vb / sum * ab + vc / sum * ac;
}

double distance_to(const Mesh &mesh, Vec3 p) {
    double least = std::numeric_limits<double>::infinity();
    for (const glm::uvec3 &t : mesh.triangles) {
        const Vec3 nearest =
            nearest_on_triangle(p, mesh.vertices_mm[t.x], mesh.vertices_mm[t.y], mesh.vertices_mm[t.z]);
        least = std::min(least, glm::length(nearest - p));
    }
    return least;
}

} // namespace threefold::figure
