// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/flow/source_panel.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/assert.hpp"

namespace ice {

namespace {

std::array<Vec3, 3> points_at(const SourcePanel& p, double apex) {
    // the weight apex on one corner, the rest on both others alike
    const double rest = 0.5 * (1.0 - apex);
    const Vec3 off = kOffPanel * std::sqrt(p.area) * p.normal;
    std::array<Vec3, 3> out;
    for (std::size_t k = 0; k < 3; ++k)
        out[k] = apex * p.corner[k] + rest * (p.corner[(k + 1) % 3] + p.corner[(k + 2) % 3]) + off;
    return out;
}

}  // namespace

SourcePanel make_panel(const Vec3& a, const Vec3& b, const Vec3& c) {
    SourcePanel out;
    out.corner = {a, b, c};
    const Vec3 twice = (b - a).cross(c - a);
    out.area = 0.5 * twice.norm();
    ICE_ASSERT(out.area > 0.0);
    out.normal = twice.normalized();
    out.centre = (a + b + c) / 3.0;
    double radius = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 edge = out.corner[(k + 1) % 3] - out.corner[k];
        out.length[k] = edge.norm();
        // in the panel's plane, away from the third corner: m_k of (22)
        out.outward[k] = edge.cross(out.normal) / out.length[k];
        radius = std::max(radius, (out.corner[k] - out.centre).norm());
    }
    out.far_squared = kFarRadii * kFarRadii * radius * radius;
    return out;
}

// three points whose mean is exact for quadratic functions of place
std::array<Vec3, 3> flux_points(const SourcePanel& panel) { return points_at(panel, 2.0 / 3.0); }

// Points other than those of the solution: the normal velocity that remains there is the panels'
// error.
std::array<Vec3, 3> check_points(const SourcePanel& panel) { return points_at(panel, 0.5); }

}  // namespace ice
