// SPDX-License-Identifier: GPL-3.0-or-later
/// The solid that a body's spheres represent, as its planes, corners and edges.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Eight vectors beside each other, by component.
struct alignas(64) VectorBlock {
    /// Fixed, so that no order of operations depends on the instruction set; eight doubles are the
    /// widest vector in use.
    static constexpr std::size_t kLanes = 8;

    double x[kLanes], y[kLanes], z[kLanes];  ///< by lane
};

/// Vectors in blocks; the last block is filled up with copies of the last vector.
class VectorBlocks {
public:
    VectorBlocks() = default;
    explicit VectorBlocks(const std::vector<Vec3>& list);

    std::size_t size() const { return count_; }
    const std::vector<VectorBlock>& blocks() const { return blocks_; }
    Vec3 operator[](std::size_t k) const {
        const VectorBlock& block = blocks_[k / VectorBlock::kLanes];
        const std::size_t lane = k % VectorBlock::kLanes;
        return {block.x[lane], block.y[lane], block.z[lane]};
    }

private:
    std::vector<VectorBlock> blocks_;
    std::size_t count_ = 0;
};

/// An edge of a convex piece: where two of its planes meet.
struct SolidEdge {
    std::int32_t begin, end;   ///< corners
    std::int32_t left, right;  ///< planes; from begin to end it runs along n_left x n_right
};

/// A side plane of a face: the plane through one of its edges, upright on the face.
struct SidePlane {
    Vec3 outward;   ///< unit, out of the face
    double offset;  ///< outward . x on the plane [m]
};

/// A convex polyhedron: planes, corners and edges; body axes.
///
/// Coplanar triangles of the mesh are one plane. Planes, corners and edges are in an order that
/// mirror images about y = 0 have in common but for the images themselves.
struct ConvexPiece {
    /// With more planes or corners than this [-] a piece is not made: curved surfaces are none. All
    /// pairs of edges are candidates, so the cost grows with the square; with fewer, floes of many
    /// sides lose the exact axis. The ids of contact corners have room for no more.
    static constexpr std::size_t kMost = 64;

    VectorBlocks normals;                ///< of the planes, outward, unit
    std::vector<double> offsets;         ///< normal . x on the plane [m], filled up as the normals
    VectorBlocks corners;                ///< [m]
    std::vector<SolidEdge> edges;        ///< each once
    VectorBlocks edge_middle;            ///< of the edges: midway between the two corners [m]
    VectorBlocks edge_along;             ///< unit vector from begin to end
    VectorBlocks edge_left, edge_right;  ///< normals of the planes left and right
    std::vector<std::vector<std::int32_t>> loops;     ///< corners round each plane, anticlockwise
    std::vector<std::vector<SidePlane>> side_planes;  ///< by plane, from each corner of its loop on

    std::size_t plane_count() const { return normals.size(); }
    bool empty() const { return normals.size() == 0; }
};

/// A half-space normal . x <= offset.
struct HalfSpace {
    Vec3 normal;    ///< outward, unit
    double offset;  ///< [m]
};

/// The polyhedron with these planes, corners and edges, in this order; empty where the edges do not
/// close round every plane.
/// @param edges  each once
ConvexPiece piece_of(const std::vector<HalfSpace>& planes, const std::vector<Vec3>& corners,
                     std::vector<SolidEdge> edges);

/// The convex polyhedron of a closed mesh; empty where the mesh is not convex, has too many planes
/// or corners, or is flat.
///
/// Facets whose normals differ by less than 1e-5 are one plane, through the foremost of all
/// vertices. A vertex in front of a facet by more than a millionth of the mesh's size makes the
/// mesh not convex; facets thinner than that have no normal and are passed over.
ConvexPiece make_convex_piece(const TriangleMesh& mesh);

}  // namespace ice
