// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "common/geometry/surface_tree.hpp"

namespace ice {

/// The largest sphere found inside a solid, and an upper bound for all.
struct Inscribed {
    double radius = 0.0;         ///< of a sphere that was found [m]; 0: none was
    double bound = 0.0;          ///< no sphere inside is larger [m]
    Vec3 center = Vec3::Zero();  ///< of that sphere [m]
};

/// Largest sphere inside a closed surface, in 2D the largest disc in y = 0, by branch and bound:
/// cubes are halved while a sphere with its centre in them may be larger than the one known. From
/// a cube's centre, `q` nearest on the surface, no point of the cube is deeper than its distance
/// from q (and, as depth changes by no more than the way, than the depth plus half the diagonal).
///
/// @param wanted  stop when a sphere of this radius [m] is found, or when none can be as large and
///                the largest is known to 1 %. 0: the largest, to 1 %
/// @return at the latest after some 1e6 queries, when `radius` and `bound` may still be apart: as
///         in a wide flat plate, whose deepest points fill a plane. Bits are the same for any
///         number of threads
Inscribed find_inscribed(const SurfaceTree& tree, int dimension, double wanted = 0.0);

}  // namespace ice
