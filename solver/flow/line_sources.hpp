// SPDX-License-Identifier: GPL-3.0-or-later
/// The plane flow around a section (2D models): lines of sources, docs/method.md, section 6.
#pragma once

#include <span>
#include <vector>

#include "solver/flow/panel_sums.hpp"

namespace ice {

/// A segment in the plane y = 0 that gives off water evenly.
struct SourceLine {
    Vec3 from, to;  ///< [m]
    Vec3 along;     ///< unit, from `from` to `to`
    Vec3 normal;    ///< unit, into the water, across `along`
    double length;  ///< [m]
};

/// @param from, to  [m], apart @param normal  unit, into the water, across the line
SourceLine make_line(const Vec3& from, const Vec3& to, const Vec3& normal);

/// A section at 1 m/s along +x through water at rest, its image in z = 0, and how well it does:
/// as PanelFlow.
struct LineFlow {
    std::vector<SourceLine> lines;
    std::vector<double> strength;                        ///< by line [m/s]
    double residual = 0.0, worst = 0.0, net_flux = 0.0;  ///< [-]
    Vec3 worst_place = Vec3::Zero();                     ///< [m]
};

/// The wetted outline of a prism over a range of y, cut at the water and into equal parts no longer
/// than `longest` [m]; 0: a hundredth of the wetted length.
/// @param water  z of the water in the mesh's frame [m]
/// @throws Error (exit code 2) where nothing is wet
std::vector<SourceLine> make_wetted_lines(const TriangleMesh& prism, double water, double longest);

/// Strengths with which no water passes through the section: the mean of v . n over each line,
/// taken at the two points of Gauss's rule, is that of the motion. Eigen's BiCGSTAB, as
/// solve_panels(). The matrix is stored whole: 8 n^2 bytes for n lines.
/// @throws Error (exit code 1) where the solver does not settle
LineFlow solve_lines(std::vector<SourceLine> lines);

/// Flow at points of the plane y = 0, on all threads:
///
///     v = 1/(2 pi) sum_j s_j (t ln(r_a / r_b) + n theta),
///     phi = 1/(2 pi) sum_j s_j (t . (x - a) ln r_a - t . (x - b) ln r_b - l + |h| theta)
///
/// (equation (23)) with a and b the ends, r the distances from them, t the unit vector along the
/// line, l its length, theta the angle under which it is seen, from the side of the normal
/// positive, and h the distance from it. At the very end of a line the logarithm stays finite.
std::vector<FlowSample> flow_at(const LineFlow& flow, std::span<const Vec3> points);

}  // namespace ice
