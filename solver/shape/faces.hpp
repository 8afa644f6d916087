// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>

#include "common/geometry/triangle_mesh.hpp"

namespace ice {

/// The faces that meet in an edge (2) or a corner (3), by their outward normals.
struct Faces {
    int count = 0;
    std::array<Vec3, 3> normal{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    double corner = 0.0;  ///< from the sphere's centre along its normal to where they meet [m]
    double aside = 0.0;   ///< from there to the points where the sphere touches the faces [m]

    /// None, or the 2 or 3 faces with these unit normals; `corner` and `aside` are left 0.
    static Faces meeting(std::span<const Vec3> normals);

    /// The same in other axes.
    Faces turned(const Mat3& turn) const;

    /// Is n an outward normal of the edge or corner: are its parts along the faces' normals
    /// positive, to some degrees? Beyond them the corner is not the body's foremost point, another
    /// sphere's is. Nor is it where n runs along the edge, by more than `most_along` (cosine).
    /// @param slack  all bounds are wider by this [rad]; negative: narrower
    /// @pre count > 0
    bool have(const Vec3& n, double most_along, double slack = 0.0) const;

    /// Unit vector along the edge; count == 2.
    const Vec3& edge() const { return part[2]; }

private:
    // n . part[k] is n's part along normal[k], times `size` (positive); of two faces part[2] is the
    // edge's direction
    std::array<Vec3, 3> part{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
    double size = 0.0;
};

}  // namespace ice
