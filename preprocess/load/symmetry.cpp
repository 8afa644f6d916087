// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/load/symmetry.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ice {

namespace {

struct WeightedPoint {
    Vec3 at;
    double weight;
};

// Exact for polynomials up to degree 3: corners 1/20, middles of the sides 2/15, centre 9/20.
std::array<WeightedPoint, 7> cubature(const Vec3& a, const Vec3& b, const Vec3& c) {
    // Shares of the triangle's area [-], which add up to 1. Degree 3, because the highest moment
    // below has that degree; a rule of lower degree would depend on the triangles.
    constexpr double corner = 1.0 / 20.0, side = 2.0 / 15.0, centre = 9.0 / 20.0;
    return {{{a, corner},
             {b, corner},
             {c, corner},
             {0.5 * (a + b), side},
             {0.5 * (b + c), side},
             {0.5 * (c + a), side},
             {(a + b + c) / 3.0, centre}}};
}

}  // namespace

Eigen::AlignedBox3d bounding_box(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) box.extend(mesh.corner(t, k));
    return box;
}

// No point is compared with its image: a symmetric hull may be triangulated in different ways on
// both sides, while integrals over the surface do not depend on the triangles.
double asymmetry(const TriangleMesh& mesh, int axis) {
    const Eigen::AlignedBox3d box = bounding_box(mesh);
    if (box.isEmpty()) return 0.0;
    const Vec3 centre = box.center();
    Vec3 unit = 0.5 * box.sizes();
    for (int k = 0; k < 3; ++k)
        // A flat mesh has no extent along one axis.
        if (!(unit[k] > 0.0)) unit[k] = 1.0;

    std::array<double, 7> sum{};
    double area = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const double part = mesh.area_vector(t).norm();
        area += part;
        for (const auto& [at, weight] :
             cubature(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2))) {
            const Vec3 p = (at - centre).cwiseQuotient(unit);
            const double n = p[axis], a = p[(axis + 1) % 3], b = p[(axis + 2) % 3];
            // Moments of the surface that are odd along the axis, up to degree 3, in half sizes of
            // the box: all vanish for a mirror-symmetric surface, however it is triangulated.
            const std::array<double, 7> odd{n,         n * a,     n * b,    n * a * a,
                                            n * a * b, n * b * b, n * n * n};
            for (std::size_t k = 0; k < odd.size(); ++k) sum[k] += weight * part * odd[k];
        }
    }
    if (!(area > 0.0)) return 0.0;
    double worst = 0.0;
    for (const double s : sum) worst = std::max(worst, std::abs(s) / area);
    return worst;
}

}  // namespace ice
