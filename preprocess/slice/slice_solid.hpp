// SPDX-License-Identifier: GPL-3.0-or-later
/// The section of a solid by the plane y = 0, for 2D sphere sets.
#pragma once

#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A straight piece of a section's outline; the solid lies to the left of a -> b in the x-z plane
/// seen from port (x to the right, z up).
struct SectionEdge {
    Vec3 a, b;            ///< y = 0 [m]
    Vec3 normal;          ///< outward, unit, y = 0
    std::int32_t region;  ///< of the mesh surface that was cut
};

/// A section: closed loops, every loop kept, each in order. Outer loops run anticlockwise, holes
/// clockwise.
struct Section {
    std::vector<std::vector<SectionEdge>> loops;
};

/// Cuts a closed mesh by the plane y = `offset` [m]. Collinear neighbours of one region are joined.
/// @throws Error (exit code 2) when the plane misses the solid
Section slice_solid(const TriangleMesh& mesh, double offset);

/// The section as a solid of 1 m breadth, y in [-0.5, 0.5]: its integrals are the section's per
/// metre. The two flat ends take region 0.
TriangleMesh extrude(const Section& section, const std::vector<std::string>& region_names);

}  // namespace ice
