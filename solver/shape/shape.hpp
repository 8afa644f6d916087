// SPDX-License-Identifier: GPL-3.0-or-later
/// The data that all bodies made from one sphere file share: contact spheres, mesh, mass integrals.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/formats/sphere_set.hpp"
#include "solver/shape/convex_bounds.hpp"
#include "solver/shape/face_regions.hpp"
#include "solver/shape/mesh_edges.hpp"
#include "solver/shape/normal_cone.hpp"
#include "solver/shape/side_planes.hpp"
#include "solver/shape/solid.hpp"
#include "solver/shape/solid_part.hpp"
#include "solver/shape/solid_surface.hpp"
#include "solver/shape/sphere_blocks.hpp"
#include "solver/shape/surface_blocks.hpp"

namespace ice {

/// A body's shape in its own axes: floes about the centre of mass, the hull in the ship frame.
struct Shape {
    int dimension = 3;

    // the surface spheres, N each; interior spheres never touch anything first
    std::vector<Vec3> center;        ///< [m]
    std::vector<double> radius;      ///< [m]
    std::vector<Vec3> normal;        ///< outward, unit
    std::vector<double> spread_cos;  ///< of the half-angle between `normal` and the surface
    std::vector<double> spread_sin;  ///<   normals met there [-]: 1 and 0 on a face
    std::vector<NormalCone> cone;    ///< of the faces that meet at the sphere; empty on a face
    /// Spheres of one feature type differ in place, area and region only.
    std::vector<std::int32_t> feature_type;
    std::size_t feature_types = 0;  ///< number of types: feature_type holds 0 ... feature_types - 1
    /// Rank by place, mirror images about y = 0 alike. Decisions and orders that use this
    /// before any index keep mirror-image states mirror images, bit for bit.
    std::vector<std::int32_t> mirror_rank;
    std::vector<double> area;  ///< share of the surface [m2]; 2D: a length [m]
    FaceRegions region;        ///< by sphere: rows of region_names
    std::vector<std::string> region_names;
    std::size_t sphere_count = 0;  ///< of the whole set, interior included
    ConvexBounds bounds;           ///< of mesh and spheres
    ConvexPiece convex;            ///< the mesh where it is convex, else empty; 2D: empty
    /// The mesh in convex parts: of pieces of level ice, which meet each other as solids; else
    /// empty.
    std::vector<SolidPart> parts;
    SphereBlocks blocks;          ///< of `center`, for the search
    SphereBlocks balls;           ///< the spheres without their faces, for the rule "centres"
    double largest_radius = 0.0;  ///< [m]
    double spacing = 0.0;         ///< nominal distance of the surface spheres [m]
    /// Distance from its centre up to which a sphere represents the surface, 0.75 spacings [m].
    double patch_radius = 0.0;
    SidePlanes side_planes;  ///< at which the faces end within it

    TriangleMesh mesh;                            ///< closed, body axes
    FacetBlocks facets;                           ///< its triangles, for the water's loads
    MeshEdges edges;                              ///< of floes, where water that moves is looked up
    std::shared_ptr<const SolidSurface> surface;  ///< its nearest points; never null
    MassProperties solid;          ///< unit density; centroid in body axes (floes: zero)
    Eigen::AlignedBox3d box;       ///< of mesh and spheres
    double bounding_radius = 0.0;  ///< about the body origin [m]
};

/// Makes the shape of a floe (axes moved to the centre of mass) or of the hull (axes kept). The
/// same set gives the same bits.
/// @throws Error (exit code 2) when the set has no surface spheres.
Shape build_shape(const SphereSet& set, bool about_centre_of_mass);

}  // namespace ice
