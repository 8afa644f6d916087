// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// Tells whether points lie inside a closed mesh: for checks of a case, not for steps.
///
/// A point is inside when the vertical line through it meets the surface an odd number of times
/// above and an odd number of times below. An edge's half-open rule gives each crossing to one of
/// the two triangles beside it, so a line through an edge or a corner counts it once. Where the
/// counts above and below disagree (an open mesh, or a point on the surface) the answer is no.
///
/// Building costs O(triangles), a question O(triangles in one of about that many columns).
class InsideSolid {
public:
    /// @param mesh  kept by reference; an empty one contains nothing
    explicit InsideSolid(const TriangleMesh& mesh);

    /// @param p in the mesh's axes
    bool contains(const Vec3& p) const;

private:
    std::size_t column(int axis, double x) const;

    const TriangleMesh& mesh_;
    Eigen::AlignedBox3d box_;
    std::size_t count_ = 1;           // columns along x and along y
    Vec3 per_metre_ = Vec3::Zero();   // columns per metre along x, y
    std::vector<std::size_t> first_;  // per column its first row of items_, and the end
    std::vector<std::size_t> items_;  // triangles whose box meets the column
};

}  // namespace ice
