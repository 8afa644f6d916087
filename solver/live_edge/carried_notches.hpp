// SPDX-License-Identifier: GPL-3.0-or-later
/// Notches outlive the tiles that had them (docs/method.md, section 5).
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/scene/bodies.hpp"

namespace ice {

/// The surface spheres of tiles that a renewal of the edge takes away, with the depths to which
/// they were crushed.
///
/// New ice has its surface where the old ice had it. A crushed sphere went along a line, from its
/// place in the whole tile to the bottom of the notch. A new sphere whose place is on this line, or
/// within a patch radius of it, is crushed to the bottom of the notch as well. Of several lines the
/// nearest counts. A sphere that was never crushed is a line of length 0, and counts for new
/// spheres of its own face only. A new sphere far from all lines, as on the face of a crack, is
/// whole.
class CarriedNotches {
public:
    /// Remembers the spheres of a held tile. @pre the tile has its shape still
    void take(const Scene& scene, std::int32_t tile);

    /// Crushes the spheres of a new body in the place of tiles that were taken. @pre the body has
    /// its place and is whole; neighbour lists are made anew for it
    void give(Scene& scene, std::int32_t body) const;

private:
    struct Line {
        Vec3 from, move, normal;  // world axes [m]; outward, unit
    };
    // Move of the new sphere at a place with an outward normal, to the bottom of its notch [m].
    Vec3 move_of(std::span<const Line> lines, const Vec3& at, const Vec3& normal) const;
    // The lines that meet a box.
    std::vector<Line> lines_near(const Eigen::AlignedBox3d& box) const;

    std::vector<Line> lines_;
    double reach_ = 0.0;      // a patch radius [m]
    bool has_notch_ = false;  // else the lines have no length
};

}  // namespace ice
