// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/geometry/mass_properties.hpp"
#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A solid as contact spheres: what spherize makes and icesolve reads (CONTRACT.md, section 3).
///
/// All arrays have N rows, surface spheres first. In 2D a sphere is a disc in the plane y = 0 and
/// areas, volumes and the solid's integrals are per metre of breadth; the mesh is the prism over
/// y in [-0.5, 0.5] m.
struct SphereSet {
    int dimension = 3;     ///< 3 or 2
    double radius = 0.0;   ///< nominal radius [m]
    double spacing = 0.0;  ///< nominal distance of centres on the surface [m]
    std::string mode;      ///< "fill" or "surface"
    std::string source_mesh, source_sha256, created_by, command_line;

    std::vector<Vec3> centers;          ///< in the mesh's frame [m]
    std::vector<double> radii;          ///< [m], > 0
    std::vector<Vec3> normals;          ///< outward unit normal of the surface; 0 inside
    std::vector<double> normal_spread;  ///< largest angle [rad] between `normals` and a surface
                                        ///< normal met at the sphere: 0 on a face, 45 degrees on a
                                        ///< right-angled edge
    std::vector<double> areas;          ///< share of the surface [m2]; 0 inside
    std::vector<double> volumes;        ///< share of the volume [m3]
    std::vector<std::uint8_t> layers;   ///< 1 surface, 0 interior
    std::vector<std::int32_t> regions;  ///< row of mesh.region_names

    MassProperties solid;  ///< exact integrals over `mesh`
    TriangleMesh mesh;     ///< the closed mesh that was filled

    std::size_t size() const { return centers.size(); }
};

}  // namespace ice
