// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "common/geometry/surface_tree.hpp"
#include "preprocess/fill/rows_inside.hpp"

namespace ice {

/// Kinds of filling of a solid.
struct LatticeOptions {
    LatticeKind kind = LatticeKind::cubic;
    double radius = 0.1;     ///< of the spheres [m]
    double clearance = 0.1;  ///< smallest distance of a centre from the surface [m], > 0
    int dimension = 3;       ///< 2: one layer of rows at y = 0
    bool mirror = false;     ///< the solid is symmetric about y = 0
};

/// Neighbours along a row, all inside: points first, ..., first + count - 1 of row j, k.
struct LatticeRun {
    std::int32_t j, k;
    std::int32_t first, count;
};

/// The lattice points inside a solid, row by row: 16 bytes per run and one bit per point of the
/// box where a list of centres takes 24 bytes per sphere.
struct LatticeFill {
    LatticeFrame frame;
    LatticeBits bits;
    std::vector<LatticeRun> runs;  ///< ordered k slowest (along z), then j, then first
    std::size_t count = 0;         ///< spheres, the sum over the runs
};

/// Every point of a lattice (lattice_frame.hpp says where it lies) whose distance from the surface,
/// inside the solid, is at least the clearance. Points nearer by less than 1e-9 of the clearance
/// count as inside, so that spheres may touch flat faces.
///
/// A symmetric solid gets a symmetric fill, bit for bit: a point stays only with its image.
/// Same bits for any thread count. Cost O(triangles + rows + points near the surface); tests hold
/// it to CGAL's answers and to SurfaceTree's, point by point.
/// @pre the mesh is closed, outward oriented and does not cross itself; it may be unwelded
/// @throws Error (exit code 2) when the box holds more than 1e9 lattice points
LatticeFill fill_lattice_rows(const TriangleMesh& mesh, const LatticeOptions& options);

/// Writes the centres in the order of the runs.
/// @param out  LatticeFill::count points [m]. A fresh vector costs more than the fill: 10 ns per
///             sphere to make its pages, 1 ns to write them.
void expand(const LatticeFill& fill, std::span<Vec3> out);

/// One byte per sphere in the order of expand(): 1 where one of the six neighbours of a cubic
/// lattice (four in 2D) is missing. @pre cubic
std::vector<std::uint8_t> outer_spheres(const LatticeFill& fill, int dimension);

/// A lattice of spheres wholly inside a solid, as lists.
struct Lattice {
    std::vector<Vec3> centers;        ///< ordered z slowest, x fastest
    std::vector<std::uint8_t> outer;  ///< 1 where one of the six neighbours (four in 2D) is missing
};

/// fill_lattice_rows() of a cubic lattice, expanded.
Lattice fill_lattice(const SurfaceTree& tree, double radius, double clearance, int dimension,
                     bool mirror);

}  // namespace ice
