// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/bending/breaking_load.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/base/interpolate.hpp"
#include "solver/bending/convex_corners.hpp"

namespace ice {

namespace {

using Vec2 = Eigen::Vector2d;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

IcePlate plate_of(double thickness, const Case& parameters) {
    const BendingLaw& law = parameters.bending;
    return {thickness, law.flexural_strength, law.elastic_modulus, law.poisson_ratio,
            parameters.water_density * parameters.gravity};
}

PieceOutline measure_outline(const TriangleMesh& mesh, const Mat3& rotation) {
    std::vector<Vec2> points;
    Eigen::AlignedBox1d height;
    for (const Vec3& v : mesh.vertices) {
        const Vec3 p = rotation * v;
        points.emplace_back(p.x(), p.y());
        height.extend(Eigen::Matrix<double, 1, 1>(p.z()));
    }
    double area = 0.0;
    for (const auto& triangle : mesh.triangles) {
        const auto corner = [&](int k) { return points[static_cast<std::size_t>(triangle[k])]; };
        // Triangles that face upwards cover the outline once: their sum is the area seen from
        // above.
        area += std::max(0.5 * cross(corner(1) - corner(0), corner(2) - corner(0)), 0.0);
    }
    // The longest distance of two points is one of two corners of the convex hull. All pairs of
    // them are tried: outlines have some tens of corners.
    const std::vector<Vec2> corners = convex_corners(std::move(points));
    Vec2 chord = Vec2::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (std::size_t j = i + 1; j < corners.size(); ++j)
            if ((corners[j] - corners[i]).squaredNorm() > chord.squaredNorm())
                chord = corners[j] - corners[i];
    const double length = chord.norm();
    PieceOutline out{area, 0.0, height.sizes().x()};
    if (length == 0.0) return out;
    // extent across the longest chord: the depth d of the piece (section 5)
    double low = 0.0, high = 0.0;
    for (const Vec2& p : corners) {
        const double across = cross(chord, p - corners.front()) / length;
        low = std::min(low, across);
        high = std::max(high, across);
    }
    out.depth = high - low;
    return out;
}

// theta = 2 A / d^2 is the angle of the circular sector with this area and the radius d. A half
// disc, and so a straight edge, has pi; more is not possible at an edge.
double opening_angle(const PieceOutline& piece) {
    const double square = piece.depth * piece.depth;
    return 2.0 * piece.area < std::numbers::pi * square ? 2.0 * piece.area / square
                                                        : std::numbers::pi;
}

double breaking_load(const PieceOutline& piece, const Case& parameters) {
    return breaking_load(opening_angle(piece), piece.thickness, parameters);
}

double breaking_load(double angle, double thickness, const Case& parameters) {
    const BendingLaw& law = parameters.bending;
    const IcePlate plate = plate_of(thickness, parameters);
    // In 2D the piece is a beam: it has no opening angle.
    if (parameters.dimension == 2) return law.factor * beam_breaking_load(plate);
    if (!std::isnan(law.opening_angle)) angle = law.opening_angle;
    return law.factor * (law.model == BendingModel::wedge
                             ? wedge_breaking_load(plate, angle, law.load_length)
                             : kashtelyan_breaking_load(plate, angle));
}

double speed_factor(const BendingLaw& law, double normal_speed) {
    return law.factor_table.empty() ? 1.0 : interpolate(law.factor_table, normal_speed);
}

}  // namespace ice
