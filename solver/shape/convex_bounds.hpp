// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// A sphere as a bound sees it: nothing of it is farther than this from its centre but the tip of
/// the sharp edge or corner that it represents.
struct BoundedSphere {
    Vec3 center;              ///< [m]
    double radius;            ///< [m]
    Vec3 tip = Vec3::Zero();  ///< from the centre [m]
};

/// Points whose convex hull a body lies in, and planes that it lies behind, but for `excess`; body
/// axes.
///
/// Taken from the mesh: its vertices, and a plane through the foremost of them along each facet's
/// normal. A shape of more than kMost different normals or vertices (a hull of thousands of
/// triangles) has none: a test of them would cost more than it saves.
struct ConvexBounds {
    /// Normals or vertices at most [-]: a prism floe of 18 sides has 20 and 36. More gives more
    /// shapes a bound, whose test grows with normals times vertices; results stay the same.
    static constexpr std::size_t kMost = 40;

    std::vector<Vec3> corners;   ///< [m]
    std::vector<Vec3> normals;   ///< outward, unit
    std::vector<double> offset;  ///< normal . x of the foremost corner [m]
    double excess = 0.0;         ///< how far a sphere or its tip reaches out of them at most [m]
    /// No sphere reaches out of the corners' convex hull by more than that, in any direction: the
    /// mesh, closed, is convex. Of two such bodies, whole, separation() is at most the least gap of
    /// their spheres.
    bool enclose_spheres = false;

    /// Shapes without bounds are always searched.
    bool known() const { return !corners.empty(); }

    ConvexBounds() = default;
    ConvexBounds(const TriangleMesh& mesh, std::span<const BoundedSphere> spheres);
};

}  // namespace ice
