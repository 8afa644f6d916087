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
/// Along each axis the lattice is tangent to the largest flat face square to that axis (the lower
/// end of the box where there is none), so that a box of whole multiples of 2 R is filled from face
/// to face: the paper's floe of 1 x 0.8 x 0.3 m takes 10 x 8 x 3 spheres of 0.05 m.
///
/// @param clearance  smallest distance of a centre from the surface [m]; R for touching spheres.
///                   Points nearer than it by less than 1e-9 of it count as inside.
/// In 2D one layer at y = 0.
Lattice fill_lattice(const SurfaceTree& tree, double radius, double clearance, int dimension);

}  // namespace ice
