// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "preprocess/measure/surface_tree.hpp"

namespace ice {

/// A cubic lattice of spheres wholly inside a solid.
struct Lattice {
    std::vector<Vec3> centers;        ///< ordered z slowest, x fastest
    std::vector<std::uint8_t> outer;  ///< 1 where one of the six neighbours (four in 2D) is missing
};

/// Fills a solid with a cubic lattice of pitch 2 R whose spheres lie inside it.
///
/// Along each axis: where flat faces square to it bound the box at both ends and the extent is a
/// multiple of 2 R, the lattice is tangent to both, so that the paper's floe of 1 x 0.8 x 0.3 m
/// takes 10 x 8 x 3 spheres of 0.05 m. Otherwise it is tangent to the largest flat face; centred in
/// the box where there is none, where the two end faces are equally large, and along y for a solid
/// that is symmetric about y = 0 (its lattice is then symmetric, bit for bit).
///
/// @param clearance  smallest distance of a centre from the surface [m]; R for touching spheres.
///                   Points nearer than it by less than 1e-9 of it count as inside.
/// @param mirror     the solid is symmetric about y = 0
/// In 2D one layer at y = 0. Blocks far from the surface are decided as a whole, so the cost is
/// O(surface / R^2) distances, and one byte per lattice point of the box.
/// @throws Error (exit code 2) when the box holds more than 1e9 lattice points
Lattice fill_lattice(const SurfaceTree& tree, double radius, double clearance, int dimension,
                     bool mirror);

}  // namespace ice
