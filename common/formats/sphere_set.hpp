// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "common/geometry/mass_properties.hpp"
#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// One of the surface normals that meet at a sphere in an edge or corner.
struct CreaseNormal {
    std::int32_t sphere;  ///< row of SphereSet::centers
    Vec3 normal;          ///< outward, unit
};

/// A solid as contact spheres: made by spherize, read by icesolve (docs/contract.md, section 3).
///
/// N spheres, the first S of them ("surface spheres") represent the surface, the others for the
/// interior: arrays that only concern the surface have S rows. In 2D a sphere is a disc in the
/// plane y = 0 and areas, volumes and the solid's integrals are per metre of breadth; the mesh is
/// the prism over y in [-0.5, 0.5] m.
struct SphereSet {
    int dimension = 3;     ///< 3 or 2
    double radius = 0.0;   ///< nominal radius [m]
    double spacing = 0.0;  ///< nominal distance of centres on the surface [m]
    std::string mode;      ///< "fill" or "surface"
    std::string source_mesh, source_sha256, created_by, command_line;

    std::vector<Vec3> centers;      ///< N, in the mesh's frame [m]
    std::vector<double> radii;      ///< N, [m], > 0
    std::vector<double> volumes;    ///< N, share of the volume [m3]
    std::size_t surface_count = 0;  ///< S

    std::vector<Vec3> normals;          ///< S, outward unit normal of the surface
    std::vector<double> normal_spread;  ///< S, largest angle [rad] between `normals` and a surface
                                        ///< normal met at the sphere: 0 on a face, 45 degrees on a
                                        ///< right-angled edge
    std::vector<double> areas;          ///< S, share of the surface [m2]
    std::vector<std::int32_t> regions;  ///< S, row of mesh.region_names; the interior has row 0
    std::vector<CreaseNormal> creases;  ///< for every sphere in an edge or corner each normal that
                                        ///< meets there; ordered by sphere

    MassProperties solid;  ///< exact integrals over `mesh`
    TriangleMesh mesh;     ///< the closed mesh that was filled

    std::size_t size() const { return centers.size(); }

    // of any sphere; 0 where the interior has no row
    bool on_surface(std::size_t k) const { return k < surface_count; }
    Vec3 normal(std::size_t k) const { return on_surface(k) ? normals[k] : Vec3(Vec3::Zero()); }
    double area(std::size_t k) const { return on_surface(k) ? areas[k] : 0.0; }
    std::int32_t region(std::size_t k) const { return on_surface(k) ? regions[k] : 0; }
};

}  // namespace ice
