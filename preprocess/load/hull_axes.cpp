// SPDX-License-Identifier: GPL-3.0-or-later
#include "preprocess/load/hull_axes.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "preprocess/load/symmetry.hpp"

namespace ice {

bool is_prism(const TriangleMesh& mesh, int axis) {
    double area = 0.0, oblique = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 a = mesh.area_vector(t);
        const double part = a.norm(), cosine = std::abs(a[axis]) / part;
        if (!(part > 0.0)) continue;
        area += part;
        if (cosine > 0.02 && cosine < 0.9998) oblique += part;  // 1 degree from either
    }
    return oblique < 0.01 * area;
}

namespace {

// Of two level sections, the upper over the lower [-] below which a hull narrows upwards, and the
// lowest over the uppermost from which it may be upside down. Nearer to 1 rounding of a pontoon's
// mesh would be doubted; farther from 1 hulls with steep sides pass upside down.
constexpr double kNarrower = 0.99, kBroader = 1.1;

// Extent along `across` of the section where the coordinate `along` is `station`.
double section_width(const TriangleMesh& mesh, int along, double station, int across) {
    double low = INFINITY, high = -INFINITY;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Vec3 p = mesh.corner(t, k), q = mesh.corner(t, (k + 1) % 3);
            const double a = p[along] - station, b = q[along] - station;
            // the edge does not cross the station
            if ((a < 0.0) == (b < 0.0)) continue;
            const double at = p[across] + (q[across] - p[across]) * a / (a - b);
            low = std::min(low, at);
            high = std::max(high, at);
        }
    return high > low ? high - low : 0.0;
}

}  // namespace

std::optional<HullAxes> find_hull_axes(const TriangleMesh& mesh) {
    const Eigen::AlignedBox3d box = bounding_box(mesh);
    if (box.isEmpty()) return std::nullopt;
    const Vec3 size = box.sizes();
    HullAxes axes;
    size.maxCoeff(&axes.length);
    const int b = (axes.length + 1) % 3, c = (axes.length + 2) % 3;
    // shorter meshes may be floes or boxes, whose axes are unknown
    if (size[axes.length] < 1.5 * std::max(size[b], size[c])) return std::nullopt;
    const double off_b = asymmetry(mesh, b), off_c = asymmetry(mesh, c);
    // one plane of symmetry along the length, but not two: a box or a spindle has no upper side
    if (std::min(off_b, off_c) > kSymmetric || std::max(off_b, off_c) < kLopsided)
        return std::nullopt;
    const bool about_b = off_b < off_c;
    axes.breadth = about_b ? b : c;
    axes.vertical = about_b ? c : b;
    axes.prism = is_prism(mesh, axes.breadth);
    return axes;
}

namespace {

// Breadths of sections near the lower end over those near the upper end, by their shares of the
// length from each end.
double breadth_ratio(const TriangleMesh& mesh, const HullAxes& axes,
                     std::initializer_list<double> shares) {
    const Eigen::AlignedBox3d box = bounding_box(mesh);
    const double from = box.min()[axes.length], to = box.max()[axes.length];
    double low = 0.0, high = 0.0;
    for (const double share : shares) {
        const double step = share * (to - from);
        low += section_width(mesh, axes.length, from + step, axes.breadth);
        high += section_width(mesh, axes.length, to - step, axes.breadth);
    }
    return low > 0.0 && high > 0.0 ? low / high : 1.0;
}

}  // namespace

double fineness_ratio(const TriangleMesh& mesh, const HullAxes& axes) {
    // some stations near each end: the ends themselves may be a stem or a transom
    return breadth_ratio(mesh, axes, {0.02, 0.05, 0.08, 0.11, 0.14});
}

double tip_ratio(const TriangleMesh& mesh, const HullAxes& axes) {
    return breadth_ratio(mesh, axes, {0.005});
}

bool narrows_upwards(const TriangleMesh& mesh, const HullAxes& axes, bool upwards) {
    const Eigen::AlignedBox3d box = bounding_box(mesh);
    const double from = box.min()[axes.vertical], depth = box.max()[axes.vertical] - from;
    double lowest = 0.0, last = INFINITY;
    for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
        const double station = from + (upwards ? share : 1.0 - share) * depth;
        const double now = section_width(mesh, axes.vertical, station, axes.length) *
                           section_width(mesh, axes.vertical, station, axes.breadth);
        if (!(now < kNarrower * last)) return false;
        if (lowest == 0.0) lowest = now;
        last = now;
    }
    return lowest > kBroader * last;
}

}  // namespace ice
