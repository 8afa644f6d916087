// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/record/measure_hull_dimensions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace ice {

namespace {

using Segment = std::pair<Vec3, Vec3>;

// Share of the breadth from which on the midbody counts [-]. Nearer to 1 a mesh's rounding shortens
// it; less counts shoulders as parallel sides. Riska's formula takes that length.
constexpr double kFullBreadth = 0.99;

// Where the plane z = height cuts the mesh, as loose segments. Vertices on the plane count as
// above it, so that every cut triangle gives exactly one segment.
std::vector<Segment> cut(const TriangleMesh& mesh, double height) {
    std::vector<Segment> out;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        std::vector<Vec3> ends;
        for (int k = 0; k < 3; ++k) {
            const Vec3 p = mesh.corner(t, k), q = mesh.corner(t, (k + 1) % 3);
            if ((p.z() >= height) == (q.z() >= height)) continue;
            ends.push_back(p + (q - p) * ((height - p.z()) / (q.z() - p.z())));
        }
        if (ends.size() == 2) out.emplace_back(ends[0], ends[1]);
    }
    return out;
}

double foremost(const std::vector<Segment>& section) {
    double x = -std::numeric_limits<double>::infinity();
    for (const auto& [p, q] : section) x = std::max({x, p.x(), q.x()});
    return x;
}

// Least and largest x at which the section is at least `half_breadth` off the centre line.
std::pair<double, double> ends_at(const std::vector<Segment>& section, double half_breadth) {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    std::pair<double, double> ends{kNone, -kNone};
    const auto add = [&](double x) { ends = {std::min(ends.first, x), std::max(ends.second, x)}; };
    // corners far enough from the centre line, and points between where the breadth is just
    // reached
    for (const auto& [p, q] : section) {
        const double yp = std::abs(p.y()), yq = std::abs(q.y());
        if (yp >= half_breadth) add(p.x());
        if (yq >= half_breadth) add(q.x());
        if ((yp >= half_breadth) != (yq >= half_breadth))
            add(p.x() + (q.x() - p.x()) * (half_breadth - yp) / (yq - yp));
    }
    return ends;
}

}  // namespace

std::optional<HullDimensions> measure_hull_dimensions(const TriangleMesh& hull, double waterline) {
    const std::vector<Segment> water = cut(hull, waterline);
    if (water.empty()) return std::nullopt;
    double x_low = std::numeric_limits<double>::infinity(), y_low = x_low, y_high = -x_low,
           z_low = x_low;
    for (const auto& [p, q] : water) {
        x_low = std::min({x_low, p.x(), q.x()});
        y_low = std::min({y_low, p.y(), q.y()});
        y_high = std::max({y_high, p.y(), q.y()});
    }
    for (const Vec3& v : hull.vertices) z_low = std::min(z_low, v.z());

    HullDimensions dimensions;
    const double bow = foremost(water);
    dimensions.length = bow - x_low;
    dimensions.breadth = y_high - y_low;
    dimensions.draught = waterline - z_low;
    // The stem's angle is that of the chord down to a tenth of the draught, the entrance angle that
    // of the chord over the foremost quarter of the breadth on one side: both ignore a rounded tip.
    const double depth = 0.1 * dimensions.draught;
    const std::vector<Segment> deeper = cut(hull, waterline - depth);
    const double rake = bow - foremost(deeper);
    const double run = bow - ends_at(water, 0.25 * dimensions.breadth).second;
    // a flat bow, or a section without depth, has neither angle
    const bool pointed =
        !deeper.empty() && dimensions.draught > 0.0 && run > 1e-6 * dimensions.length;
    dimensions.stem_angle = pointed ? std::atan2(depth, std::max(rake, 0.0)) : std::nan("");
    dimensions.entrance_angle = pointed ? std::atan2(0.25 * dimensions.breadth, run) : std::nan("");
    const auto [aft, fore] = ends_at(water, 0.5 * kFullBreadth * dimensions.breadth);
    dimensions.parallel_length = fore - aft;
    dimensions.bow_length = bow - fore;
    return dimensions;
}

}  // namespace ice
