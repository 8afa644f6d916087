// SPDX-License-Identifier: GPL-3.0-or-later
/// Distances to a closed triangle mesh.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// The point of a mesh nearest to some point.
struct Foot {
    Vec3 point = Vec3::Zero();   ///< on the surface [m]
    double distance = 0.0;       ///< [m], >= 0
    bool inside = false;         ///< the point lies in the solid
    std::int32_t triangle = -1;  ///< row of the mesh's triangles
};

/// Closest-point and range queries by a tree of boxes over the triangles.
///
/// Inside or outside follows the angle-weighted normal of the nearest face, edge or corner
/// (Baerentzen and Aanaes, IEEE TVCG 11(3), 2005): right for every closed, consistently oriented
/// mesh. A point on the surface counts as outside. Thread-safe once built.
class SurfaceTree {
public:
    /// @pre mesh is closed, outward oriented and not empty; it must outlive the tree. Cost O(T log
    /// T)
    explicit SurfaceTree(const TriangleMesh& mesh);

    /// @param hint  a triangle thought to be near p (that of the last query, say); -1 for none. The
    ///              answer is the same without it, only later: of equal feet the first triangle's.
    /// @param p     [m]
    Foot closest(const Vec3& p, std::int32_t hint = -1) const;

    /// Feet on all triangles within `range` [m] of p; replaces `out`. In no particular order: most
    /// callers sort by distance, and a large range finds 1e5 feet. `inside` is not set.
    void within(const Vec3& p, double range, std::vector<Foot>& out) const;

    /// True when no point of the surface is nearer than `range` [m] to p. Much cheaper than
    /// closest() where the range is small, because it searches no farther.
    bool is_clear(const Vec3& p, double range) const;

    const TriangleMesh& mesh() const { return mesh_; }
    /// Root of the mean area of the triangles [m]; 0 without triangles.
    double mean_edge() const { return mean_edge_; }
    /// Outward unit normal [-]; zero for a triangle without area.
    const Vec3& normal(std::int32_t triangle) const {
        return normals_[static_cast<std::size_t>(triangle)];
    }

private:
    // Four boxes at once, as floats: they are rounded outwards, so a distance to them is never too
    // large, and one visit is a dozen vector instructions.
    struct Node {
        Eigen::Array4f low[3], high[3];
        std::int32_t child[4];  ///< leaf: first of its range of order_; else a node
        std::int32_t count[4];  ///< triangles of a leaf; 0: a node; -1: nothing
    };

    using Corners = std::array<Vec3, 3>;

    template <class Skip, class Visit>
    void visit_leaves(const Vec3& p, const Skip& skip, const Visit& visit) const;
    std::int32_t build(std::int32_t first, std::int32_t count);
    std::int32_t split(std::int32_t first, std::int32_t count);
    void set_box(Node& node, int k, std::int32_t first, std::int32_t count) const;
    void build_normals();
    bool beyond_plane(const Vec3& p, std::int32_t t, const Corners& corner, double range_sq) const;
    bool is_inside(const Vec3& p, const Foot& foot, int feature) const;

    const TriangleMesh& mesh_;
    std::vector<Node> nodes_;
    Vec3 middle_ = Vec3::Zero();  ///< the boxes' origin: floats are finest near it
    double grain_ = 0.0;          ///< by how much boxes are widened [m]
    double mean_edge_ = 0.0;
    std::vector<std::int32_t> order_;
    std::vector<std::int32_t> rank_;    ///< of each triangle in order_
    std::vector<Corners> corners_;      ///< of the triangles in the order of order_: read in a row
    std::vector<Vec3> centers_;         ///< while building only
    std::vector<Vec3> normals_;         ///< per triangle
    std::vector<Vec3> corner_normals_;  ///< per vertex, angle-weighted
    std::vector<std::array<Vec3, 3>> edge_normals_;  ///< per triangle and edge: sum of both faces
};

}  // namespace ice
